# SPDX-License-Identifier: GPL-3.0-or-later
"""Small operators of the panel: switch take and sheet, apply presets, mark frames."""

from bpy.props import EnumProperty
from bpy.types import Operator

from . import apply, knobs, marks, pins
from .refused import Refused, Reported
from .take import STEPPED, Take, show


class OfArmature(Reported):
    """An operator on the active armature."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        thing = context.active_object
        return thing is not None and thing.type == "ARMATURE"


class GENGA_OT_toggle(OfArmature, Operator):
    """Show the take, or its drawings on the sheet"""

    bl_idname = "genga.toggle"
    bl_label = "Take or Sheet"

    def run(self, context):
        thing = context.active_object
        take = Take(thing)
        if is_on_sheet(thing):
            show(thing, take.action, take.slot)
            return {"FINISHED"}
        action = apply.found(thing, take)
        if action is None:
            raise Refused("this take has no sheet: find its keys first")
        show(thing, action, apply.slot_of(thing, take, action))
        return {"FINISHED"}


def is_on_sheet(thing):
    """Reports whether an object plays a stepped action."""
    animation = thing.animation_data if thing else None
    return bool(animation and animation.action and STEPPED in animation.action)


class GENGA_OT_preset(OfArmature, Operator):
    """Change several settings at once, and keep the others"""

    bl_idname = "genga.preset"
    bl_label = "Preset"

    preset: EnumProperty(name="Preset", items=[preset[:3] for preset in knobs.PRESETS])

    def run(self, context):
        values = next(preset[3] for preset in knobs.PRESETS if preset[0] == self.preset)
        knobs.set_together(context.active_object.genga, context, values)
        return {"FINISHED"}


class GENGA_OT_mark(OfArmature, Operator):
    """Mark the frames of the selected keys, or the current frame"""

    bl_idname = "genga.mark"
    bl_label = "Mark"

    what: EnumProperty(
        items=(
            ("PIN", "Pin", "Always make the selected frames genga"),
            ("FORBID", "Forbid", "Find no genga near the selected frames"),
            ("ONLY", "Only These", "Make only the selected frames genga"),
            ("CLEAR", "Clear", "Remove all pins and forbidden frames"),
        ),
    )

    @classmethod
    def description(cls, _context, properties):
        return cls.bl_rna.properties["what"].enum_items[properties.what].description

    def run(self, context):
        own = context.active_object.genga
        frames = marks.chosen(context)
        marked = {
            "PIN": lambda: {"pins": pins.with_pins(own.pins, frames)},
            "FORBID": lambda: {"forbid": pins.with_forbidden(own.forbid, frames)},
            "ONLY": lambda: {"pins": pins.with_pins("", frames), "only_pins": True},
            "CLEAR": lambda: {"pins": "", "forbid": "", "only_pins": False},
        }
        knobs.set_together(own, context, marked[self.what]())
        return {"FINISHED"}


CLASSES = (GENGA_OT_toggle, GENGA_OT_preset, GENGA_OT_mark)
