# SPDX-License-Identifier: GPL-3.0-or-later
"""Applies a sheet to the rig: a separate action with constant keys. The take's action stays unchanged."""

import bpy

from . import fit, preferences, stepping, travel
from .legs import Legs
from .take import BEGINS, KIND, KOMA, OWNER, PLACES, SLOT, SOURCE, STEPPED, show
from .timing import Timing


class OnSheet:
    """The stepped action: the action, its exposures with their frames, and sentences about what it cannot show."""

    def __init__(self, action, exposures, frames, left_out):
        self.action = action
        self.exposures, self.frames = exposures, frames
        self.left_out = left_out


def apply(thing, take, sampled, sheet, turns):
    """Applies a sheet of the sampled take to the rig and plays it. `turns` are the leg rotations for held feet."""
    action, slot = action_for(thing, take, KOMA)
    target = ensure_curves(action, slot, take.channels())
    preferences.paint(target, preferences.of(bpy.context).sheet_colour)
    legs = Legs(thing, take.channels(), turns)
    parts, _ = fit.by_layer(sheet.layers, sheet.joints, {curve.data_path for curve in target})
    timing = Timing(sampled.start + sheet.begin, sampled.rate, sheet.fps)
    for layer, paths in zip(sheet.layers, parts):
        exposures, frames = timing.of(layer.exposures)
        own = [curve for curve in target if curve.data_path in paths]
        channels = [(curve.data_path, curve.array_index) for curve in own]
        source = source_of(thing, take, sampled, channels)
        if sheet.round:
            source.ways = travel.ways(thing, source, sheet.first, sheet.first + sheet.round)
        stepping.write(own, source, exposures, frames, legs.drawn)
    exposures, frames = timing.of(sheet.layers[0].exposures)
    note(action, sampled.start, exposures, frames)
    action.use_frame_range = True
    action.frame_start, action.frame_end = timing.frame(0), timing.frame(sheet.length)
    play(thing, action, slot)
    return OnSheet(action, exposures, frames, legs.left_out())


def source_of(thing, take, sampled, channels):
    """Returns the source of the values: the take's curves, or the recorded values of an NLA mix."""
    if take.is_mixed:
        columns = [sampled.channels.index(channel) for channel in channels]
        source = stepping.Source.of_rows(thing, channels, sampled.values[:, columns])
    else:
        wanted = set(channels)
        curves = [curve for curve in take.curves() if (curve.data_path, curve.array_index) in wanted]
        source = stepping.Source.of_curves(thing, curves, sampled.start, 1.0)
    source.mended = sampled.mended
    return source


def found(thing, take, kind):
    """Returns the action of a kind that an earlier run made of this take for this armature, or None."""
    owner = thing.genga.own_id
    is_its = lambda action: owner and (action.get(OWNER), action.get(KIND)) == (owner, kind)
    return next((action for action in bpy.data.actions if is_its(action) and action.get(SOURCE) == take.action), None)


def action_for(thing, take, kind):
    """Returns the action of a kind for a take, and its slot if Blender has slots. Each armature has its own."""
    action = found(thing, take, kind) or bpy.data.actions.new(f"{take.name} {kind}")
    label(action, thing, take, kind)
    return action, slot_of(thing, take, action)


def label(action, thing, take, kind):
    """Notes in a made action whose it is, and of what take."""
    action[STEPPED], action[OWNER], action[KIND] = take.name, thing.genga.own_id, kind
    if take.slot:
        action[SLOT] = take.slot.handle
    if take.action:
        action[SOURCE] = take.action
        # Saves the take's action even though nothing plays it.
        if take.action.library is None:
            take.action.use_fake_user = True


def slot_of(thing, take, action):
    """Returns the object's slot in a made action, and creates it if missing. None before Blender 4.4."""
    if not hasattr(action, "slots"):
        return None
    name = take.slot.name_display if take.slot else thing.name
    return action.slots[0] if action.slots else action.slots.new(id_type="OBJECT", name=name)


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
    """Returns the genga's numbers, as on the sheet, with their frames. A loop has those of its first round."""
    keys = [(exposure, frame) for exposure, frame in zip(exposures, frames) if exposure.is_key]
    numbers = {}
    for exposure, _ in keys:
        numbers.setdefault(exposure.place, exposure.number or str(len(numbers) + 1))
    return [(numbers[exposure.place], frame) for exposure, frame in keys]


def play(thing, action, slot):
    """Makes the object play the action in place of its NLA tracks."""
    animation = thing.animation_data
    show(thing, action, slot)
    animation.action_blend_type, animation.action_influence = "REPLACE", 1.0
