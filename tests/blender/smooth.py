"""python smooth.py FOLDER: the motions that the example smooth_keys wrote into the folder, beside Blender's own decimation.

Prints a table: for each clip and number of keys, the mean and the largest distance from the take of all joints and tips, in
% of body height. Decimation gets as many keys: on every curve (ratio), or in all (error), where each curve has its own.
"""

import csv
import sys
from pathlib import Path

import bpy
import numpy as np

FOLDER = Path(sys.argv[1])
# A curve that varies by less moves by rounding alone.
STILL = 1e-4
# Powers of ten between which the error margin is searched, and how often their distance is halved.
MARGINS, HALVINGS = (-4.0, 0.0), 8


def imported(path):
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.import_anim.bvh(filepath=str(path), update_scene_duration=True)
    return next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")


def places(thing):
    """Joints and tips on every frame: frames × points × 3."""
    scene = bpy.context.scene
    bones = thing.pose.bones
    rows = []
    for frame in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        tips = [bone.tail for bone in bones if not bone.children]
        rows.append([point.copy() for point in [bone.head for bone in bones] + tips])
    return np.array(rows)


def curves(action):
    return [curve for curve in action.fcurves if np.ptp(values(curve)) > STILL]


def values(curve):
    found = np.empty(2 * len(curve.keyframe_points))
    curve.keyframe_points.foreach_get("co", found)
    return found[1::2]


def count(action):
    return sum(len(curve.keyframe_points) for curve in action.fcurves)


def prepare(thing):
    """Leaves out curves that never move, and makes all keys Bézier ones with the handles that decimation does best with."""
    action = thing.animation_data.action
    moving = {(curve.data_path, curve.array_index) for curve in curves(action)}
    for curve in list(action.fcurves):
        if (curve.data_path, curve.array_index) not in moving:
            action.fcurves.remove(curve)
    for curve in action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "BEZIER"
            point.handle_left_type = point.handle_right_type = "AUTO"
            point.select_control_point = True
        curve.update()
    return action


def show(thing, action):
    thing.animation_data.action = action
    thing.animation_data.action_slot = action.slots[0]


def decimate(thing, source, **how):
    """Decimates a copy of an action in a graph editor."""
    action = source.copy()
    show(thing, action)
    window = bpy.context.window_manager.windows[0]
    area = window.screen.areas[0]
    area.type = "GRAPH_EDITOR"
    area.spaces[0].dopesheet.show_only_selected = False
    bpy.context.view_layer.objects.active = thing
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        assert bpy.ops.graph.decimate(**how) == {"FINISHED"}
    return action


def by_ratio(thing, source, keys):
    """As many keys on every curve."""
    frames = len(source.fcurves[0].keyframe_points)
    return decimate(thing, source, mode="RATIO", factor=(frames - keys) / frames)


def by_error(thing, source, keys):
    """At most as many keys in all, at the least error margin found."""
    most = keys * len(source.fcurves)
    (low, high), best = MARGINS, None
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        action = decimate(thing, source, mode="ERROR", remove_error_margin=10**middle)
        if count(action) > most:
            low = middle
        else:
            high, best = middle, action
    show(thing, best)
    return best


def measured(made, take, height):
    off = np.linalg.norm(made - take, axis=2)
    return [f"{100 * share / height:.2f}" for share in (off.mean(), off.max())]


def main():
    rows = list(csv.DictReader((FOLDER / "made.csv").open()))
    takes = {}
    print("clip,density,method,keys a curve,mean,largest")
    for row in rows:
        name, height = row["clip"], float(row["height"])
        if name not in takes:
            takes[name] = places(imported(FOLDER / f"{name}.take.bvh"))
        made = places(imported(FOLDER / f"{name}.{row['density']}.{row['method']}.bvh"))
        print(",".join([name, row["density"], row["method"], row["keys"], *measured(made, takes[name], height)]), flush=True)
    for row in (row for row in rows if row["method"] == "genga"):
        name, height = row["clip"], float(row["height"])
        for way, decimated in (("ratio", by_ratio), ("error", by_error)):
            thing = imported(FOLDER / f"{name}.take.bvh")
            source = prepare(thing)
            keys = count(decimated(thing, source, int(row["keys"]))) / len(source.fcurves)
            made = measured(places(thing), takes[name], height)
            print(",".join([name, row["density"], f"decimate {way}", f"{keys:.1f}", *made]), flush=True)


main()
