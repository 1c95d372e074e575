"""What the add-on makes on a rig: its actions, keys, markers and poses."""

import json
import os
import subprocess
import tempfile
from pathlib import Path

import bpy
import numpy as np

import addon

genga = addon.load()
from genga_addon import stepping, take  # noqa: E402

PROGRAM = os.environ["GENGA"]
FOLDER = Path(tempfile.mkdtemp())


def run(clip, name, *options):
    """The sheet of the program: what `sheet.json` of a run says."""
    out = FOLDER / name
    subprocess.run([PROGRAM, "run", str(clip), "--out", str(out), "--quiet", *options], check=True)
    return genga.files.Sheet(json.loads((out / "sheet.json").read_text(encoding="utf-8")))


def cycles(clip):
    """The first and the last frame of each round that the program finds in a clip, the closest first."""
    import genga as engine

    found = engine.read(clip).cycles()
    return list(zip(found["first"].tolist(), found["last"].tolist()))


def columns(sheet):
    """What stands on which koma of each layer: place in the take, role."""
    return [[(own.koma, own.place, own.role) for own in layer.exposures] for layer in sheet.layers]


def find(thing=None):
    thing = thing or bpy.context.active_object
    assert bpy.ops.genga.find_keys() == {"FINISHED"}
    return thing.animation_data.action


def begin(make, *options):
    """A rig with a take, and the add-on."""
    thing = make(*options)
    if not hasattr(bpy.types.Object, "genga"):
        genga.register()
    return thing


def all_keys(action, slot=None):
    """Every key of an action, to the last bit."""
    rows = []
    for curve in stepping.curves(action, slot):
        places = np.empty(2 * len(curve.keyframe_points), dtype=np.float32)
        curve.keyframe_points.foreach_get("co", places)
        rows.append((curve.data_path, curve.array_index, places.tobytes()))
    return rows


def pose(thing, frame):
    """The whole pose in the world at a frame, to the last bit."""
    bpy.context.scene.frame_set(int(frame // 1), subframe=frame % 1)
    drawn = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return b"".join(np.array(drawn.matrix_world @ bone.matrix, dtype=np.float32).tobytes() for bone in drawn.pose.bones)


def check_held(thing, action):
    """Each drawing stands still, to the last bit, and is what the take has at its place where that is a whole frame."""
    begins, places = list(action[take.BEGINS]), list(action[take.PLACES])
    end = action.frame_range[1]
    held = 0
    for at, begin in enumerate(begins):
        until = begins[at + 1] if at + 1 < len(begins) else end
        stood = pose(thing, begin)
        for koma in range(int(begin), int(until)):
            assert pose(thing, koma) == stood and pose(thing, koma + 0.9) == stood, koma
            held += 1
    shown = {at: pose(thing, begin) for at, begin in enumerate(begins) if places[at] == places[at] // 1}
    bpy.ops.genga.toggle()
    size = max(thing.dimensions) or 1.0
    for at, drawn in shown.items():
        off = np.abs(np.frombuffer(drawn, np.float32) - np.frombuffer(pose(thing, places[at]), np.float32)).max()
        assert off < 1e-5 * max(size, 1.0), (at, off)
    bpy.ops.genga.toggle()
    assert thing.animation_data.action == action
    return held, len(shown)


def check_keys(action):
    """Constant keys alone, typed by role."""
    types = set()
    for curve in stepping.curves(action):
        assert [point.co.x for point in curve.keyframe_points] == list(action[take.BEGINS]), curve.data_path
        for point in curve.keyframe_points:
            assert point.interpolation == "CONSTANT"
            types.add(point.type)
    assert {"EXTREME", "BREAKDOWN"} <= types <= {"EXTREME", "BREAKDOWN", "MOVING_HOLD"}, types


def marks_of():
    """The markers that pin or forbid: name and frame."""
    markers = bpy.context.scene.timeline_markers
    return sorted((genga.pins.plain(marker.name), marker.frame) for marker in markers if not marker.name[0].isdigit())
