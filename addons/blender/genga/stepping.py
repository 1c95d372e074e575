# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes actions stepped: writes a sheet's poses as constant keys, and roles as keyframe types."""

from itertools import groupby

import bpy
import numpy as np
from mathutils import Euler, Quaternion

KEYFRAME_TYPES = {"genga": "EXTREME", "end": "EXTREME", "inbetween": "BREAKDOWN"}


def curves(action, slot=None):
    """Returns the curves of an action. Since Blender 4.4: of one slot, or of all."""
    if not hasattr(action, "layers"):
        return list(action.fcurves)
    found = []
    for layer in action.layers:
        for strip in layer.strips:
            for bag in strip.channelbags:
                if slot is None or bag.slot_handle == slot.handle:
                    found.extend(bag.fcurves)
    return found


def new_curve(action, slot, channel, group):
    """Creates a curve for a channel. Since Blender 4.4: in the first layer, for a slot."""
    (path, index), group = channel, {"action_group": group} if group else {}
    if not hasattr(action, "layers"):
        return action.fcurves.new(path, index=index, **group)
    layer = action.layers[0] if action.layers else action.layers.new("Layer")
    strip = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
    bag = strip.channelbag(slot, ensure=True)
    curve = bag.fcurves.new(path, index=index)
    if group:
        name = group["action_group"]
        curve.group = bag.groups.get(name) or bag.groups.new(name)
    return curve


class Source:
    """Evaluates the take's channels at a place. Interpolates rotations by slerp, other values linearly.

    `channels` are data paths with their indices. `value` returns a channel's value at a whole source frame. `mended` are
    frames with a glitch of the tracker, whose pose is taken from the frames beside them. `ways` are how far channels get
    in a round of a loop.
    """

    def __init__(self, owner, channels, value):
        path = lambda channel: channel[0]
        grouped = groupby(sorted(channels), path)
        self.groups = [(rotation(owner, path), list(group)) for path, group in grouped]
        self.value = value
        self.mended, self.ways = frozenset(), {}

    @classmethod
    def of_curves(cls, owner, action_curves, first_frame, step):
        """Reads curves. `first_frame` is the frame of source frame 0, `step` the Blender frames per source frame."""
        by_channel = {(curve.data_path, curve.array_index): curve for curve in action_curves}
        value = lambda channel, frame: by_channel[channel].evaluate(first_frame + frame * step)
        return cls(owner, by_channel, value)

    @classmethod
    def of_rows(cls, owner, channels, rows):
        """Reads recorded values, one row per source frame."""
        columns = {channel: at for at, channel in enumerate(channels)}
        last = len(rows) - 1
        return cls(owner, channels, lambda channel, frame: float(rows[min(int(frame), last), columns[channel]]))

    def pose(self, exposure, near):
        """Returns the values of all curves for an exposure. Angles are those nearest to the pose before."""
        if exposure.between is None:
            pose = self._at(exposure.frame, near)
        else:
            before, after = (self._at(place, near) for place in exposure.between)
            pose = self._blend(before, after, exposure.share, near)
        return self._further(pose, exposure.round) if exposure.round else pose

    def channels(self):
        """Returns the channels in the order of a pose's values."""
        return [channel for _, group in self.groups for channel in group]

    def rows(self, frames):
        """Returns the values of all channels on whole frames, one row each. Angles and quaternions go on without jumps."""
        table = np.array([[value for values in self._frame(frame) for value in values] for frame in frames])
        begin = 0
        for mode, group in self.groups:
            own = table[:, begin : begin + len(group)]
            if mode == "QUATERNION":
                own[1:] *= np.cumprod(np.where((own[1:] * own[:-1]).sum(axis=1) < 0.0, -1.0, 1.0))[:, None]
            elif mode is not None:
                own[:] = np.unwrap(own, axis=0)
            begin += len(group)
        return table

    def _further(self, pose, rounds):
        """Moves a pose on by a loop's way of some rounds."""
        way = lambda channel: rounds * self.ways.get(channel, 0.0)
        return [[value + way(channel) for channel, value in zip(group, own)] for (_, group), own in zip(self.groups, pose)]

    def _at(self, place, near):
        before = place // 1
        pose = self._frame(before)
        if place == before:
            return pose
        return self._blend(pose, self._frame(before + 1), place - before, near)

    def _frame(self, frame):
        if frame in self.mended:
            before, after = frame - 1, frame + 1
            while after in self.mended:
                after += 1
            return self._blend(self._frame(before), self._frame(after), 1.0 / (after - before), None)
        return [[self.value(channel, frame) for channel in group] for _, group in self.groups]

    def _blend(self, before, after, share, near):
        blends = []
        for at, (mode, _) in enumerate(self.groups):
            blends.append(blend(mode, before[at], after[at], share, near and near[at]))
        return blends


def rotation(owner, path):
    """Returns a property's rotation mode: the order of its angles, QUATERNION, or None."""
    if path.endswith("rotation_quaternion"):
        return "QUATERNION"
    if not path.endswith("rotation_euler"):
        return None
    holder, _, _ = path.rpartition(".")
    thing = owner.path_resolve(holder) if holder else owner
    mode = thing.rotation_mode
    return mode if len(mode) == 3 else "XYZ"


def blend(mode, before, after, share, near):
    """Blends rotations on the shortest arc, other values linearly."""
    if before == after:
        return before
    if mode == "QUATERNION" and len(before) == 4:
        turned = Quaternion(before).normalized().slerp(Quaternion(after).normalized(), share)
        if near and turned.dot(Quaternion(near)) < 0.0:
            turned.negate()
        return list(turned)
    if mode and len(before) == 3:
        ends = [Euler(angles, mode).to_quaternion() for angles in (before, after)]
        return list(ends[0].slerp(ends[1], share).to_euler(mode, Euler(near or before, mode)))
    return [a + share * (b - a) for a, b in zip(before, after)]


def turned(mode, values, turn):
    """Applies a rotation in local axes to a rotation property."""
    if mode == "QUATERNION":
        return list(Quaternion(values).normalized() @ turn)
    angles = Euler(values, mode)
    return list((angles.to_quaternion() @ turn).to_euler(mode, angles))


def type_of(exposure):
    """Returns the keyframe type of a drawing."""
    return "MOVING_HOLD" if exposure.is_held else KEYFRAME_TYPES.get(exposure.role, "KEYFRAME")


def as_taken(_source, _exposure, pose):
    """Returns a drawing's pose unchanged."""
    return pose


def write(target, source, exposures, frames, drawn=as_taken):
    """Writes the poses of the exposures to curves as constant keys on their frames. `drawn` modifies each pose."""
    rows, near = [], None
    for exposure in exposures:
        near = source.pose(exposure, near)
        rows.append([value for values in drawn(source, exposure, near) for value in values])
    columns = {channel: at for at, channel in enumerate(source.channels())}
    types = [type_of(exposure) for exposure in exposures]
    for curve in target:
        at = columns[curve.data_path, curve.array_index]
        put(curve, [number for frame, row in zip(frames, rows) for number in (frame, row[at])], types)


def put(curve, places, types):
    """Replaces a curve's keys and modifiers by constant keys. `places` alternates frame and value."""
    put_keys(curve, places, "CONSTANT", types)
    curve.update()


def put_curve(curve, frames, values, tangents, types):
    """Replaces a curve's keys and modifiers by keys with Bézier curves, or straight lines if there are no `tangents`.
    These are changes per frame."""
    put_keys(curve, np.stack([frames, values], axis=1).ravel(), "LINEAR" if tangents is None else "BEZIER", types)
    if tangents is not None:
        points, thirds = curve.keyframe_points, np.diff(frames) / 3.0
        for side, lengths in (("left", -np.append(thirds[:1], thirds)), ("right", np.append(thirds, thirds[-1:]))):
            points.foreach_set(f"handle_{side}_type", [number(f"handle_{side}_type", "FREE")] * len(types))
            # With handles a third of the way, time is even along the curve, which then is a cubic of time.
            points.foreach_set(f"handle_{side}", np.stack([frames + lengths, values + lengths * tangents], axis=1).ravel())
    curve.update()


def put_keys(curve, places, interpolation, types):
    """Replaces a curve's keys and modifiers. `places` alternates frame and value."""
    while curve.modifiers:
        curve.modifiers.remove(curve.modifiers[0])
    points = curve.keyframe_points
    points.clear()
    points.add(len(types))
    points.foreach_set("co", places)
    points.foreach_set("interpolation", [number("interpolation", interpolation)] * len(types))
    points.foreach_set("type", [number("type", name) for name in types])
    # So that a person selects only what is meant.
    for part in ("select_control_point", "select_left_handle", "select_right_handle"):
        points.foreach_set(part, [False] * len(types))


def number(name, word):
    """Returns Blender's number for an enum value of a key's property."""
    return bpy.types.Keyframe.bl_rna.properties[name].enum_items[word].value


def name_roles(action_curves, extras, timing):
    """Sets keyframe types by role in an action from a GLB whose keys are on koma, and moves them to their frames.

    If several share a frame, keeps the last drawing: the key at the end only repeats it.
    """
    roles = {key["koma"]: key["role"] for key in extras["keys"]}
    for curve in action_curves:
        shown = {}
        for point in curve.keyframe_points:
            koma = round(point.co.x)
            frame = timing.frame(koma)
            if koma in roles or frame not in shown:
                shown[frame] = point
        values = [(frame, point.co.y) for frame, point in shown.items()]
        types = [KEYFRAME_TYPES.get(roles.get(round(point.co.x)), "KEYFRAME") for point in shown.values()]
        put(curve, [number for place in values for number in place], types)
