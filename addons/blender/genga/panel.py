# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels in the sidebars of the 3-D view and the dope sheet."""

from bpy.types import Menu, Panel, UIList

from . import bones, presets, turn, words
from .subject import armature_of


class Sidebar:
    bl_region_type = "UI"
    bl_category = "genga"

    @classmethod
    def poll(cls, context):
        return armature_of(context) is not None


class Keys(Sidebar):
    """Find Keys, and its result."""

    bl_label = "Genga"

    def draw(self, context):
        layout, thing = self.layout, armature_of(context)
        row = layout.row()
        row.scale_y = 1.4
        row.operator("genga.find_keys", icon="KEYTYPE_EXTREME_VEC")
        is_on_sheet = turn.is_on_sheet(thing)
        text, icon = ("Show the Take", "PLAY") if is_on_sheet else ("Show the Sheet", "KEYFRAME_HLT")
        layout.operator("genga.toggle", text=text, icon=icon)
        layout.operator("genga.curves", icon="IPO_BEZIER")
        told = layout.column(align=True)
        for sentence in thing.genga.told.splitlines():
            for line in wrapped(sentence, context.region.width):
                told.label(text=line)


class Knobs(Sidebar):
    """Settings for animators."""

    bl_label = "Knobs"

    def draw(self, context):
        layout, own = self.layout, armature_of(context).genga
        layout.use_property_split, layout.use_property_decorate = True, False
        row = layout.row(align=True)
        row.menu("GENGA_MT_presets")
        row.prop(own, "live", text="", icon="FILE_REFRESH")
        how_many = layout.column(align=True)
        how_many.prop(own, "genga")
        how_many.prop(own, "drawings")
        draw_timed(layout, own)
        layout.prop(own, "feet")
        loop = layout.row(heading="Loop")
        loop.prop(own, "loop", text="")
        rounds = loop.row()
        rounds.active = own.loop
        rounds.prop(own, "cycles", text="")
        layout.prop(own, "rate")
        layout.prop(own, "rest")
        layout.prop(own, "curve_error")
        layout.prop(own, "markers")


class Corrections(Sidebar):
    """Pinned and forbidden frames."""

    bl_label = "Corrections"

    def draw(self, context):
        layout, own = self.layout, armature_of(context).genga
        row = layout.row(align=True)
        for what, text, icon in (("PIN", "Pin", "PINNED"), ("FORBID", "Forbid", "CANCEL"), ("ONLY", "Only", "KEY_HLT")):
            row.operator("genga.mark", text=text, text_ctxt=words.CONTEXT, icon=icon).what = what
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(own, "only_pins")
        layout.operator("genga.mark", text="Clear", text_ctxt=words.CONTEXT, icon="X").what = "CLEAR"


class Passages(Sidebar):
    """Ranges with settings of their own."""

    bl_label = "Passages"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, own = self.layout, armature_of(context).genga
        row = layout.row()
        row.template_list("GENGA_UL_passages", "", own, "passages", own, "passage", rows=2)
        buttons = row.column(align=True)
        for what, icon in (("ADD", "ADD"), ("REMOVE", "REMOVE")):
            button = buttons.row(align=True)
            button.enabled = what == "ADD" or len(own.passages) > 0
            button.operator("genga.passage", text="", icon=icon).what = what
        layout.use_property_split, layout.use_property_decorate = True, False
        if not own.passages:
            return
        one = own.passages[min(own.passage, len(own.passages) - 1)]
        ends = layout.column(align=True)
        ends.prop(one, "start")
        ends.prop(one, "end")
        draw_timed(layout, one)
        layout.prop(one, "rest")
        layout.separator()
        layout.prop(own, "outside")


class GENGA_UL_passages(UIList):
    """The passages of a take."""

    def draw_item(self, _context, layout, _data, passage, _icon, _active, _name, _index=0, _flag=0):
        layout.label(text=f"{passage.start} – {passage.end}", translate=False)
        layout.prop(passage, "on", text="", emboss=False)


def draw_timed(layout, own):
    """Draws the settings that a passage can have of its own."""
    layout.prop(own, "on")
    layout.prop(own, "snap", slider=True)
    left_out = layout.column(align=True)
    left_out.prop(own, "naka_nashi", slider=True)
    left_out.prop(own, "koma_dori", slider=True)


class Sampled(Sidebar):
    """The sampled range and bones, and export."""

    bl_label = "Take and Files"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, own = self.layout, armature_of(context).genga
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(own, "frames")
        # The labels need the full width.
        whole = layout.column()
        whole.use_property_split = False
        whole.prop(own, "clean")
        whole.prop(own, "deforming")
        layout.prop(own, "leave_out")
        bones.draw(layout, armature_of(context))
        layout.operator("genga.export", icon="EXPORT")


class GENGA_MT_presets(Menu):
    bl_label = "Presets"

    def draw(self, _context):
        for name, label, *_ in presets.PRESETS:
            self.layout.operator("genga.preset", text=label).preset = name


def wrapped(sentence, width):
    """Wraps a sentence to the width of a sidebar."""
    lines, most = [""], max(16, width // 8)
    for word in sentence.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > most:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines


def in_space(part, space):
    """Creates a panel for one kind of editor."""
    name = f"GENGA_PT_{part.__name__.lower()}_{space.lower()}"
    return type(name, (part, Panel), {"bl_idname": name, "bl_space_type": space})


PARTS = (Keys, Knobs, Corrections, Passages, Sampled)
PANELS = tuple(in_space(part, space) for space in ("VIEW_3D", "DOPESHEET_EDITOR") for part in PARTS)
CLASSES = (GENGA_MT_presets, GENGA_UL_passages, *PANELS)
