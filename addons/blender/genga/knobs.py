# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings for animators, stored in the armature and saved with the file."""

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy.types import PropertyGroup

from . import findings, words

# Identifier, label, description, and the settings that a preset changes.
PRESETS = (
    ("twos", "On Twos", "One drawing every two koma", {"on": "2"}),
    ("threes", "On Threes", "One drawing every three koma", {"on": "3"}),
    ("modulated", "Ones to Threes", "Chosen for the motion of each interval", {"on": "1-3"}),
    ("snappy", "Snappy", "Faster in the middle of a movement", {"snap": 0.5, "naka_nashi": 4.0}),
    ("soft", "Soft", "Even spacing, no inbetweens left out", {"snap": 0.1, "naka_nashi": 0.0}),
    ("few", "Few Genga", "Only genga that prevent a large error", {"rest": "keys.min_price=16"}),
)

# Whether several settings are being changed together, which must run only once.
together = False


def turned(knobs, context):
    if knobs.live and not together:
        findings.again(context.scene, knobs.id_data)


def set_together(knobs, context, values):
    """Changes several settings and runs once."""
    global together
    together = True
    try:
        for name, value in values.items():
            setattr(knobs, name, value)
    finally:
        together = False
    turned(knobs, context)


class GengaKnobs(PropertyGroup):
    """The settings of an armature."""

    genga: IntProperty(
        name="Genga",
        description="Number of key drawings, including first and last; 0 keeps the number found",
        min=0,
        soft_max=60,
        update=turned,
    )
    drawings: FloatProperty(
        name="Per Second",
        description="Drawings per second, including inbetweens; 0 keeps the rate found",
        min=0.0,
        soft_max=12.0,
        precision=1,
        step=50,
        update=turned,
    )
    on: EnumProperty(
        name="On",
        translation_context=words.CONTEXT,
        description="Koma per drawing between two genga",
        items=(
            ("1", "Ones", "One drawing per koma"),
            ("2", "Twos", "One drawing every two koma"),
            ("3", "Threes", "One drawing every three koma"),
            ("1-3", "Ones to Threes", "Fast motion on ones, slow motion on threes"),
            ("2-3", "Twos and Threes", "Fast motion on twos, slow motion on threes"),
        ),
        default="2-3",
        update=turned,
    )
    snap: FloatProperty(
        name="Snap",
        translation_context=words.CONTEXT,
        description="How closely inbetweens crowd towards their genga (spacing)",
        min=0.0,
        max=0.95,
        default=0.3,
        update=turned,
    )
    naka_nashi: FloatProperty(
        name="Naka-nashi",
        description="Share of inbetweens, the fastest ones, to leave out, in %",
        subtype="PERCENTAGE",
        min=0.0,
        max=100.0,
        soft_max=25.0,
        default=4.0,
        update=turned,
    )
    koma_dori: FloatProperty(
        name="Koma-dori",
        description="Share of inbetweens, the slowest ones, to replace by holds, in %",
        subtype="PERCENTAGE",
        min=0.0,
        max=100.0,
        default=100.0 / 3.0,
        update=turned,
    )
    feet: BoolProperty(
        name="Feet Held",
        description="Keep a foot in place while it stands in the take; hip and knee adapt",
        update=turned,
    )
    rate: FloatProperty(
        name="Rate",
        translation_context=words.CONTEXT,
        description="Koma per second of the sheet, independent of the scene's rate; 24 in film and television",
        min=2.0,
        max=1000.0,
        soft_max=60.0,
        default=24.0,
        precision=2,
        update=turned,
    )
    rest: StringProperty(
        name="More",
        description="Other recipe settings by name, such as keys.min_price=8; keys.contacts=keys",
        update=turned,
    )
    live: BoolProperty(
        name="Live",
        description="Run again when a setting changes",
        default=True,
    )
    markers: BoolProperty(
        name="Markers",
        description="Number the genga on the timeline",
        default=True,
        update=turned,
    )
    frames: EnumProperty(
        name="Frames",
        description="Range to sample",
        items=(
            ("TAKE", "Take", "Range of the action or the NLA tracks"),
            ("SCENE", "Scene", "The scene's range, or its preview range if set"),
        ),
        default="TAKE",
    )
    deforming: BoolProperty(
        name="Deforming Bones Only",
        description="Leave out controls and mechanisms, if the rig has deforming bones",
        default=True,
    )
    leave_out: StringProperty(
        name="Leave Out",
        description="Bones to ignore, as patterns such as *twist*, *hair*; they still get keys",
        default="*twist*, *_end, *_end.*, ik_*, *ＩＫ*, 全ての親",
    )
    bone: IntProperty(options={"HIDDEN"}, description="Selected row in the list of bones")
    pins: StringProperty(
        name="Pins",
        description="Frames that are always genga, such as 12, 40:contact. Keys of the take of type Extreme are also pinned",
        update=turned,
    )
    forbid: StringProperty(
        name="Forbid",
        description="Frames without a genga nearby, such as 50, 60..66",
        update=turned,
    )
    only_pins: BoolProperty(
        name="Only Pins",
        description="Use only pins and keys of type Extreme as genga",
        update=turned,
    )
