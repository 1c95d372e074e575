# SPDX-License-Identifier: GPL-3.0-or-later
"""A person's corrections: pinned and forbidden frames. Independent of Blender.

They use the program's notation, `40:contact` and `50..60`, with frames of Blender's timeline.
"""

import re

from .refused import Refused

PIN = re.compile(r"\s*(-?\d+)\s*(:.*)?")
FORBIDDEN = re.compile(r"\s*(-?\d+)\s*(?:\.\.\s*(-?\d+)\s*)?")


def words(text):
    return [word for word in text.split(",") if word.strip()]


def pins(text, start):
    """Converts pins to frames of the clip. `start` is Blender's frame for the clip's frame 0."""
    return [f"{int(found[1]) - start}{(found[2] or '').rstrip()}" for found in read(PIN, text, "a pin", "40:contact")]


def forbidden(text, start):
    """Converts forbidden frames to frames of the clip. Ranges exclude their last frame."""
    made = []
    for found in read(FORBIDDEN, text, "a forbidden frame", "50 or 50..60"):
        ends = [str(int(end) - start) for end in found.groups() if end is not None]
        made.append("..".join(ends))
    return made


def read(pattern, text, what, such_as):
    found = [(word, pattern.fullmatch(word)) for word in words(text)]
    for word, match in found:
        if match is None:
            raise Refused(f"{what} is a frame, such as {such_as}, found “{word.strip()}”")
    return [match for _, match in found]


def frames(text):
    """Returns the pinned frames in a text, without names."""
    return {int(found[1]) for found in read(PIN, text, "a pin", "40:contact")}


def with_pins(text, more):
    """Adds pins at more frames to a text. Existing pins keep their names."""
    there = frames(text)
    return joined([*words(text), *(str(frame) for frame in sorted(more) if frame not in there)])


def with_forbidden(text, more):
    """Adds forbidden frames to a text, runs of them as ranges."""
    return joined([*words(text), *(word for word in runs(more) if word not in map(str.strip, words(text)))])


def without(text, gone):
    """Removes the pins at some frames from a text."""
    return joined(word for word in words(text) if int(PIN.fullmatch(word)[1]) not in gone)


def joined(parts):
    return ", ".join(part.strip() for part in parts)


def runs(numbers):
    """Formats frames in the program's notation: single frames, and runs as `50..53`, which excludes 53."""
    begin = last = None
    made = []
    for number in [*sorted(numbers), None]:
        if last is not None and number != last + 1:
            made.append(str(begin) if begin == last else f"{begin}..{last + 1}")
            begin = number
        elif begin is None:
            begin = number
        last = number
    return made
