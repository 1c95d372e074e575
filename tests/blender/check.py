"""python check.py CLIP.bvh FOLDER [OTHER]: what Blender makes of a run of genga, and what the add-on does in it.

A sheet of several layers is only put onto the take. OTHER is the folder of a run of another take, which is refused.
"""

import json
import sys
from pathlib import Path

import bpy

import addon
from addon import empty, refused, say

genga = addon.load()
from genga_addon import fit, stepping  # noqa: E402

# Of the body's size. Blender works in single precision, and angles of BVH go through it twice.
CLOSE = 2e-5
CLIP, FOLDER = Path(sys.argv[1]), Path(sys.argv[2])
OTHER = Path(sys.argv[3]) if len(sys.argv) > 3 else None
SHEET = json.loads((FOLDER / "sheet.json").read_text(encoding="utf-8"))
LAYER = SHEET["layers"][0]


def begins(layer):
    return [sum(e["koma"] for e in layer["exposures"][:at]) for at in range(len(layer["exposures"]))]


ROLES = {drawing["drawing"]: drawing["role"] for drawing in LAYER["drawings"]}
SHOWN = [exposure["drawing"] for exposure in LAYER["exposures"] for _ in range(exposure["koma"])]
BEGINS = begins(LAYER)
KEYS = [koma for koma, e in zip(BEGINS, LAYER["exposures"]) if ROLES[e["drawing"]] != "inbetween"]
TYPES = {"genga": "EXTREME", "end": "EXTREME", "inbetween": "BREAKDOWN"}


def held(drawing):
    """Whether it is a moving hold: a rest, or an inbetween that stands for others."""
    why = drawing.get("why", {})
    return why.get("reason") == "rest" or (drawing["role"] == "inbetween" and why.get("held_for", 0) > 0)


HELD = {drawing["drawing"] for drawing in LAYER["drawings"] if held(drawing)}


def armature():
    return next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")


def import_bvh(path, **options):
    bpy.ops.import_anim.bvh(filepath=str(path), **options)
    return armature()


def places(thing, names, frame):
    """Where the joints stand in the world at a frame."""
    bpy.context.scene.frame_set(int(frame // 1), subframe=frame % 1)
    bones = thing.pose.bones
    return [thing.matrix_world @ bones[name].head for name in names]


def curves(thing):
    animation = thing.animation_data
    return stepping.curves(animation.action, getattr(animation, "action_slot", None))


def furthest(a, b):
    return max((p - q).length for p, q in zip(a, b))


def check_keys(thing, koma, start, what):
    """Every curve: constant keys on those koma, typed by the role of what stands there."""
    for curve in curves(thing):
        points = curve.keyframe_points
        found = [point.co.x - start for point in points]
        assert max(abs(a - b) for a, b in zip(found, koma)) < 1e-4, (curve.data_path, found)
        assert len(found) == len(koma), (curve.data_path, len(found), len(koma))
        assert {point.interpolation for point in points} == {"CONSTANT"}, curve.data_path
    say(f"{what}: {len(curves(thing))} curves, constant keys on {len(koma)} koma")


def check_types(thing, start, with_holds):
    for curve in curves(thing):
        for point in curve.keyframe_points:
            koma = round(point.co.x - start)
            wanted = TYPES[ROLES[SHOWN[koma]]] if koma < len(SHOWN) else "KEYFRAME"
            if with_holds and SHOWN[koma] in HELD:
                wanted = "MOVING_HOLD"
            assert point.type == wanted, (curve.data_path, koma, point.type)


def stood():
    """The joints, and where they stand on each koma by limited.bvh."""
    empty()
    limited = import_bvh(FOLDER / "limited.bvh")
    names = [bone.name for bone in limited.data.bones]
    return names, [places(limited, names, 1 + koma) for koma in range(len(SHOWN))]


def take():
    """The take on an armature, which is active."""
    empty()
    thing = import_bvh(CLIP)
    bpy.context.view_layer.objects.active = thing
    return thing


def apply(folder=FOLDER, **options):
    return bpy.ops.genga.apply_sheet(filepath=str(folder / "sheet.json"), **options)


def own_frame(koma):
    """The frame of a scene of 30 a second that begins a koma, with koma 0 on frame 1."""
    return 1 + -(-koma * 30 // round(SHEET["fps"]))


def scene_of_30():
    empty(30)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 300
    scene.frame_set(7)
    return scene


def stays(scene):
    found = (scene.frame_start, scene.frame_end, scene.render.fps, scene.render.fps_base, scene.frame_current)
    assert found == (1, 300, 30, 1.0, 7), found


def check_own_scene(names, wanted):
    """In a scene of another rate a sheet goes onto two characters, and the scene stays as it is."""
    scene = scene_of_30()
    for scaled in (False, True):
        before = set(bpy.data.objects)
        bpy.ops.import_anim.bvh(filepath=str(CLIP), use_fps_scale=scaled)
        (thing,) = set(bpy.data.objects) - before
        bpy.context.view_layer.objects.active = thing
        scene.frame_set(7)
        assert apply(scaled=scaled) == {"FINISHED"}
        stays(scene)
        check_keys(thing, [own_frame(koma) - 1 for koma in BEGINS], 1, f"add-on, 30 a second, scaled: {scaled}")
        if not scaled:
            size = max((p - q).length for p in wanted[0] for q in wanted[0])
            off = max(furthest(places(thing, names, own_frame(koma)), pose) for koma, pose in enumerate(wanted)) / size
            assert off < CLOSE, off

    scene = scene_of_30()
    assert bpy.ops.genga.import_glb(filepath=str(FOLDER / "limited.glb")) == {"FINISHED"}
    stays(scene)
    check_keys(armature(), [own_frame(koma) - 1 for koma in [*BEGINS, len(SHOWN)]], 1, "add-on, limited.glb, 30 a second")

    empty(8)
    assert bpy.ops.genga.import_glb(filepath=str(FOLDER / "limited.glb")) == {"FINISHED"}
    last = {1 + -(-koma * 8 // round(SHEET["fps"])): TYPES[ROLES[SHOWN[koma]]] for koma in BEGINS}
    # In the kick some drawings share a frame; a slower motion may have none that do.
    assert CLIP.stem != "kick" or len(last) < len(BEGINS)
    for curve in curves(armature()):
        found = {point.co.x: point.type for point in curve.keyframe_points}
        assert all(found[frame] == role for frame, role in last.items()), "of drawings on one frame the last is kept"


def check_layers():
    """Each layer is on its own bones, and together they are the body."""
    names, wanted = stood()
    thing = take()
    assert apply() == {"FINISHED"}
    for curve in curves(thing):
        bone = fit.bone_of(curve.data_path)
        (layer,) = [layer for layer in SHEET["layers"] if bone in layer["joints"]]
        found = [round(point.co.x) - 1 for point in curve.keyframe_points]
        assert found == begins(layer), (curve.data_path, found)
    worst, size = 0.0, max((p - q).length for p in wanted[0] for q in wanted[0])
    for koma, pose in enumerate(wanted):
        worst = max(worst, furthest(places(thing, names, 1 + koma), pose) / size)
        assert worst < CLOSE, (koma, worst)
    say(f"add-on, {len(SHEET['layers'])} layers: all {len(wanted)} koma stand as in limited.bvh, off by {worst:.1e}")


def check_refusals():
    """Another take, a rig that plays nothing and one that is on a sheet already."""
    thing = take()
    played = thing.animation_data.action
    refused("seems to be another take", lambda: apply(OTHER))
    refused("source frame 0 is set to 5", lambda: apply(first_frame=5))
    assert thing.animation_data.action is played and len(bpy.data.actions) == 1, "nothing was done"
    assert apply(OTHER, anyway=True) == {"FINISHED"}
    refused("is already stepped", apply)
    thing.animation_data.action = None
    refused("has no action", apply)
    thing.animation_data_clear()
    refused("has no action", apply)
    bpy.context.view_layer.objects.active = None
    refused("Select the rig", apply)
    say("add-on: another take, no action, a sheet twice: refused; another take is taken where that is asked for")


def main():
    print(f"{FOLDER.name} in Blender {bpy.app.version_string}")
    koma = range(len(SHOWN))
    if len(SHEET["layers"]) > 1:
        genga.register()
        check_layers()
        return
    if OTHER:
        genga.register()
        check_refusals()
        genga.unregister()

    names, wanted = stood()
    for at in koma[1:]:
        if SHOWN[at] == SHOWN[at - 1]:
            assert wanted[at] == wanted[at - 1], f"koma {at} holds"
    assert bpy.context.scene.render.fps == 24
    same = sum(a == b for a, b in zip(SHOWN, SHOWN[1:]))
    say(f"limited.bvh: {len(SHOWN)} koma, {same} held ones identical to the koma before")

    empty()
    bpy.ops.import_scene.gltf(filepath=str(FOLDER / "limited.glb"))
    glb = armature()
    assert glb.animation_data.action.name.startswith("koma"), glb.animation_data.action.name
    check_keys(glb, [*BEGINS, len(SHOWN)], 0, "limited.glb")
    compare(glb, names, wanted, 0, None, "limited.glb")

    source = take()
    genga.register()
    played = source.animation_data.action
    before = [[tuple(point.co) for point in curve.keyframe_points] for curve in curves(source)]
    assert apply(set_scene=True) == {"FINISHED"}
    check_keys(source, BEGINS, 1, "add-on, sheet.json")
    check_types(source, 1, True)
    compare(source, names, wanted, 1, 1.0, "add-on, sheet.json")
    assert source.animation_data.action is not played
    after = [[tuple(point.co) for point in curve.keyframe_points] for curve in stepping.curves(played)]
    assert before == after, "the take itself stays"
    scene = bpy.context.scene
    assert (scene.frame_start, scene.frame_end, scene.render.fps) == (1, len(SHOWN), 24)

    empty()
    scene = bpy.context.scene
    scene.render.fps = 30
    assert bpy.ops.genga.import_glb(filepath=str(FOLDER / "limited.glb"), set_scene=True) == {"FINISHED"}
    imported = armature()
    check_keys(imported, [*BEGINS, len(SHOWN)], 1, "add-on, limited.glb")
    check_types(imported, 1, False)
    compare(imported, names, wanted, 1, None, "add-on, limited.glb")
    assert (scene.frame_start, scene.frame_end, scene.render.fps) == (1, len(SHOWN), 24)
    others = [action for action in bpy.data.actions if action.name.startswith("genga")]
    for curve in stepping.curves(others[0]):
        found = [round(point.co.x, 3) for point in curve.keyframe_points]
        assert found == [koma + 1 for koma in [*KEYS, len(SHOWN)]], found
        assert {point.type for point in list(curve.keyframe_points)[:-1]} == {"EXTREME"}
    say(f"add-on, limited.glb: animation genga, {len(KEYS)} extremes")
    check_own_scene(names, wanted)
    genga.unregister()


def compare(thing, names, wanted, start, scale, what):
    """Each koma against limited.bvh, on the frame and just before the next one.

    Without a scale it is that of the first pose, which is checked on all the others.
    """
    found = [places(thing, names, start + at) for at in range(len(SHOWN))]
    if scale is None:
        spread = lambda pose: sum((point - pose[0]).length for point in pose)
        scale = spread(found[0]) / spread(wanted[0])
    size = max((p - q).length for p in wanted[0] for q in wanted[0])
    worst = 0.0
    for at, pose in enumerate(found):
        worst = max(worst, furthest([point / scale for point in pose], wanted[at]) / size)
        assert worst < CLOSE, (what, at, worst)
        assert places(thing, names, start + at + 0.9) == pose, (what, at, "moves before the next koma")
    say(f"{what}: all {len(found)} koma stand as in limited.bvh, off by {worst:.1e} of the body at most")


addon.run(main)
