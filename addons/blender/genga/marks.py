"""Marks on the timeline: keys that a person marked, frames that are selected, and markers for the genga."""

import bisect

import numpy as np

from . import stepping
from .take import BEGINS, PLACES, STEPPED


def marked(take):
    """The frames on which the take's own keys are marked as extremes."""
    if take.action is None:
        return []
    extreme, frames = stepping.number("type", "EXTREME"), set()
    for curve in stepping.curves(take.action, take.slot):
        types = np.empty(len(curve.keyframe_points), dtype=np.int32)
        curve.keyframe_points.foreach_get("type", types)
        for at in np.flatnonzero(types == extreme):
            frames.add(round(curve.keyframe_points[int(at)].co.x))
    return sorted(frames)


def chosen(context):
    """The frames of the take that are meant: those of the selected keys, or the current one."""
    thing = context.active_object
    animation = thing.animation_data
    action = animation.action if animation else None
    slot = getattr(animation, "action_slot", None)
    frames = set()
    if action is not None:
        for curve in stepping.curves(action, slot):
            frames |= {round(point.co.x) for point in curve.keyframe_points if point.select_control_point}
    frames = frames or {context.scene.frame_current}
    return sorted({of_take(action, frame) for frame in frames})


def of_take(action, frame):
    """The frame of the take that is shown on a frame: on a sheet that of the drawing."""
    if action is None or STEPPED not in action or BEGINS not in action:
        return frame
    at = bisect.bisect_right(list(action[BEGINS]), frame) - 1
    return round(action[PLACES][max(at, 0)])


def set_markers(scene, thing, numbered):
    """Markers on the timeline for the genga of an object, in place of its earlier ones."""
    remove_markers(scene, thing)
    for number, frame in numbered:
        scene.timeline_markers.new(f"{number} {thing.name}", frame=frame)


def remove_markers(scene, thing):
    def is_its(marker):
        number, _, name = marker.name.partition(" ")
        return name == thing.name and number.isdigit()

    for marker in [marker for marker in scene.timeline_markers if is_its(marker)]:
        scene.timeline_markers.remove(marker)
