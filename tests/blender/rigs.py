"""Takes of four importers: BVH, FBX, glTF with the bones of a VRM humanoid, and a Rigify rig of IK and constraints."""

import bpy
from mathutils import Matrix

from addon import empty

# What VRM calls the bones of data/*.bvh.
HUMANOID = {
    "Hips": "hips", "Spine": "spine", "Spine1": "chest", "Spine2": "upperChest", "Neck": "neck", "Head": "head",
    **{f"{side}{own}": f"{side.lower()}{its}" for side in ("Left", "Right") for own, its in (
        ("UpLeg", "UpperLeg"), ("Leg", "LowerLeg"), ("Foot", "Foot"), ("ToeBase", "Toes"), ("Shoulder", "Shoulder"),
        ("Arm", "UpperArm"), ("ForeArm", "LowerArm"), ("Hand", "Hand"))},
}
# Controls of Rigify's human, and the joint whose place each follows.
CONTROLS = {"torso": "Hips", "hand_ik.L": "LeftHand", "hand_ik.R": "RightHand", "foot_ik.L": "LeftFoot", "foot_ik.R": "RightFoot"}


def armature():
    return next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")


def active(thing):
    for other in bpy.context.view_layer.objects:
        other.select_set(other == thing)
    bpy.context.view_layer.objects.active = thing
    return thing


def of_bvh(path, scale=1.0):
    empty()
    bpy.ops.import_anim.bvh(filepath=str(path), update_scene_fps=True, global_scale=scale)
    return active(armature())


def of_fbx(path, folder):
    """Through a binary FBX, by Blender's own exporter and importer."""
    of_bvh(path, 0.01)
    file = str(folder / "take.fbx")
    bpy.ops.export_scene.fbx(filepath=file, object_types={"ARMATURE"}, bake_anim=True, add_leaf_bones=True)
    fps = bpy.context.scene.render.fps
    empty(fps)
    bpy.ops.import_scene.fbx(filepath=file)
    return active(armature())


def of_gltf(path, folder):
    """Through a GLB whose bones have a VRM humanoid's names."""
    thing = of_bvh(path, 0.01)
    for bone in thing.data.bones:
        bone.name = HUMANOID.get(bone.name, bone.name)
    file = str(folder / "take.glb")
    bpy.ops.export_scene.gltf(filepath=file, export_animations=True)
    fps = bpy.context.scene.render.fps
    empty(fps)
    bpy.ops.import_scene.gltf(filepath=file)
    return active(armature())


def of_rigify(path):
    """Rigify's human, its controls keyed where a take has hips, hands and feet."""
    source = of_bvh(path, 0.01)
    first, last = (int(end) for end in source.animation_data.action.curve_frame_range)
    places = {}
    for frame in range(first, last + 1):
        bpy.context.scene.frame_set(frame)
        for control, joint in CONTROLS.items():
            places[frame, control] = (source.matrix_world @ source.pose.bones[joint].matrix).translation.copy()
    height = max(place.z for place in places.values())
    rig = human()
    own = max((rig.matrix_world @ bone.head).z for bone in rig.pose.bones if bone.name in CONTROLS)
    scale = own / height
    for bone in rig.pose.bones:
        if "IK_FK" in bone:
            bone["IK_FK"] = 0.0
    for (frame, control), place in places.items():
        bone = rig.pose.bones[control]
        bone.matrix = Matrix.Translation(place * scale) @ bone.bone.matrix_local.to_quaternion().to_matrix().to_4x4()
        bone.keyframe_insert("location", frame=frame)
    return active(rig)


def human():
    bpy.ops.preferences.addon_enable(module="rigify")
    bpy.ops.object.armature_human_metarig_add()
    bpy.ops.pose.rigify_generate()
    return bpy.context.active_object
