# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples a rig's evaluated pose on every frame, with constraints, drivers and NLA tracks."""

import time
from typing import NamedTuple

import bpy
import numpy as np

from . import fit, motion, rig
from .modal import Progress
from .refused import Refused
from .take import Take, show

# Share by which a rate may differ from a whole one to be that.
SAME = 1e-5


class Sampling:
    """Samples a take. `steps` samples one frame at a time, so that the window responds meanwhile."""

    def __init__(self, context, thing):
        self.thing, settings = thing, thing.genga
        self.scene, self.context = context.scene, context
        self.take = Take(self.thing)
        self.is_cleaned = settings.clean
        self.bones = bones_of(self.thing)
        self.chosen = rig.choose(self.bones, settings.deforming, settings.leave_out)
        # The values of an NLA mix are in no curve, so they are recorded.
        self.channels = sorted(self.take.channels()) if self.take.is_mixed else []
        self.within(*frames_of(settings.frames, self.scene, self.take))

    def within(self, start, end):
        """Chooses the frames to sample."""
        if end < start:
            raise Refused("the range is empty: its end is before its start")
        self.start, self.end = start, end
        self.poses = np.empty((len(self), len(self.chosen.bones), 4, 4), dtype=np.float32)
        self.values = np.empty((len(self), len(self.channels)))
        self.seconds = 0.0

    def __len__(self):
        return self.end - self.start + 1

    def steps(self):
        """Samples the take, one frame per step."""
        return self.play(self.take.action, self.take.slot)

    def play(self, action, slot):
        """Samples an action, one frame per step. Plays it meanwhile, even if the sheet is shown, and restores that and
        the scene's frame when it ends or is closed."""
        frame, part = self.scene.frame_current, self.scene.frame_subframe
        animation = self.thing.animation_data
        shown = animation.action, getattr(animation, "action_slot", None)
        began = time.perf_counter()
        show(self.thing, action, slot)
        try:
            for row in range(len(self)):
                self.scene.frame_set(self.start + row)
                self.take_frame(row)
                yield Progress("frame", row + 1, len(self))
        finally:
            show(self.thing, *shown)
            self.scene.frame_set(frame, subframe=part)
            self.seconds = time.perf_counter() - began

    def take_frame(self, row):
        drawn = self.thing.evaluated_get(self.context.evaluated_depsgraph_get())
        flat = np.empty(16 * len(self.bones), dtype=np.float32)
        drawn.pose.bones.foreach_get("matrix", flat)
        # Blender's matrices are column-major.
        own = flat.reshape(-1, 4, 4).transpose(0, 2, 1)[self.chosen.bones]
        self.poses[row] = np.array(drawn.matrix_world, dtype=np.float32) @ own
        for at, (path, index) in enumerate(self.channels):
            value = drawn.path_resolve(path)
            self.values[row, at] = value[index] if hasattr(value, "__len__") else value

    def names(self):
        """Returns the names of the clip's bones."""
        return [self.bones[at].name for at in self.chosen.bones]

    def rest(self):
        """Returns the world rest matrix of each bone of the clip."""
        return np.array(self.thing.matrix_world) @ np.stack([self.bones[at].rest for at in self.chosen.bones])

    def clip(self):
        """Returns the sampled motion."""
        name = bpy.path.clean_name(self.take.name)
        return motion.clip(self.bones, self.chosen, self.poses, self.rest(), rate_of(self.scene), name)

    def sampled(self):
        """Returns the sampled take as plain data, which survives an undo."""
        whole = self.clip()
        clip, mended = motion.cleaned(whole) if self.is_cleaned else (whole, frozenset())
        source = self.take.action.session_uid if self.take.action else None
        rate = rate_of(self.scene)
        return Sampled(clip, mended, self.rest(), source, self.start, self.end, rate, self.channels, self.values)


class Sampled(NamedTuple):
    """A sampled take. `clip` counts its frames from `start` and lacks inserted poses, `mended` are its frames with a
    glitch. `rest` has the 4 × 4 world rest matrix of each bone of the clip. `source` is the take's action by its id of the
    session. `channels` and `values`, one row per frame, are recorded if NLA tracks are mixed."""

    clip: object
    mended: frozenset
    rest: np.ndarray
    source: object
    start: int
    end: int
    rate: float
    channels: list
    values: np.ndarray

    def is_of(self, take):
        """Reports whether it is of that take."""
        return self.source == (take.action.session_uid if take.action else None)

    def told(self):
        """Says what of the take is no motion."""
        first, last = self.start + self.clip.first, self.start + self.clip.first + len(self.clip) - 1
        found = []
        for begin, end in ((self.start, first - 1), (last + 1, self.end)):
            if begin <= end:
                frames = f"frame {begin} is" if begin == end else f"frames {begin} to {end} are"
                found.append(f"{frames} no motion but an inserted pose, and left out (Clean Capture)")
        if self.mended:
            frames = fit.listed([str(self.start + frame) for frame in sorted(self.mended)])
            found.append(f"glitches of the capture are mended (Clean Capture): {frames}")
        return found


def rate_of(scene):
    """Returns the scene's frames per second. Files write a frame's time with few digits: 120.0005 is 120."""
    rate = scene.render.fps / scene.render.fps_base
    return float(round(rate)) if abs(rate - round(rate)) < SAME * rate else rate


def frames_of(which, scene, take):
    """Returns the range of the take, or of the scene (its preview range if set)."""
    if which == "TAKE":
        return take.frames()
    if scene.use_preview_range:
        return scene.frame_preview_start, scene.frame_preview_end
    return scene.frame_start, scene.frame_end


def bones_of(thing):
    """Returns the rest bones, in the order of the pose bones."""
    numbers = {bone.name: at for at, bone in enumerate(thing.pose.bones)}

    def bone_of(posed):
        bone = posed.bone
        parent = numbers[bone.parent.name] if bone.parent else -1
        rest = np.array(bone.matrix_local)
        return rig.Bone(bone.name, parent, rest, bone.length, bone.use_deform, bone.genga_left_out)

    return [bone_of(posed) for posed in thing.pose.bones]
