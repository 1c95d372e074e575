# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks on the timeline: keys of type Extreme, selected frames, and markers for the genga."""

import bisect
import re

import numpy as np

from . import stepping
from .take import BEGINS, PLACES, STEPPED

# The number of a genga: 3, or 3a for one that came later.
NUMBER = re.compile("[0-9]+[a-z]*")


def marked(take):
    """Returns the frames on which the take has keys of type Extreme."""
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
    """Returns the take's frames of the selected keys, or the current frame."""
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
    """Returns the take's frame shown on a frame. In a stepped action it is the drawing's frame."""
    if action is None or STEPPED not in action or BEGINS not in action:
        return frame
    at = bisect.bisect_right(list(action[BEGINS]), frame) - 1
    return round(action[PLACES][max(at, 0)])


def set_markers(scene, thing, numbered):
    """Replaces an object's timeline markers by markers for its genga."""
    remove_markers(scene, thing)
    for number, frame in numbered:
        scene.timeline_markers.new(f"{number} {thing.name}", frame=frame)


def remove_markers(scene, thing):
    def is_its(marker):
        number, _, name = marker.name.partition(" ")
        return name == thing.name and NUMBER.fullmatch(number)

    for marker in [marker for marker in scene.timeline_markers if is_its(marker)]:
        scene.timeline_markers.remove(marker)
