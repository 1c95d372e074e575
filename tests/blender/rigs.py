"""Takes of importers: BVH, FBX, glTF, a VRM avatar with a VRMA by their own add-on; and rigs of controls: Rigify, and MMD's."""

import re

import bpy
from mathutils import Matrix, Vector

from addon import empty

# What VRM calls the bones of data/*.bvh.
HUMANOID = {
    "Hips": "hips", "Spine": "spine", "Spine1": "chest", "Spine2": "upperChest", "Neck": "neck", "Head": "head",
    **{f"{side}{own}": f"{side.lower()}{its}" for side in ("Left", "Right") for own, its in (
        ("UpLeg", "UpperLeg"), ("Leg", "LowerLeg"), ("Foot", "Foot"), ("ToeBase", "Toes"), ("Shoulder", "Shoulder"),
        ("Arm", "UpperArm"), ("ForeArm", "LowerArm"), ("Hand", "Hand"))},
}
# What MMD calls them, of a side without it.
MMD = {"Spine": "上半身", "Spine1": "上半身2", "Neck": "首", "Head": "頭"}
MMD_OF_SIDE = {"Shoulder": "肩", "Arm": "腕", "ForeArm": "ひじ", "Hand": "手首", "UpLeg": "足", "Leg": "ひざ", "Foot": "足首", "ToeBase": "つま先"}
SIDES = {"Left": "左", "Right": "右"}
# Controls of Rigify's human, and the joint whose place each follows.
CONTROLS = {"torso": "Hips", "hand_ik.L": "LeftHand", "hand_ik.R": "RightHand", "foot_ik.L": "LeftFoot", "foot_ik.R": "RightFoot"}


def armature():
    return next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")


def active(thing):
    for other in bpy.context.view_layer.objects:
        other.select_set(other == thing)
    bpy.context.view_layer.objects.active = thing
    return thing


def select_bones(thing, names):
    """Since Blender 5.0 a pose is selected, before it was its bone."""
    for bone in thing.pose.bones:
        chosen = bone if hasattr(bone, "select") else bone.bone
        chosen.select = bone.name in names


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


def of_vrm(path, folder):
    """A VRM avatar that plays a VRMA, both written and read by the VRM add-on."""
    thing = of_bvh(path, 0.01)
    bpy.ops.preferences.addon_enable(module="io_scene_vrm")
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = (int(end) for end in thing.animation_data.action.curve_frame_range)
    fps, about = scene.render.fps, thing.data.vrm_addon_extension
    about.spec_version = "1.0"
    about.vrm1.meta.vrm_name, about.vrm1.meta.version = "kick", "1"
    about.vrm1.meta.authors.add().value = "nobody"
    for bone in thing.data.bones:
        own = HUMANOID.get(bone.name)
        if own:
            bone.name = own
            human = re.sub("[A-Z]", lambda letter: f"_{letter[0].lower()}", own)
            getattr(about.vrm1.humanoid.human_bones, human).node.bone_name = own
    motion, avatar = str(folder / "take.vrma"), str(folder / "avatar.vrm")
    assert bpy.ops.export_scene.vrma(filepath=motion, armature_object_name=thing.name) == {"FINISHED"}
    thing.animation_data_clear()
    bpy.ops.mesh.primitive_cube_add(size=0.2)
    skin = bpy.context.active_object
    skin.parent, skin.parent_type, skin.parent_bone = active(thing), "BONE", "hips"
    assert bpy.ops.export_scene.vrm(filepath=avatar, armature_object_name=thing.name) == {"FINISHED"}
    empty(fps)
    bpy.ops.preferences.addon_enable(module="io_scene_vrm")
    assert bpy.ops.import_scene.vrm(filepath=avatar) == {"FINISHED"}
    thing = active(armature())
    assert bpy.ops.import_scene.vrma(filepath=motion, armature_object_name=thing.name) == {"FINISHED"}
    return active(thing)


def of_mmd(path):
    """A rig as MMD's models have it: legs on IK, bones for the skin that copy them, the body's halves on a centre."""
    source = of_bvh(path, 0.01)
    names = {**MMD, **{side + own: jp + its for side, jp in SIDES.items() for own, its in MMD_OF_SIDE.items()}}
    first, last = (int(end) for end in source.animation_data.action.curve_frame_range)
    rest = {name: bone.matrix_local.copy() for name, bone in ((bone.name, bone) for bone in source.data.bones)}
    tails = {bone.name: bone.tail_local.copy() for bone in source.data.bones}
    poses = {}
    for frame in range(first, last + 1):
        bpy.context.scene.frame_set(frame)
        poses[frame] = {bone.name: bone.matrix.copy() for bone in source.pose.bones}
    data = bpy.data.armatures.new("model")
    thing = bpy.data.objects.new("model", data)
    bpy.context.scene.collection.objects.link(thing)
    thing.matrix_world = source.matrix_world
    bpy.data.objects.remove(source)
    bpy.context.view_layer.update()
    active(thing)
    bpy.ops.object.mode_set(mode="EDIT")
    place = lambda joint: rest[joint].translation
    up = 0.1 * (place("Head") - place("Hips"))
    mmd_bone(data, "全ての親", None, Vector(), up)
    mmd_bone(data, "センター", "全ての親", place("Hips"), up)
    mmd_bone(data, "下半身", "センター", place("Hips"), -up)
    above = {"Spine": "センター", **{f"{side}{own}": its for side in SIDES for own, its in (("Shoulder", "上半身2"), ("UpLeg", "下半身"))}}
    for joint, name in names.items():
        over = above.get(joint) or names[parent_of(joint)]
        mmd_bone(data, name, over, place(joint), tails[joint] - place(joint))
    for side, jp in SIDES.items():
        mmd_bone(data, f"{jp}足ＩＫ", "全ての親", place(f"{side}Foot"), -up)
        for its, over in (("足", "下半身"), ("ひざ", f"{jp}足D"), ("足首", f"{jp}ひざD")):
            like = data.edit_bones[jp + its]
            mmd_bone(data, f"{jp}{its}D", over, like.head, like.tail - like.head)
    bpy.ops.object.mode_set(mode="OBJECT")
    constrain_mmd(thing)
    key_mmd(thing, {**{name: joint for joint, name in names.items()}, "下半身": "Hips"}, rest, poses)
    return active(thing)


def parent_of(joint):
    """The joint of data/*.bvh that one of a limb, or of the spine, hangs on."""
    side = next((side for side in SIDES if joint.startswith(side)), "")
    chain = ["Shoulder", "Arm", "ForeArm", "Hand"] if joint[len(side):] in ("Arm", "ForeArm", "Hand") else ["UpLeg", "Leg", "Foot", "ToeBase"]
    chain = [side + own for own in chain] if side else ["Spine", "Spine1", "Neck", "Head"]
    return chain[chain.index(joint) - 1]


def mmd_bone(data, name, over, head, way):
    bone = data.edit_bones.new(name)
    bone.head, bone.tail = head, head + way
    bone.parent = data.edit_bones[over] if over else None


def constrain_mmd(thing):
    for jp in SIDES.values():
        leg = thing.pose.bones[f"{jp}ひざ"].constraints.new("IK")
        leg.target, leg.subtarget, leg.chain_count = thing, f"{jp}足ＩＫ", 2
        for its in ("足", "ひざ", "足首"):
            copied = thing.pose.bones[f"{jp}{its}D"].constraints.new("COPY_ROTATION")
            copied.target, copied.subtarget = thing, jp + its
            copied.target_space = copied.owner_space = "LOCAL"


def key_mmd(thing, joints, rest, poses):
    """The body keyed by turns, centre and feet by place; the legs, which are keyed too, follow their IK."""
    def keyed(name, frame, wanted, what):
        bone = thing.pose.bones[name]
        over, above = bone.parent, bone.bone.parent
        hung = {"parent_matrix": stood[over.name], "parent_matrix_local": above.matrix_local} if over else {}
        stood[name] = wanted
        own = bone.bone.convert_local_to_pose(wanted, bone.bone.matrix_local, invert=True, **hung)
        setattr(bone, what, own.translation if what == "location" else own.to_quaternion())
        bone.keyframe_insert(what, frame=frame)

    own = {bone.name: bone.bone.matrix_local.copy() for bone in thing.pose.bones}
    for frame, pose in poses.items():
        stood = {"全ての親": own["全ての親"]}
        went = lambda joint, name: Matrix.Translation(pose[joint].translation - rest[joint].translation) @ own[name]
        keyed("センター", frame, went("Hips", "センター"), "location")
        for name, joint in sorted(joints.items(), key=lambda pair: len(thing.pose.bones[pair[0]].parent_recursive)):
            turn = (pose[joint] @ rest[joint].inverted()).to_quaternion() @ own[name].to_quaternion()
            wanted = turn.to_matrix().to_4x4()
            wanted.translation = pose[joint].translation
            keyed(name, frame, wanted, "rotation_quaternion")
        for side, jp in SIDES.items():
            keyed(f"{jp}足ＩＫ", frame, went(f"{side}Foot", f"{jp}足ＩＫ"), "location")
