# SPDX-License-Identifier: GPL-3.0-or-later
"""Applies a sheet to the rig: a separate action with constant keys. The take's action stays unchanged."""

import bpy

from . import fit, stepping
from .legs import Legs
from .take import BEGINS, OWNER, PLACES, SOURCE, STEPPED, show
from .timing import Timing


class OnSheet:
    """The stepped action: the action, its exposures with their frames, and sentences about what it cannot show."""

    def __init__(self, action, exposures, frames, left_out):
        self.action = action
        self.exposures, self.frames = exposures, frames
        self.left_out = left_out


def apply(thing, take, sampled, sheet, turns):
    """Applies a sheet of the sampled take to the rig and plays it. `turns` are the leg rotations for held feet."""
    action, slot = action_for(thing, take)
    target = ensure_curves(action, slot, take.channels())
    legs = Legs(thing, take.channels(), turns)
    parts, _ = fit.by_layer(sheet.layers, sheet.joints, {curve.data_path for curve in target})
    timing = Timing(sampled.start, sampled.rate, sheet.fps)
    for layer, paths in zip(sheet.layers, parts):
        exposures, frames = timing.of(layer.exposures)
        own = [curve for curve in target if curve.data_path in paths]
        channels = [(curve.data_path, curve.array_index) for curve in own]
        stepping.write(own, source_of(thing, take, sampled, channels), exposures, frames, legs.drawn)
    exposures, frames = timing.of(sheet.layers[0].exposures)
    note(action, sampled.start, exposures, frames)
    action.use_frame_range = True
    action.frame_start, action.frame_end = sampled.start, timing.frame(sheet.length)
    play(thing, action, slot)
    return OnSheet(action, exposures, frames, legs.left_out())


def source_of(thing, take, sampled, channels):
    """Returns the source of the values: the take's curves, or the recorded values of an NLA mix."""
    if take.is_mixed:
        columns = [sampled.channels.index(channel) for channel in channels]
        return stepping.Source.of_rows(thing, channels, sampled.values[:, columns])
    wanted = set(channels)
    curves = [curve for curve in take.curves() if (curve.data_path, curve.array_index) in wanted]
    return stepping.Source.of_curves(thing, curves, sampled.start, 1.0)


def found(thing, take):
    """Returns the stepped action that an earlier run made of this take for this object, or None."""
    is_its = lambda action: action.get(OWNER) == thing.name and action.get(SOURCE) == take.action
    return next((action for action in bpy.data.actions if is_its(action)), None)


def action_for(thing, take):
    """Returns the stepped action of a take, and its slot if Blender has slots. Each object has its own action."""
    action = found(thing, take) or bpy.data.actions.new(f"{take.name} koma")
    action[STEPPED], action[OWNER] = take.name, thing.name
    if take.action:
        action[SOURCE] = take.action
        # Saves the take's action even though nothing plays it.
        if take.action.library is None:
            take.action.use_fake_user = True
    return action, slot_of(thing, take, action)


def slot_of(thing, take, action):
    """Returns the object's slot in the stepped action, and creates it if missing. None before Blender 4.4."""
    if not hasattr(action, "slots"):
        return None
    name = take.slot.name_display if take.slot else thing.name
    own = [slot for slot in action.slots if slot.target_id_type == "OBJECT" and slot.name_display == name]
    return own[0] if own else action.slots.new(id_type="OBJECT", name=name)


def ensure_curves(action, slot, channels):
    """Returns a curve for each channel, and reuses those of an earlier run."""
    there = {(curve.data_path, curve.array_index): curve for curve in stepping.curves(action, slot)}
    return [there.get(channel) or stepping.new_curve(action, slot, channel, group) for channel, group in channels.items()]


def note(action, start, exposures, frames):
    """Stores in the action what is needed after reopening the file, and marks its genga with pose markers."""
    action[BEGINS] = [float(frame) for frame in frames]
    action[PLACES] = [start + exposure.place for exposure in exposures]
    markers = action.pose_markers
    while markers:
        markers.remove(markers[0])
    for name, frame in numbered(exposures, frames):
        markers.new(name).frame = frame


def numbered(exposures, frames):
    """Returns the genga's numbers, as on the sheet, with their frames."""
    keys = [(exposure, frame) for exposure, frame in zip(exposures, frames) if exposure.is_key]
    return [(exposure.number or str(at), frame) for at, (exposure, frame) in enumerate(keys, 1)]


def play(thing, action, slot):
    """Makes the object play the action in place of its NLA tracks."""
    animation = thing.animation_data
    show(thing, action, slot)
    animation.action_blend_type, animation.action_influence = "REPLACE", 1.0
