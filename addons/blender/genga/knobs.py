"""What an animator turns, kept with the armature and saved with the file."""

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy.types import PropertyGroup

from . import findings, words

# A name in the panel, what it does, and the knobs it sets on top of the others.
PRESETS = (
    ("twos", "On Twos", "A drawing every two koma", {"on": "2"}),
    ("threes", "On Threes", "A drawing every three koma", {"on": "3"}),
    ("modulated", "Ones to Threes", "As the motion of each interval asks", {"on": "1-3"}),
    ("snappy", "Snappy", "The middle of a movement snaps", {"snap": 0.5, "naka_nashi": 4.0}),
    ("soft", "Soft", "Even spacing, nothing left out", {"snap": 0.1, "naka_nashi": 0.0}),
    ("few", "Few Genga", "Only what saves much", {"rest": "keys.min_price=12"}),
)

# Whether knobs are being set together, so that nothing runs for each.
together = False


def turned(knobs, context):
    if knobs.live and not together:
        findings.again(context.scene, knobs.id_data)


def set_together(knobs, context, values):
    """Sets several knobs and runs once."""
    global together
    together = True
    try:
        for name, value in values.items():
            setattr(knobs, name, value)
    finally:
        together = False
    turned(knobs, context)


class GengaKnobs(PropertyGroup):
    """The knobs of an armature."""

    genga: IntProperty(
        name="Genga",
        description="So many key drawings, first and last among them; 0 is as many as are found",
        min=0,
        soft_max=60,
        update=turned,
    )
    drawings: FloatProperty(
        name="Per Second",
        description="So many drawings a second, inbetweens too; 0 is as they are found",
        min=0.0,
        soft_max=12.0,
        precision=1,
        step=50,
        update=turned,
    )
    on: EnumProperty(
        name="On",
        translation_context=words.CONTEXT,
        description="How many koma a drawing stays between two genga",
        items=(
            ("1", "Ones", "A drawing a koma"),
            ("2", "Twos", "A drawing every two koma"),
            ("3", "Threes", "A drawing every three koma"),
            ("1-3", "Ones to Threes", "Fast on ones, slow on threes, as the motion asks"),
            ("2-3", "Twos and Threes", "Fast on twos, slow on threes"),
        ),
        default="2-3",
        update=turned,
    )
    snap: FloatProperty(
        name="Snap",
        translation_context=words.CONTEXT,
        description="How far inbetweens crowd towards their genga (spacing)",
        min=0.0,
        max=0.95,
        default=0.3,
        update=turned,
    )
    naka_nashi: FloatProperty(
        name="Naka-nashi",
        description="How many of the fastest inbetweens are left out, in %",
        subtype="PERCENTAGE",
        min=0.0,
        max=100.0,
        soft_max=25.0,
        default=4.0,
        update=turned,
    )
    koma_dori: FloatProperty(
        name="Koma-dori",
        description="How many of the slowest inbetweens are held over, in %",
        subtype="PERCENTAGE",
        min=0.0,
        max=100.0,
        default=100.0 / 3.0,
        update=turned,
    )
    feet: BoolProperty(
        name="Feet Held",
        description="A foot stays on one place for as long as it stands in the take; hip and knee give way",
        update=turned,
    )
    rate: FloatProperty(
        name="Rate",
        translation_context=words.CONTEXT,
        description="Koma a second of the sheet: 24 in film and television, whatever rate the scene has",
        min=2.0,
        max=1000.0,
        soft_max=60.0,
        default=24.0,
        precision=2,
        update=turned,
    )
    rest: StringProperty(
        name="More",
        description="Any other setting of a recipe by its name, such as keys.min_price=8; keys.contacts=keys",
        update=turned,
    )
    live: BoolProperty(
        name="Live",
        description="Run again as soon as a knob is turned",
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
        description="Which part is looked at",
        items=(
            ("TAKE", "Take", "All that the action or the NLA tracks have"),
            ("SCENE", "Scene", "The scene's range, or that of its preview"),
        ),
        default="TAKE",
    )
    deforming: BoolProperty(
        name="Deforming Bones Only",
        description="Leave out controls and mechanisms, where the rig has bones that deform",
        default=True,
    )
    leave_out: StringProperty(
        name="Leave Out",
        description="Bones that are not looked at, by patterns such as *twist*, *hair*; they are keyed all the same",
        default="*twist*, *_end, *_end.*, ik_*, *ＩＫ*, 全ての親",
    )
    bone: IntProperty(options={"HIDDEN"}, description="The row of the list of bones that is chosen")
    pins: StringProperty(
        name="Pins",
        description="Frames that are genga whatever is found, such as 12, 40:contact. Keys of the take that are marked as extremes are pinned too",
        update=turned,
    )
    forbid: StringProperty(
        name="Forbid",
        description="Frames near which no genga is found, such as 50, 60..66",
        update=turned,
    )
    only_pins: BoolProperty(
        name="Only Pins",
        description="Pins, and keys marked as extremes, are the only genga",
        update=turned,
    )
