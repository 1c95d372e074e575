"""Actions made stepped: a sheet's poses as constant keys, and roles as types of keys."""

from itertools import groupby

from mathutils import Euler, Quaternion

KEYFRAME_TYPES = {"genga": "EXTREME", "end": "EXTREME", "inbetween": "BREAKDOWN"}


def curves(action, slot=None):
    """The curves of an action; since Blender 4.4 those of one slot, or of all."""
    if not hasattr(action, "layers"):
        return list(action.fcurves)
    found = []
    for layer in action.layers:
        for strip in layer.strips:
            for bag in strip.channelbags:
                if slot is None or bag.slot_handle == slot.handle:
                    found.extend(bag.fcurves)
    return found


class Source:
    """An action as the take that a sheet was made of.

    `first_frame` is where source frame 0 lies, `step` how many Blender frames a source frame takes.
    """

    def __init__(self, owner, action_curves, first_frame, step):
        self.first_frame = first_frame
        self.step = step
        path = lambda curve: curve.data_path
        ordered = sorted(action_curves, key=lambda curve: (curve.data_path, curve.array_index))
        self.groups = [(rotation(owner, path), list(group)) for path, group in groupby(ordered, path)]
        self.curves = [curve for _, group in self.groups for curve in group]

    def pose(self, exposure, near):
        """The value of every curve for an exposure; angles are the nearest ones to a pose before."""
        if exposure.between is None:
            return self._at(exposure.frame, near)
        before, after = (self._at(place, near) for place in exposure.between)
        return self._blend(before, after, exposure.share, near)

    def _at(self, place, near):
        before = place // 1
        pose = self._frame(before)
        if place == before:
            return pose
        return self._blend(pose, self._frame(before + 1), place - before, near)

    def _frame(self, frame):
        at = self.first_frame + frame * self.step
        return [[curve.evaluate(at) for curve in group] for _, group in self.groups]

    def _blend(self, before, after, share, near):
        blends = []
        for at, (mode, _) in enumerate(self.groups):
            blends.append(blend(mode, before[at], after[at], share, near and near[at]))
        return blends


def rotation(owner, path):
    """How a property turns: the order of its angles, QUATERNION, or nothing."""
    if path.endswith("rotation_quaternion"):
        return "QUATERNION"
    if not path.endswith("rotation_euler"):
        return None
    holder, _, _ = path.rpartition(".")
    thing = owner.path_resolve(holder) if holder else owner
    mode = thing.rotation_mode
    return mode if len(mode) == 3 else "XYZ"


def blend(mode, before, after, share, near):
    """Straight for what moves, on the shortest arc for what turns."""
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


def write(target, source, exposures, start):
    """Puts the poses of the exposures onto curves, constant until the next."""
    keys = {(curve.data_path, curve.array_index): [] for curve in source.curves}
    near = None
    for exposure in exposures:
        near = source.pose(exposure, near)
        for (_, group), values in zip(source.groups, near):
            for curve, value in zip(group, values):
                keys[curve.data_path, curve.array_index].append((start + exposure.koma, value))
    for curve in target:
        while curve.modifiers:
            curve.modifiers.remove(curve.modifiers[0])
        points = curve.keyframe_points
        while points:
            points.remove(points[-1], fast=True)
        values = keys[curve.data_path, curve.array_index]
        points.add(len(values))
        for point, value, exposure in zip(points, values, exposures):
            point.co = value
            point.interpolation = "CONSTANT"
            point.type = KEYFRAME_TYPES.get(exposure.role, "KEYFRAME")
        curve.update()


def name_roles(action_curves, extras, start):
    """Keys of an action that came from a GLB: moved so that koma 0 is at `start`, and typed by role."""
    roles = {key["koma"]: key["role"] for key in extras["keys"]}
    for curve in action_curves:
        for point in curve.keyframe_points:
            role = roles.get(round(point.co.x))
            point.type = KEYFRAME_TYPES.get(role, "KEYFRAME")
            point.interpolation = "CONSTANT"
            point.co.x += start
        curve.update()
