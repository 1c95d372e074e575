"""A person's corrections: which frames are keys whatever is found, and near which none is. Knows nothing of Blender.

They are written as the program takes them, `40:contact` and `50..60`, with the frames of Blender's timeline.
"""

import re

from .refused import Refused

PIN = re.compile(r"\s*(-?\d+)\s*(:.*)?")
FORBIDDEN = re.compile(r"\s*(-?\d+)\s*(?:\.\.\s*(-?\d+)\s*)?")


def words(text):
    return [word for word in text.split(",") if word.strip()]


def pins(text, start):
    """Pins by the frames of the clip; `start` is Blender's frame of the clip's frame 0."""
    return [f"{int(found[1]) - start}{(found[2] or '').rstrip()}" for found in read(PIN, text, "a pin", "40:contact")]


def forbidden(text, start):
    """Forbidden frames by those of the clip; the last one of a range is not forbidden."""
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
    """The frames that are pinned in a text, without names."""
    return {int(found[1]) for found in read(PIN, text, "a pin", "40:contact")}


def with_pins(text, more):
    """A text with pins at more frames; those that are there keep their names."""
    there = frames(text)
    return joined([*words(text), *(str(frame) for frame in sorted(more) if frame not in there)])


def with_forbidden(text, more):
    """A text with more forbidden frames, runs of them as ranges."""
    return joined([*words(text), *(word for word in runs(more) if word not in map(str.strip, words(text)))])


def without(text, gone):
    """A text without the pins at some frames."""
    return joined(word for word in words(text) if int(PIN.fullmatch(word)[1]) not in gone)


def joined(parts):
    return ", ".join(part.strip() for part in parts)


def runs(numbers):
    """Numbers as the program takes them: one alone, several in a row as `50..53` up to but not including the last."""
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
