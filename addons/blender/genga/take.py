"""The take that an object plays: its own action in its slot, or what its NLA tracks make of several."""

from .refused import Refused
from .stepping import curves

# What an action on a sheet is known by: the name of the take that it was.
STEPPED = "genga_take"
# The take's action; on which frames drawings begin, and which frames of the take they show.
SOURCE, BEGINS, PLACES = "genga_source", "genga_begins", "genga_places"
# The name of the object whose drawings they are.
OWNER = "genga_object"


class Take:
    """What plays: `action` and `slot`, none where NLA tracks alone play, and `paths`, what is animated."""

    def __init__(self, thing):
        self.thing = thing
        animation = thing.animation_data
        if animation is None:
            raise Refused(f"{thing.name} has no action: let it play the take first")
        if getattr(animation, "use_tweak_mode", False):
            raise Refused("an NLA strip is being edited: leave its tweak mode first (Tab in the NLA editor)")
        self.action, self.slot = played(animation)
        self.strips = strips(animation)
        if self.action is None and not self.strips:
            raise Refused(f"{thing.name} has no action: let it play the take first")

    @property
    def name(self):
        return self.action.name if self.action else self.thing.name

    @property
    def is_mixed(self):
        """Whether NLA tracks have a say."""
        return bool(self.strips)

    def curves(self):
        """All curves that have a say."""
        own = curves(self.action, self.slot) if self.action else []
        mixed = [curve for strip in self.strips for curve in curves(strip.action, getattr(strip, "action_slot", None))]
        return [*own, *mixed]

    def channels(self):
        """What is animated: data path, index, and the name of its group, each once."""
        found = {}
        for curve in self.curves():
            group = curve.group.name if curve.group else ""
            found.setdefault((curve.data_path, curve.array_index), group)
        return found

    def frames(self):
        """The first and the last frame with a key, or of a strip."""
        ends = [strip.frame_start for strip in self.strips] + [strip.frame_end for strip in self.strips]
        if self.action:
            own = curves(self.action, self.slot)
            if not own:
                raise Refused(f"{self.action.name} moves nothing of {self.thing.name}: choose its slot, or another action")
            by_hand = self.action.use_frame_range
            ends += list(self.action.frame_range) if by_hand else [end for curve in own for end in curve.range()]
        return round(min(ends)), round(max(ends))


def played(animation):
    """The take's own action and slot, also while its sheet is shown."""
    action, slot = animation.action, getattr(animation, "action_slot", None)
    if action is not None and STEPPED in action:
        source = action.get(SOURCE)
        if source is None and not strips(animation):
            raise Refused(f"{action.name} is on a sheet, and its take is gone: let the object play a take")
        if source is not None and slot is not None:
            slot = next((own for own in source.slots if own.identifier == slot.identifier), None)
        return source, slot
    return action, slot


def strips(animation):
    """The strips of actions that have a say."""
    if not animation.use_nla:
        return []
    tracks = [track for track in animation.nla_tracks if not track.mute]
    alone = [track for track in tracks if track.is_solo]
    of_tracks = [strip for track in alone or tracks for strip in track.strips]
    return [strip for strip in of_tracks if strip.action is not None and not strip.mute]


def show(thing, action, slot):
    """Lets an object play an action in the slot of that name."""
    animation = thing.animation_data
    animation.action = action
    if action is not None and slot is not None and hasattr(animation, "action_slot"):
        own = next((own for own in action.slots if own.identifier == slot.identifier), None)
        if own is not None:
            animation.action_slot = own
