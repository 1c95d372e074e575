# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's page in the preferences: language, preset for new armatures, colours."""

from types import SimpleNamespace

from bpy.props import EnumProperty, FloatVectorProperty
from bpy.types import AddonPreferences

from . import presets, words

# Colours of the sheet's and the curves' channels in the dope sheet.
SHEET, CURVES = (0.36, 0.22, 0.16), (0.16, 0.27, 0.36)


class GengaPreferences(AddonPreferences):
    bl_idname = __package__

    language: EnumProperty(
        name="Language",
        description="Language of the panel",
        items=(
            ("AUTO", "As Blender", "Japanese if Blender is in Japanese, else English"),
            ("en_US", "English", "Always English"),
            ("ja_JP", "日本語", "Always Japanese"),
        ),
        default="AUTO",
        update=lambda own, _context: words.speak(own.language),
    )
    preset: EnumProperty(
        name="Default Preset",
        description="Settings of an armature whose keys are found for the first time",
        items=presets.ITEMS,
        default="usual",
    )
    sheet_colour: FloatVectorProperty(
        name="Sheet",
        description="Colour of the sheet's channels in the dope sheet",
        subtype="COLOR",
        min=0.0,
        max=1.0,
        default=SHEET,
    )
    curves_colour: FloatVectorProperty(
        name="Keys with Curves",
        description="Colour of the channels of keys with curves in the dope sheet",
        subtype="COLOR",
        min=0.0,
        max=1.0,
        default=CURVES,
    )

    def draw(self, _context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("language", "preset", "sheet_colour", "curves_colour"):
            layout.prop(self, name)


def of(context):
    """Returns the preferences. Where Blender has no page for the add-on, such as in a test of its sources: the usual."""
    addon = context.preferences.addons.get(__package__)
    if addon is not None and addon.preferences is not None:
        return addon.preferences
    return SimpleNamespace(language="AUTO", preset="usual", sheet_colour=SHEET, curves_colour=CURVES)


def paint(curves, colour):
    """Gives the channels of an action a colour in the dope sheet."""
    for group in {curve.group.as_pointer(): curve.group for curve in curves if curve.group}.values():
        group.color_set = "CUSTOM"
        group.colors.normal = group.colors.select = group.colors.active = colour
