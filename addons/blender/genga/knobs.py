# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings for animators, stored in the armature and saved with the file."""

from contextlib import contextmanager

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy.types import PropertyGroup

from . import findings, presets, words

# Whether several settings are being changed together, which must run only once.
together = False


def turned(knobs, context):
    """Runs again after a setting of an armature or of one of its passages changed."""
    thing = knobs.id_data
    if thing.genga.live and not together:
        findings.again(context, thing)


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


@contextmanager
def begun(thing, preset):
    """Gives an armature the settings of a preset if nobody has touched them yet, and takes them back on an error."""
    own = thing.genga
    is_new = not own.own_id and not any(own.is_property_set(name) for name in presets.NAMES)
    if is_new:
        set_together(own, bpy.context, presets.values(preset, own))
    try:
        yield
    except BaseException:
        for name in presets.NAMES if is_new else ():
            own.property_unset(name)
        raise


class Timed:
    """Settings that a passage can have of its own."""

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
    rest: StringProperty(
        name="More",
        description="Other recipe settings by name, such as keys.min_price=8; keys.contacts=keys",
        update=turned,
    )


class GengaPassage(Timed, PropertyGroup):
    """A range of the take with settings of its own."""

    start: IntProperty(name="First Frame", description="First frame of the passage", update=turned)
    end: IntProperty(name="Last Frame", description="Last frame of the passage", update=turned)


class GengaKnobs(Timed, PropertyGroup):
    """The settings of an armature."""

    own_id: StringProperty(options={"HIDDEN"}, description="The armature's own id, whatever its name")
    marked_as: StringProperty(options={"HIDDEN"}, description="The name that the armature's markers bear")
    told: StringProperty(options={"HIDDEN"}, description="Messages of the last run, one a line")

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
    feet: BoolProperty(
        name="Feet Held",
        description="Keep a foot in place while it stands in the take; hip and knee adapt",
        update=turned,
    )
    loop: BoolProperty(
        name="Loop",
        description="Repeat the take, whose last pose is its first; the body travels on",
        update=turned,
    )
    cycles: IntProperty(
        name="Rounds",
        description="Number of rounds of a loop",
        min=1,
        soft_max=12,
        default=1,
        update=turned,
    )
    passages: CollectionProperty(type=GengaPassage)
    passage: IntProperty(options={"HIDDEN"}, description="Selected row in the list of passages")
    outside: EnumProperty(
        name="Elsewhere",
        description="What is shown outside of the passages",
        items=(
            ("TIMED", "On the Sheet", "Timed with the settings of the take"),
            ("SOURCE", "As It Is", "A drawing of the take on every koma; the passages begin and end with its poses"),
        ),
        default="TIMED",
        update=turned,
    )
    curve_error: FloatProperty(
        name="Curve Error",
        description="Largest distance between the motion of keys with curves and the take, in % of body height",
        subtype="PERCENTAGE",
        min=0.01,
        max=100.0,
        soft_max=10.0,
        default=1.0,
        precision=2,
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
    clean: BoolProperty(
        name="Clean Capture",
        description="Leave out inserted poses, such as a T-pose, at the ends of the take, and mend glitches of single frames",
        default=True,
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
    only_pins: BoolProperty(
        name="Only Pins",
        description="Use only the markers “pin” and keys of type Extreme as genga",
        update=turned,
    )
