"""genga's timesheets onto armatures, and its stepped GLB with the roles of its keys."""

import bpy
from bpy.props import BoolProperty, IntProperty, StringProperty
from bpy.types import Operator
from bpy_extras.io_utils import ImportHelper

from . import files, stepping


def set_scene(scene, fps, start, koma):
    """The sheet's rate, and its length as the range that is played."""
    scene.render.fps = max(1, round(fps))
    scene.render.fps_base = scene.render.fps / fps
    scene.frame_start, scene.frame_end = start, start + koma - 1


class Koma(ImportHelper):
    """What both operators ask."""

    start: IntProperty(
        name="First Koma",
        description="The frame of the sheet's first koma; at 1 frames are numbered as on paper",
        default=1,
    )

    def execute(self, context):
        try:
            return self.run(context)
        except (files.NotAFile, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}


class GENGA_OT_apply_sheet(Operator, Koma):
    """Keep only the poses on a genga timesheet, as constant keys in a copy of the active object's action"""

    bl_idname = "genga.apply_sheet"
    bl_label = "Apply genga Timesheet"
    bl_options = {"REGISTER", "UNDO"}
    filename_ext = ".json"

    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    first_frame: IntProperty(
        name="Source Frame 0",
        description="The frame on which source frame 0 lies; Blender's BVH import puts it on 1",
        default=1,
    )
    scaled: BoolProperty(
        name="Imported with Scale FPS",
        description="The motion was scaled to the scene's rate when it was imported",
        default=False,
    )
    layer: StringProperty(name="Layer", description="The sheet's layer; empty is the first")

    @classmethod
    def poll(cls, context):
        thing = context.active_object
        return bool(thing and thing.animation_data and thing.animation_data.action)

    def run(self, context):
        sheet = files.Sheet.read(self.filepath, self.layer)
        thing, scene = context.active_object, context.scene
        animation = thing.animation_data
        action, slot = animation.action, getattr(animation, "action_slot", None)
        step = scene.render.fps / scene.render.fps_base / sheet.source_fps if self.scaled else 1.0
        self.check_length(sheet, action, step)
        source = stepping.Source(thing, stepping.curves(action, slot), self.first_frame, step)
        stepped = action.copy()
        stepped.name = f"{action.name} koma"
        # The take itself stays, and is saved though nothing plays it.
        action.use_fake_user = True
        animation.action = stepped
        if slot:
            animation.action_slot = stepped.slots[slot.identifier]
        slot = getattr(animation, "action_slot", None)
        stepping.write(stepping.curves(stepped, slot), source, sheet.exposures, self.start)
        stepped.use_frame_range = True
        stepped.frame_start, stepped.frame_end = self.start, self.start + sheet.length
        set_scene(scene, sheet.fps, self.start, sheet.length)
        self.report({"INFO"}, f"{len(sheet.exposures)} drawings on {sheet.length} koma")
        return {"FINISHED"}

    def check_length(self, sheet, action, step):
        last = max(place for exposure in sheet.exposures for place in exposure.places)
        needed, there = self.first_frame + last * step, action.frame_range[1]
        if needed > there + 0.5:
            text = f"the sheet shows frame {needed:g}, but the action ends at {there:g}"
            self.report({"WARNING"}, text)


class GENGA_OT_import_glb(Operator, Koma):
    """Import genga's GLB with its genga as extremes and its inbetweens as breakdowns"""

    bl_idname = "genga.import_glb"
    bl_label = "Import genga GLB"
    bl_options = {"REGISTER", "UNDO"}
    filename_ext = ".glb"

    filter_glob: StringProperty(default="*.glb", options={"HIDDEN"})

    def run(self, context):
        animations = files.glb_animations(self.filepath)
        extras = next(iter(animations.values()))
        # Before the import: keys land on whole frames only at the sheet's own rate.
        set_scene(context.scene, extras["fps"], self.start, extras["koma"])
        before = set(bpy.data.actions)
        bpy.ops.import_scene.gltf(filepath=self.filepath)
        # The longest name first: an action is called after its animation, sometimes with more behind it.
        names = sorted(animations, key=len, reverse=True)
        for action in set(bpy.data.actions) - before:
            name = next((name for name in names if action.name.startswith(name)), None)
            if name is not None:
                stepping.name_roles(stepping.curves(action), animations[name], self.start)
        context.scene.frame_set(self.start)
        return {"FINISHED"}


OPERATORS = (GENGA_OT_apply_sheet, GENGA_OT_import_glb)


def menu(self, _context):
    self.layout.operator(GENGA_OT_apply_sheet.bl_idname, text="genga Timesheet onto Action (.json)")
    self.layout.operator(GENGA_OT_import_glb.bl_idname, text="genga GLB with Roles (.glb)")


def register():
    for operator in OPERATORS:
        bpy.utils.register_class(operator)
    bpy.types.TOPBAR_MT_file_import.append(menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(menu)
    for operator in reversed(OPERATORS):
        bpy.utils.unregister_class(operator)
