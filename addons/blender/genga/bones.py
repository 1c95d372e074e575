# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of bones, in which a person ticks those to leave out."""

from bpy.props import BoolProperty, EnumProperty
from bpy.types import Operator, UIList

from . import rig, words
from .subject import armature_of, editable
from .turn import OfWhat

LEFT_OUT = BoolProperty(name="Left Out", description="Ignore this bone; it still gets keys")


class GENGA_UL_bones(UIList):
    """The bones of a rig, each with a checkbox. Bones that other settings leave out are greyed out."""

    def draw_item(self, context, layout, _data, bone, _icon, _active, _name, _index=0, _flag=0):
        row = layout.row(align=True)
        # Shows the checkbox before the bone's name.
        row.use_property_split = False
        row.active = bone.name in self.staying(armature_of(context))
        row.prop(bone, "genga_left_out", text="")
        row.label(text=bone.name, translate=False)

    def staying(self, thing):
        own, bones = thing.genga, thing.data.bones
        told = [(bone.name, bone.use_deform) for bone in bones]
        stays = rig.staying(told, own.deforming, own.leave_out)
        return {name for (name, _), is_staying in zip(told, stays) if is_staying}


class GENGA_OT_tick(OfWhat, Operator):
    """Tick bones to leave out"""

    bl_idname = "genga.tick"
    bl_label = "Tick"

    what: EnumProperty(
        items=(
            ("SELECTED", "Selected", "Also leave out the selected bones"),
            ("NONE", "None", "Untick all bones"),
        ),
    )

    def run(self, context):
        for bone in editable(context).data.bones:
            bone.genga_left_out = self.what == "SELECTED" and (bone.genga_left_out or is_selected(context, bone))
        return {"FINISHED"}


def is_selected(context, bone):
    """Reports whether a bone is selected. Since Blender 5.0 the pose bone stores this."""
    posed = armature_of(context).pose.bones[bone.name]
    return posed.select if hasattr(posed, "select") else bone.select


def draw(layout, thing):
    """Draws the list, and buttons that tick several bones at once."""
    layout.template_list("GENGA_UL_bones", "", thing.data, "bones", thing.genga, "bone", rows=4)
    ticks = layout.column(align=True)
    for what, text in (("SELECTED", "Leave Out Selected"), ("NONE", "Leave Out None")):
        ticks.operator("genga.tick", text=text, text_ctxt=words.CONTEXT).what = what


CLASSES = (GENGA_UL_bones, GENGA_OT_tick)
