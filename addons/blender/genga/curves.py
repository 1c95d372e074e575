# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys with Curves: the genga as keys, with Bézier curves between them that stay close to the take."""

import bpy
import numpy as np
from bpy.types import Operator

from . import apply, findings, motion, preferences, stepping
from .modal import Stepwise
from .refused import Refused, engine
from .sample import Sampling
from .subject import armature_of, editable
from .take import KEYS, Take, show

# Part of the allowed error, as an angle in radians, by which a turn may be off a straight line to be one. What hangs on a
# joint is about a body height long at the most.
STRAIGHT = 0.1


class GENGA_OT_curves(Stepwise, Operator):
    """Write the genga as keys with smooth curves between them into an action of their own. Keys are added where the motion would be further off the take than Curve Error. Esc cancels"""

    bl_idname = "genga.curves"
    bl_label = "Keys with Curves"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return armature_of(context) is not None

    def steps(self, context):
        thing = editable(context)
        take = Take(thing)
        if findings.of(thing) is None:
            findings.again(context, thing)
        finding = findings.of(thing)
        if finding is None or finding.result is None or not finding.sampled.is_of(take):
            raise Refused("this take has no sheet: find its keys first")
        keyed = KeyedTake(context, thing, take, finding)
        yield from keyed.steps()
        findings.tell(thing, [*finding.told(), keyed.told()])
        self.report({"INFO"}, keyed.told())


class KeyedTake:
    """A take as few keys with curves. `steps` adds keys to the genga until the rig is close enough to the take.

    `keys` are frames of the clip. `largest` is the largest distance from the take, a share of body height.
    """

    def __init__(self, context, thing, take, finding):
        self.thing, self.take = thing, take
        self.error = thing.genga.curve_error / 100.0
        self.genga = genga_of(finding.sheet(), finding.sampled.clip)
        self.keys, self.largest = list(self.genga), np.inf
        first, last = self.keys[0], self.keys[-1]
        self.start, self.first = finding.sampled.start, first
        self.source = apply.source_of(thing, take, finding.sampled, list(take.channels()))
        self.rows = self.source.rows(range(first, last + 1))
        self.wanted = motion.within(finding.sampled.clip, first, last + 1)
        self.sampling = Sampling(context, thing)
        if self.sampling.names() != self.wanted.names:
            raise Refused("other bones are left out now: find the keys first")
        self.sampling.within(self.start + first, self.start + last)

    def steps(self):
        """Writes and measures in turn. An error, or Esc, leaves everything as it was."""
        animation, earlier = self.thing.animation_data, apply.found(self.thing, self.take, KEYS)
        before = animation.action, getattr(animation, "action_slot", None)
        how = animation.action_blend_type, animation.action_influence
        action = bpy.data.actions.new(f"{self.take.name} {KEYS}")
        try:
            apply.label(action, self.thing, self.take, KEYS)
            slot = apply.slot_of(self.thing, self.take, action)
            target = apply.ensure_curves(action, slot, self.take.channels())
            preferences.paint(target, preferences.of(bpy.context).curves_colour)
            apply.play(self.thing, action, slot)
            yield from self.refine(action, slot, target)
        except BaseException:
            show(self.thing, *before)
            animation.action_blend_type, animation.action_influence = how
            bpy.data.actions.remove(action)
            raise
        action.use_frame_range = True
        action.frame_start, action.frame_end = self.start + self.keys[0], self.start + self.keys[-1]
        if earlier is not None:
            name = earlier.name
            bpy.data.actions.remove(earlier)
            action.name = name

    def refine(self, action, slot, target):
        """Adds the worst frame of each span that is too far off, until there is none."""
        more = [None]
        while more:
            self.write(target)
            yield from self.sampling.play(action, slot)
            off = self.wanted.distances(self.sampling.clip())
            self.largest = float(off.max())
            more = [int(at) + self.first for at in worst(off, [key - self.first for key in self.keys], self.error)]
            self.keys = sorted({*self.keys, *more})

    def write(self, target):
        """Writes the keys with the best curves between them."""
        rows = [key - self.first for key in self.keys]
        tangents = engine().tangents(rows, self.rows)
        frames = np.array(self.keys, dtype=np.float64) + self.start
        types = ["EXTREME" if key in self.genga else "BREAKDOWN" for key in self.keys]
        straight = self.straight(rows)
        columns = {channel: at for at, channel in enumerate(self.source.channels())}
        for curve in target:
            at = columns[curve.data_path, curve.array_index]
            stepping.put_curve(curve, frames, self.rows[rows, at], None if straight[at] else tangents[:, at], types)

    def straight(self, rows):
        """Reports for each channel whether straight lines between the keys are enough."""
        places = np.arange(len(self.rows))
        turns = np.repeat(*zip(*((mode is not None, len(group)) for mode, group in self.source.groups)))
        lines = np.stack([np.interp(places, rows, channel[rows]) for channel in self.rows.T], axis=1)
        # A component of a quaternion changes by half the angle.
        most = np.where(turns, 0.5 * STRAIGHT * self.error, 1e-6 * np.abs(self.rows).max(axis=0))
        return np.abs(self.rows - lines).max(axis=0) <= most

    def told(self):
        added = len(self.keys) - len(self.genga)
        off = f"{100.0 * self.largest:.2f} % of body height off the take at most"
        return f"{len(self.keys)} keys with curves, {added} beside the genga; {off}"


def genga_of(sheet, clip):
    """Returns the frames of the clip that are genga of a sheet, in order; two or more."""
    first, last = clip.first, clip.first + len(clip) - 1
    kept = [exposure for layer in sheet.layers for exposure in layer.exposures if exposure.is_key]
    genga = sorted({min(max(round(exposure.place), first), last) for exposure in kept})
    if len(genga) < 2:
        raise Refused("a curve needs two genga, and the sheet has fewer")
    return genga


def worst(off, keys, error):
    """Returns the worst frame of each span between keys that is further off than `error`."""
    found = []
    for begin, end in zip(keys, keys[1:]):
        inside = off[begin + 1 : end]
        if len(inside) and inside.max() > error:
            found.append(begin + 1 + int(inside.argmax()))
    return found
