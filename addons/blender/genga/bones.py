"""Which bones are looked at: a list in which a person ticks those that are left out."""

from bpy.props import BoolProperty, EnumProperty
from bpy.types import Operator, UIList

from . import rig, words
from .turn import OfArmature

LEFT_OUT = BoolProperty(name="Left Out", description="This bone is not looked at; it is keyed all the same")


class GENGA_UL_bones(UIList):
    """The bones of a rig, each with a box to tick; those that are left out anyway are pale."""

    def draw_item(self, context, layout, _data, bone, _icon, _active, _name, _index=0, _flag=0):
        row = layout.row(align=True)
        # A box stands before its bone.
        row.use_property_split = False
        row.active = bone.name in self.staying(context.active_object)
        row.prop(bone, "genga_left_out", text="")
        row.label(text=bone.name, translate=False)

    def staying(self, thing):
        own, bones = thing.genga, thing.data.bones
        told = [(bone.name, bone.use_deform) for bone in bones]
        stays = rig.staying(told, own.deforming, own.leave_out)
        return {name for (name, _), is_staying in zip(told, stays) if is_staying}


class GENGA_OT_tick(OfArmature, Operator):
    """Tick bones in the list of those that are left out"""

    bl_idname = "genga.tick"
    bl_label = "Tick"

    what: EnumProperty(
        items=(
            ("SELECTED", "Selected", "The selected bones are left out too"),
            ("NONE", "None", "No bone is left out by its tick"),
        ),
    )

    @classmethod
    def description(cls, _context, properties):
        return cls.bl_rna.properties["what"].enum_items[properties.what].description

    def run(self, context):
        for bone in context.active_object.data.bones:
            bone.genga_left_out = self.what == "SELECTED" and (bone.genga_left_out or is_selected(context, bone))
        return {"FINISHED"}


def is_selected(context, bone):
    """Whether a bone is selected; since Blender 5.0 its pose is."""
    posed = context.active_object.pose.bones[bone.name]
    return posed.select if hasattr(posed, "select") else bone.select


def draw(layout, thing):
    """The list, and what ticks many at once."""
    layout.template_list("GENGA_UL_bones", "", thing.data, "bones", thing.genga, "bone", rows=4)
    ticks = layout.column(align=True)
    for what, text in (("SELECTED", "Leave Out Selected"), ("NONE", "Leave Out None")):
        ticks.operator("genga.tick", text=text, text_ctxt=words.CONTEXT).what = what


CLASSES = (GENGA_UL_bones, GENGA_OT_tick)
