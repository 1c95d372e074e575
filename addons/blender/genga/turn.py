# SPDX-License-Identifier: GPL-3.0-or-later
"""Small operators of the panel: switch take and sheet, apply presets, mark frames and passages."""

from bpy.props import EnumProperty
from bpy.types import Operator

from . import apply, knobs, marks, pins, presets
from .refused import Refused, Reported
from .subject import armature_of, editable
from .take import KOMA, STEPPED, Take, show

# Largest number of frames that are pinned without a question.
MOST_PINS = 5


class OfArmature(Reported):
    """An operator on the active armature, or on that of the active mesh."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return armature_of(context) is not None


class OfWhat(OfArmature):
    """An operator with an option `what`, whose items say what it does."""

    @classmethod
    def description(cls, _context, properties):
        return cls.bl_rna.properties["what"].enum_items[properties.what].description


class GENGA_OT_toggle(OfArmature, Operator):
    """Show the take, or its drawings on the sheet"""

    bl_idname = "genga.toggle"
    bl_label = "Take or Sheet"

    def run(self, context):
        thing = editable(context)
        take = Take(thing)
        if is_on_sheet(thing):
            show(thing, take.action, take.slot)
            return {"FINISHED"}
        action = apply.found(thing, take, KOMA)
        if action is None:
            raise Refused("this take has no sheet: find its keys first")
        show(thing, action, apply.slot_of(thing, take, action))
        return {"FINISHED"}


def is_on_sheet(thing):
    """Reports whether an object plays an action that was made from a take."""
    animation = thing.animation_data if thing else None
    return bool(animation and animation.action and STEPPED in animation.action)


class GENGA_OT_preset(OfArmature, Operator):
    """Set the settings of a preset, and reset the others that presets change"""

    bl_idname = "genga.preset"
    bl_label = "Preset"

    preset: EnumProperty(name="Preset", items=presets.ITEMS)

    def run(self, context):
        own = editable(context).genga
        knobs.set_together(own, context, presets.values(self.preset, own))
        return {"FINISHED"}


class GENGA_OT_mark(OfWhat, Operator):
    """Mark the current frame, or in the dope sheet the frames of the selected keys, by markers that can be dragged"""

    bl_idname = "genga.mark"
    bl_label = "Mark"

    what: EnumProperty(
        items=(
            ("PIN", "Pin", "Always make the current frame, or in the dope sheet those of selected keys, genga"),
            ("FORBID", "Forbid", "Find no genga near the current frame, or in the dope sheet near selected keys"),
            ("ONLY", "Only These", "Make only these frames genga: the current one, or in the dope sheet those of selected keys"),
            ("CLEAR", "Clear", "Remove all markers that pin or forbid"),
        ),
    )

    def invoke(self, context, event):
        """Asks before many frames are pinned."""
        count = len(marks.chosen(context, armature_of(context)))
        if self.what not in ("PIN", "ONLY") or count <= MOST_PINS:
            return self.execute(context)
        message = f"{count} frames become genga. Clear takes all pins back"
        return context.window_manager.invoke_confirm(self, event, title=f"Pin {count} frames?", message=message)

    def run(self, context):
        thing, scene = editable(context), context.scene
        frames = marks.chosen(context, thing)
        if self.what in ("ONLY", "CLEAR"):
            marks.clear(scene, thing)
        if self.what in ("PIN", "ONLY"):
            marks.add(scene, thing, [("pin", frame) for frame in frames])
        if self.what == "FORBID":
            marks.add(scene, thing, pins.forbidding(frames))
        only = {"ONLY": True, "CLEAR": False}.get(self.what, thing.genga.only_pins)
        knobs.set_together(thing.genga, context, {"only_pins": only})
        return {"FINISHED"}


class GENGA_OT_passage(OfWhat, Operator):
    """Give a marked range settings of its own: between selected markers, of the preview range, or of selected keys"""

    bl_idname = "genga.passage"
    bl_label = "Passage"

    what: EnumProperty(
        items=(
            ("ADD", "Add", "Add the marked range: between selected markers, the preview range, or the selected keys"),
            ("REMOVE", "Remove", "Remove the passage selected in the list"),
        ),
    )

    def run(self, context):
        thing = editable(context)
        own = thing.genga
        if self.what == "REMOVE":
            own.passages.remove(own.passage)
            own.passage = max(0, own.passage - 1)
            knobs.turned(own, context)
            return {"FINISHED"}
        start, end = marks.passage(context, thing)
        made = own.passages.add()
        own.passage = len(own.passages) - 1
        alike = {name: getattr(own, name) for name in ("on", "snap", "naka_nashi", "koma_dori")}
        knobs.set_together(made, context, {"start": start, "end": end, **alike})
        return {"FINISHED"}


CLASSES = (GENGA_OT_toggle, GENGA_OT_preset, GENGA_OT_mark, GENGA_OT_passage)
