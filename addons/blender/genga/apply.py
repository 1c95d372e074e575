"""A sheet onto the rig: an action of its own with constant keys on the drawings. The take's action is not touched."""

import math

import bpy

from . import fit, stepping
from .legs import Legs
from .take import BEGINS, OWNER, PLACES, SOURCE, STEPPED, show


# Of a frame: rates that are written with few digits are not quite those that are meant.
SAME = 0.01


class OnSheet:
    """The action on a sheet: which it is, what stands where, and what it does not show of the sheet, in sentences."""

    def __init__(self, action, exposures, frames, left_out):
        self.action = action
        self.exposures, self.frames = exposures, frames
        self.left_out = left_out


def apply(thing, take, sampled, sheet, turns):
    """Puts a sheet of what was sampled onto the rig, which then plays it. `turns` are those of legs that give way."""
    action, slot = action_for(thing, take)
    target = ensure_curves(action, slot, take.channels())
    legs = Legs(thing, take.channels(), turns)
    parts, _ = fit.by_layer(sheet.layers, sheet.joints, {curve.data_path for curve in target})
    timing = Timing(sampled, sheet.fps)
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


class Timing:
    """On which frame of the scene a koma begins: the first that shows it."""

    def __init__(self, sampled, fps):
        self.start, self.ratio = sampled.start, sampled.rate / fps

    def frame(self, koma):
        return self.start + math.ceil(koma * self.ratio - SAME)

    def of(self, exposures):
        """Exposures with their frames; of several on one frame, where the scene has fewer, the last."""
        shown = {self.frame(exposure.koma): exposure for exposure in exposures}
        return list(shown.values()), list(shown)


def source_of(thing, take, sampled, channels):
    """Where the values come from: the take's own curves, or what was recorded of a mix."""
    if take.is_mixed:
        columns = [sampled.channels.index(channel) for channel in channels]
        return stepping.Source.of_rows(thing, channels, sampled.values[:, columns])
    wanted = set(channels)
    curves = [curve for curve in take.curves() if (curve.data_path, curve.array_index) in wanted]
    return stepping.Source.of_curves(thing, curves, sampled.start, 1.0)


def found(thing, take):
    """The action on a sheet that an earlier run made of this take for this object, or nothing."""
    is_its = lambda action: action.get(OWNER) == thing.name and action.get(SOURCE) == take.action
    return next((action for action in bpy.data.actions if is_its(action)), None)


def action_for(thing, take):
    """The action on a sheet of a take, and its slot where Blender has slots. An action is for one object alone."""
    action = found(thing, take) or bpy.data.actions.new(f"{take.name} koma")
    action[STEPPED], action[OWNER] = take.name, thing.name
    if take.action:
        action[SOURCE] = take.action
        # It is saved though nothing plays it.
        if take.action.library is None:
            take.action.use_fake_user = True
    return action, slot_of(thing, take, action)


def slot_of(thing, take, action):
    """The slot of an action on a sheet that is the object's, made where it is missing; none before Blender 4.4."""
    if not hasattr(action, "slots"):
        return None
    name = take.slot.name_display if take.slot else thing.name
    own = [slot for slot in action.slots if slot.target_id_type == "OBJECT" and slot.name_display == name]
    return own[0] if own else action.slots.new(id_type="OBJECT", name=name)


def ensure_curves(action, slot, channels):
    """A curve for each channel, those of an earlier run among them."""
    there = {(curve.data_path, curve.array_index): curve for curve in stepping.curves(action, slot)}
    return [there.get(channel) or stepping.new_curve(action, slot, channel, group) for channel, group in channels.items()]


def note(action, start, exposures, frames):
    """What the action has to know when the file is opened again, and its genga as markers of its own."""
    action[BEGINS] = [float(frame) for frame in frames]
    action[PLACES] = [start + exposure.place for exposure in exposures]
    markers = action.pose_markers
    while markers:
        markers.remove(markers[0])
    for name, frame in numbered(exposures, frames):
        markers.new(name).frame = frame


def numbered(exposures, frames):
    """The numbers of the genga, as on the sheet, with their frames."""
    keys = [frame for exposure, frame in zip(exposures, frames) if exposure.is_key]
    return [(str(at), frame) for at, frame in enumerate(keys, 1)]


def play(thing, action, slot):
    """Lets the object play it, over whatever NLA tracks say."""
    animation = thing.animation_data
    show(thing, action, slot)
    animation.action_blend_type, animation.action_influence = "REPLACE", 1.0
