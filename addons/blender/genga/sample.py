# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples a rig's evaluated pose on every frame, with constraints, drivers and NLA tracks."""

import time
from typing import NamedTuple

import bpy
import numpy as np

from . import motion, rig
from .refused import Refused
from .take import Take, show


class Sampling:
    """Samples a take. `steps` samples one frame at a time, so that the window responds meanwhile."""

    def __init__(self, context, settings):
        self.thing = context.active_object
        if self.thing is None or self.thing.type != "ARMATURE":
            raise Refused("select the armature that plays the take")
        self.scene, self.context = context.scene, context
        self.take = Take(self.thing)
        self.start, self.end = frames_of(settings.frames, self.scene, self.take)
        if self.end < self.start:
            raise Refused("the range is empty: its end is before its start")
        self.bones = bones_of(self.thing)
        self.chosen = rig.choose(self.bones, settings.deforming, settings.leave_out)
        self.poses = np.empty((len(self), len(self.chosen.bones), 4, 4), dtype=np.float32)
        # The values of an NLA mix are in no curve, so they are recorded.
        self.channels = sorted(self.take.channels()) if self.take.is_mixed else []
        self.values = np.empty((len(self), len(self.channels)))
        self.seconds = 0.0

    def __len__(self):
        return self.end - self.start + 1

    def steps(self):
        """Samples one frame per step. Restores the scene's frame when it ends or is closed.

        Plays the take meanwhile, even if its sheet is shown.
        """
        frame, part = self.scene.frame_current, self.scene.frame_subframe
        animation = self.thing.animation_data
        shown = animation.action, getattr(animation, "action_slot", None)
        began = time.perf_counter()
        show(self.thing, self.take.action, self.take.slot)
        try:
            for row in range(len(self)):
                self.scene.frame_set(self.start + row)
                self.take_frame(row)
                yield row
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

    def sampled(self):
        """Returns the sampled take as plain data, which survives an undo."""
        name, rate = bpy.path.clean_name(self.take.name), rate_of(self.scene)
        rest = np.array(self.thing.matrix_world) @ np.stack([self.bones[at].rest for at in self.chosen.bones])
        clip = motion.clip(self.bones, self.chosen, self.poses, rest, rate, name)
        return Sampled(clip, rest, self.take.name, self.start, self.end, rate, self.channels, self.values)


class Sampled(NamedTuple):
    """A sampled take. `rest` has the 4 × 4 world rest matrix of each bone of the clip. `channels` and `values`, one row
    per frame, are recorded if NLA tracks are mixed."""

    clip: object
    rest: np.ndarray
    take: str
    start: int
    end: int
    rate: float
    channels: list
    values: np.ndarray


def rate_of(scene):
    """Returns the scene's frames per second."""
    return scene.render.fps / scene.render.fps_base


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
