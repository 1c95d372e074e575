# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the program's files: applies a timesheet to an action, and imports a stepped GLB with key roles."""

from contextlib import contextmanager

import bpy
from bpy.props import BoolProperty, IntProperty, StringProperty
from bpy.types import Operator
from bpy_extras.io_utils import ImportHelper

from . import files, fit, stepping, travel
from .refused import Reported
from .take import STEPPED
from .timing import Timing


def rate_of(scene):
    return scene.render.fps / scene.render.fps_base


def set_rate(scene, fps):
    scene.render.fps = max(1, round(fps))
    scene.render.fps_base = scene.render.fps / fps


def set_scene(scene, fps, start, koma):
    """Sets the scene to the sheet's rate and length."""
    set_rate(scene, fps)
    scene.frame_start, scene.frame_end = start, start + koma - 1


@contextmanager
def at_rate(scene, fps):
    """Gives the scene a rate for a while, and leaves its rate, range and frame as they were."""
    render = scene.render
    before = (render.fps, render.fps_base, scene.frame_start, scene.frame_end, scene.frame_current)
    set_rate(scene, fps)
    try:
        yield
    finally:
        render.fps, render.fps_base, scene.frame_start, scene.frame_end, frame = before
        scene.frame_set(frame)


class Koma(Reported, ImportHelper):
    """Options of both operators."""

    start: IntProperty(
        name="First Koma",
        description="Frame of the sheet's first koma; 1 numbers frames as on paper",
        default=1,
    )
    set_scene: BoolProperty(
        name="Set Scene",
        description="Give the scene the sheet's rate and range; otherwise keys go to the scene's own frames, by time",
        default=False,
    )


class GENGA_OT_apply_sheet(Operator, Koma):
    """Keep only the poses of a genga timesheet, as constant keys in a copy of the active object's action"""

    bl_idname = "genga.apply_sheet"
    bl_label = "Apply genga Timesheet"
    bl_options = {"REGISTER", "UNDO"}
    filename_ext = ".json"

    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    first_frame: IntProperty(
        name="Source Frame 0",
        description="Frame of source frame 0; Blender's BVH import puts it on 1",
        default=1,
    )
    scaled: BoolProperty(
        name="Imported with Scale FPS",
        description="The import scaled the motion to the scene's rate",
        default=False,
    )
    layer: StringProperty(
        name="Layer",
        description="Layer to apply to all bones; if empty, each layer applies to its own bones",
    )
    anyway: BoolProperty(
        name="Apply Anyway",
        description="Continue even if the action seems to be another take, or is retargeted or trimmed",
        default=False,
    )

    @classmethod
    def poll(cls, context):
        if context.active_object is None:
            cls.poll_message_set("Select the rig that plays the take")
            return False
        return True

    def run(self, context):
        sheet = files.Sheet.read(self.filepath)
        layers = sheet.of(self.layer)
        thing, scene = context.active_object, context.scene
        action, slot = self.take_of(thing)
        step = rate_of(scene) / sheet.source_fps if self.scaled else 1.0
        self.compare(sheet, thing, action, step)
        take = stepping.curves(action, slot)
        parts, strangers = fit.by_layer(layers, sheet.joints, {curve.data_path for curve in take})
        stepped = action.copy()
        stepped.name = f"{action.name} koma"
        stepped[STEPPED] = sheet.take
        # Keeps and saves the take even though nothing plays it.
        action.use_fake_user = True
        thing.animation_data.action = stepped
        if slot:
            thing.animation_data.action_slot = stepped.slots[slot.identifier]
        target = stepping.curves(stepped, getattr(thing.animation_data, "action_slot", None))
        if self.set_scene:
            set_scene(scene, sheet.fps, self.start, sheet.length)
        timing = Timing(self.start, rate_of(scene), sheet.fps)
        for layer, paths in zip(layers, parts):
            own = lambda curves: [curve for curve in curves if curve.data_path in paths]
            source = stepping.Source.of_curves(thing, own(take), self.first_frame, step)
            if sheet.round:
                source.ways = travel.ways(thing, source, sheet.first, sheet.first + sheet.round)
            stepping.write(own(target), source, *timing.of(layer.exposures))
        stepped.use_frame_range = True
        stepped.frame_start, stepped.frame_end = self.start, timing.frame(sheet.length)
        for sentence in fit.left_out(sheet):
            self.report({"WARNING"}, sentence)
        if strangers:
            text = f"bones in no layer, moved with the root's: {fit.listed(strangers)}"
            self.report({"WARNING"}, text)
        drawings = sum(len(layer.exposures) for layer in layers)
        self.report({"INFO"}, f"{drawings} drawings on {sheet.length} koma")
        return {"FINISHED"}

    def take_of(self, thing):
        """Returns the action that an object plays, and its slot."""
        animation = thing.animation_data
        action = animation.action if animation else None
        slot = getattr(animation, "action_slot", None)
        if action is None or not stepping.curves(action, slot):
            raise files.NotAFile(f"{thing.name} has no action: assign the take first")
        if STEPPED in action:
            raise files.NotAFile(f"{action.name} is already stepped: assign the take itself to {thing.name}")
        return action, slot

    def compare(self, sheet, thing, action, step):
        """Raises an error if the action seems to be another take, or warns if Apply Anyway is set."""
        bones = [bone.name for bone in thing.data.bones] if thing.type == "ARMATURE" else []
        found = fit.doubts(sheet, bones, action.curve_frame_range, self.first_frame, step)
        if not found:
            return
        if not self.anyway:
            raise files.NotAFile(f"this seems to be another take: {'; '.join(found)}. Apply Anyway continues")
        for sentence in found:
            self.report({"WARNING"}, sentence)


class GENGA_OT_import_glb(Operator, Koma):
    """Import genga's GLB, with genga as extremes and inbetweens as breakdowns"""

    bl_idname = "genga.import_glb"
    bl_label = "Import genga GLB"
    bl_options = {"REGISTER", "UNDO"}
    filename_ext = ".glb"

    filter_glob: StringProperty(default="*.glb", options={"HIDDEN"})

    def run(self, context):
        animations = files.glb_animations(self.filepath)
        extras = next(iter(animations.values()))
        scene, before = context.scene, set(bpy.data.actions)
        # Only at the sheet's rate do keys land on whole frames: a frame a koma.
        with at_rate(scene, extras["fps"]):
            bpy.ops.import_scene.gltf(filepath=self.filepath)
        if self.set_scene:
            set_scene(scene, extras["fps"], self.start, extras["koma"])
        timing = Timing(self.start, rate_of(scene), extras["fps"])
        # Longest name first: an action has its animation's name, sometimes with a suffix.
        names = sorted(animations, key=len, reverse=True)
        for action in set(bpy.data.actions) - before:
            name = next((name for name in names if action.name.startswith(name)), None)
            if name is not None:
                stepping.name_roles(stepping.curves(action), animations[name], timing)
        scene.frame_set(self.start if self.set_scene else scene.frame_current)
        return {"FINISHED"}


OPERATORS = (GENGA_OT_apply_sheet, GENGA_OT_import_glb)


def menu(self, _context):
    self.layout.operator(GENGA_OT_apply_sheet.bl_idname, text="genga Timesheet onto Action (.json)")
    self.layout.operator(GENGA_OT_import_glb.bl_idname, text="genga GLB with Roles (.glb)")
