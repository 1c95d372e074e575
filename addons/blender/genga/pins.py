# SPDX-License-Identifier: GPL-3.0-or-later
"""A person's corrections: pinned and forbidden frames, as the names of markers say. Independent of Blender.

A marker `pin` or `pin contact` pins its frame. A marker `forbid` forbids its frame, and `forbid from` with the next
`forbid to` all frames from one to the other. The name of an armature in brackets behind it, `pin [Armature]`, says whose
it is; without one it is for all.
"""

import re
from typing import NamedTuple

from .refused import Refused

# First words of such markers.
PIN, FORBID = ("pin", "固定"), ("forbid", "禁止")
FROM, TO = ("from", "から"), ("to", "まで")
OWNED = re.compile(r"\s*\[([^\[\]]*)\]\s*$")


class Corrections(NamedTuple):
    """Pins with the names of their keys, and ranges of forbidden frames, whose end is not forbidden."""

    pins: tuple
    forbidden: tuple

    def with_pins(self, frames):
        """Adds pins without a name."""
        there = {frame for frame, _ in self.pins}
        return Corrections((*self.pins, *((frame, "") for frame in frames if frame not in there)), self.forbidden)

    def of_clip(self, start):
        """Returns both in the program's notation. `start` is Blender's frame for the clip's frame 0."""
        pins = [f"{frame - start}:{name}" if name else f"{frame - start}" for frame, name in self.pins]
        return pins, [f"{begin - start}..{past - start}" for begin, past in self.forbidden]


def is_mark(name):
    """Reports whether a marker of this name pins or forbids."""
    return first_word(name) in (*PIN, *FORBID)


def owner(name):
    """Returns the name of the armature that a marker is for, or "" if it is for all."""
    found = OWNED.search(name)
    return found[1] if found else ""


def plain(name):
    """Returns what a marker says, whoever it is for."""
    return OWNED.sub("", name)


def owned(name, thing):
    """Returns the name of a marker for an armature. Brackets in the armature's name would end it."""
    return f"{plain(name)} [{clean(thing)}]"


def clean(thing):
    return thing.replace("[", "(").replace("]", ")")


def first_word(name):
    return name.strip().partition(" ")[0].casefold()


def read(marks):
    """Reads markers: pairs of name and frame."""
    pins, forbidden, begin = [], [], None
    for name, frame in sorted(marks, key=lambda mark: mark[1]):
        word, rest = first_word(name), name.strip().partition(" ")[2].strip()
        if word in PIN:
            pins.append((frame, rest))
        elif word not in FORBID:
            continue
        elif rest.casefold() in FROM and begin is None:
            begin = frame
        elif rest.casefold() in TO and begin is not None:
            forbidden.append((begin, frame + 1))
            begin = None
        elif not rest:
            forbidden.append((frame, frame + 1))
        else:
            raise Refused(f"marker “{name}” on frame {frame} {fault(rest, begin)}")
    if begin is not None:
        raise Refused(f"marker “forbid from” on frame {begin} has no “forbid to” behind it")
    return Corrections(tuple(pins), tuple(forbidden))


def fault(rest, begin):
    """Says what is wrong with a marker that forbids."""
    if rest.casefold() in FROM:
        return f"follows another one on frame {begin} that has no “forbid to”"
    if rest.casefold() in TO:
        return "has no “forbid from” in front of it"
    return "is not understood: name it forbid, forbid from or forbid to"


def forbidding(frames):
    """Returns the markers that forbid some frames: pairs of name and frame."""
    made = []
    for begin, last in runs(frames):
        made += [("forbid", begin)] if begin == last else [("forbid from", begin), ("forbid to", last)]
    return made


def runs(numbers):
    """Returns the runs of consecutive numbers, each as its first and its last."""
    made = []
    for number in sorted(set(numbers)):
        if made and number == made[-1][1] + 1:
            made[-1] = (made[-1][0], number)
        else:
            made.append((number, number))
    return made
