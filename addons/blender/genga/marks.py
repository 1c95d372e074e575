# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks on the timeline: markers that pin and forbid, keys of type Extreme, selected frames, numbers of the genga."""

import bisect
import re

import bpy
import numpy as np

from . import pins, stepping
from .refused import Refused
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


def names(thing):
    """Returns the names by which markers say that they are an armature's: its own, and that before it was renamed."""
    before = thing.genga.marked_as
    is_taken = before != thing.name and before in bpy.data.objects
    return {pins.clean(name) for name in (thing.name, before) if name and not (is_taken and name == before)}


def of(scene, thing):
    """Returns the markers that pin and forbid for an armature: its own, and those that are for all."""
    own = {"", *names(thing)}
    return [marker for marker in scene.timeline_markers if pins.is_mark(marker.name) and pins.owner(marker.name) in own]


def read(scene, thing):
    """Returns the corrections that an armature's markers say."""
    return pins.read([(pins.plain(marker.name), marker.frame) for marker in of(scene, thing)])


def add(scene, thing, named):
    """Adds markers for an armature where there are none: pairs of name and frame."""
    there = {(pins.first_word(marker.name), marker.frame) for marker in of(scene, thing)}
    for name, frame in named:
        if (pins.first_word(name), frame) not in there:
            make(scene, pins.owned(name, thing.name), frame)


def make(scene, name, frame):
    """Makes a marker. It is not selected, so that a person selects only what is meant."""
    scene.timeline_markers.new(name, frame=frame).select = False


def clear(scene, thing):
    """Removes all markers that pin or forbid for an armature."""
    for marker in of(scene, thing):
        scene.timeline_markers.remove(marker)


def chosen(context, thing):
    """Returns the take's frames to mark: of the selected keys in the dope sheet, else the current frame."""
    frames = selected(thing) if is_in_dope_sheet(context) else set()
    action = played(thing)
    return sorted({of_take(action, frame) for frame in frames or {context.scene.frame_current}})


def is_in_dope_sheet(context):
    return context.area is not None and context.area.type == "DOPESHEET_EDITOR"


def played(thing):
    return thing.animation_data.action if thing.animation_data else None


def selected(thing):
    """Returns the frames of the selected keys of what an object plays."""
    action, frames = played(thing), set()
    slot = getattr(thing.animation_data, "action_slot", None)
    for curve in stepping.curves(action, slot) if action else ():
        frames |= {round(point.co.x) for point in curve.keyframe_points if point.select_control_point}
    return frames


def passage(context, thing):
    """Returns the first and the last frame of the marked range: between selected markers, of the preview range, or of
    the selected keys."""
    scene = context.scene
    markers = [marker.frame for marker in scene.timeline_markers if marker.select]
    if len(set(markers)) > 1:
        return min(markers), max(markers)
    if scene.use_preview_range:
        return scene.frame_preview_start, scene.frame_preview_end
    keys = selected(thing) if is_in_dope_sheet(context) else ()
    if len(keys) > 1:
        return min(keys), max(keys)
    raise Refused("no range is marked: set a preview range (P in the timeline), or select two markers")


def of_take(action, frame):
    """Returns the take's frame shown on a frame. In a stepped action it is the drawing's frame."""
    if action is None or STEPPED not in action or BEGINS not in action:
        return frame
    at = bisect.bisect_right(list(action[BEGINS]), frame) - 1
    return round(action[PLACES][max(at, 0)])


def set_numbers(scene, thing, numbered):
    """Replaces an armature's timeline markers with numbers by those of its genga, and gives all its markers its name."""
    own = names(thing)
    for marker in list(scene.timeline_markers):
        number, _, name = marker.name.partition(" ")
        if NUMBER.fullmatch(number) and pins.clean(name) in own:
            scene.timeline_markers.remove(marker)
        elif pins.is_mark(marker.name) and pins.owner(marker.name) in own:
            marker.name = pins.owned(marker.name, thing.name)
    for number, frame in numbered:
        make(scene, f"{number} {thing.name}", frame)
    thing.genga.marked_as = thing.name
