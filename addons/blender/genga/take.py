# SPDX-License-Identifier: GPL-3.0-or-later
"""The take that an object plays: its action in its slot, or a mix of NLA tracks."""

from .refused import Refused
from .stepping import curves

# Custom property of a stepped action: the name of its take.
STEPPED = "genga_take"
# The take's action; the first frame of each drawing, and the frame of the take that it shows.
SOURCE, BEGINS, PLACES = "genga_source", "genga_begins", "genga_places"
# The id of the armature that an action is for.
OWNER = "genga_object"
# What a made action holds: the drawings of the sheet, or few keys with curves.
KIND, KOMA, KEYS = "genga_kind", "koma", "keys"
# The take's slot, by its handle.
SLOT = "genga_slot"


class Take:
    """The take: `action` and `slot`, None if only NLA tracks play, and the NLA `strips`."""

    def __init__(self, thing):
        self.thing = thing
        animation = thing.animation_data
        if animation is None:
            raise Refused(f"{thing.name} has no action: assign the take first")
        if getattr(animation, "use_tweak_mode", False):
            raise Refused("an NLA strip is being edited: leave tweak mode first (Tab in the NLA editor)")
        self.action, self.slot = played(animation)
        self.strips = strips(animation)
        if self.action is None and not self.strips:
            raise Refused(f"{thing.name} has no action: assign the take first")

    @property
    def name(self):
        return self.action.name if self.action else self.thing.name

    @property
    def is_mixed(self):
        """Whether NLA tracks contribute."""
        return bool(self.strips)

    def curves(self):
        """Returns all curves that contribute."""
        own = curves(self.action, self.slot) if self.action else []
        mixed = [curve for strip in self.strips for curve in curves(strip.action, getattr(strip, "action_slot", None))]
        return [*own, *mixed]

    def channels(self):
        """Returns the animated channels: data path and index, with the name of the group."""
        found = {}
        for curve in self.curves():
            group = curve.group.name if curve.group else ""
            found.setdefault((curve.data_path, curve.array_index), group)
        return found

    def frames(self):
        """Returns the first and the last frame of all keys and strips."""
        ends = [strip.frame_start for strip in self.strips] + [strip.frame_end for strip in self.strips]
        if self.action:
            own = curves(self.action, self.slot)
            if not own:
                raise Refused(f"{self.action.name} does not animate {self.thing.name}: choose its slot, or another action")
            by_hand = self.action.use_frame_range
            ends += list(self.action.frame_range) if by_hand else [end for curve in own for end in curve.range()]
        return round(min(ends)), round(max(ends))


def played(animation):
    """Returns the take's action and slot, even if its sheet is shown."""
    action, slot = animation.action, getattr(animation, "action_slot", None)
    if action is not None and STEPPED in action:
        source = action.get(SOURCE)
        if source is None and not strips(animation):
            raise Refused(f"{action.name} is stepped, and its take is gone: assign a take to the object")
        if source is not None and slot is not None:
            slot = next((own for own in source.slots if own.handle == action.get(SLOT)), None)
        return source, slot
    return action, slot


def strips(animation):
    """Returns the NLA strips that contribute."""
    if not animation.use_nla:
        return []
    tracks = [track for track in animation.nla_tracks if not track.mute]
    alone = [track for track in tracks if track.is_solo]
    of_tracks = [strip for track in alone or tracks for strip in track.strips]
    return [strip for strip in of_tracks if strip.action is not None and not strip.mute]


def show(thing, action, slot):
    """Makes an object play an action in the slot of that name."""
    animation = thing.animation_data
    animation.action = action
    if action is not None and slot is not None and hasattr(animation, "action_slot"):
        own = next((own for own in action.slots if own.identifier == slot.identifier), None)
        if own is not None:
            animation.action_slot = own
