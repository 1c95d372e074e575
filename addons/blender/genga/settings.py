# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts the panel's settings to genga's settings and targets. Independent of Blender."""

from .refused import Refused, engine


def share(percent):
    """Formats a share of the inbetweens for a recipe. Simple fractions such as 1/3 are exact."""
    for parts in (3, 6, 7, 9):
        taken = percent * parts / 100.0
        if round(taken) and abs(taken - round(taken)) < 1e-4 and not number(percent).is_integer():
            return f"{round(taken)}/{parts}"
    return f"{number(percent):g}%"


def recipe(knobs, corrections, start):
    """Builds the recipe from the settings and corrections. `start` is Blender's frame for the clip's frame 0."""
    made = engine().Recipe()
    made.update(
        {
            "rate": number(knobs.rate),
            **timed(knobs),
            "feet": "held" if knobs.feet else "free",
            "loop": knobs.loop,
            "cycles": knobs.cycles if knobs.loop else 1,
        }
    )
    passages = [passage(own, start) for own in knobs.passages]
    if passages:
        made.update({"passages": passages, "outside": knobs.outside.lower()})
    for name, value in rest(knobs.rest):
        made.update({name: value})
    pins, forbidden = corrections.of_clip(start)
    made.correct(pins=pins, forbid=forbidden, only_pins=knobs.only_pins)
    return made


def timed(knobs):
    """Returns the settings that a passage can have of its own."""
    return {
        "spacing.on": knobs.on,
        "spacing.weight": number(knobs.snap),
        "omission.naka_nashi": share(knobs.naka_nashi),
        "omission.koma_dori": share(knobs.koma_dori),
    }


def passage(own, start):
    """Returns a passage of a recipe."""
    begin, past = max(own.start - start, 0), own.end - start + 1
    if past <= begin:
        raise Refused(f"the passage from {own.start} to {own.end} has no frame of the take, which begins on {start}")
    return {"frames": [begin, past], **timed(own), **dict(rest(own.rest))}


def number(value):
    """Rounds a single-precision number of Blender to the intended value: 0.2, not 0.20000000298."""
    return float(f"{value:.6g}")


def targets(knobs):
    """Returns the targets of the sheet. 0 means no target."""
    return {"keys": knobs.genga or None, "drawings_per_second": number(knobs.drawings) or None}


def rest(text):
    """Parses further settings by name: `keys.min_price=8; filter.width=0.2s`."""
    made = []
    for word in text.replace("\n", ";").split(";"):
        if not word.strip():
            continue
        name, is_set, value = word.partition("=")
        if not is_set or not value.strip():
            raise Refused(f"a setting is a name and a value, such as keys.min_price=8, found “{word.strip()}”")
        made.append((name.strip(), value.strip()))
    return made
