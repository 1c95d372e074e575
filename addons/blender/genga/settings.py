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


def recipe(knobs, marked, start):
    """Builds the recipe from the settings and corrections. `marked` are frames with keys of type Extreme."""
    from . import pins

    made = engine().Recipe()
    made.update(
        {
            "rate": number(knobs.rate),
            "spacing.on": knobs.on,
            "spacing.weight": number(knobs.snap),
            "omission.naka_nashi": share(knobs.naka_nashi),
            "omission.koma_dori": share(knobs.koma_dori),
            "feet": "held" if knobs.feet else "free",
        }
    )
    for name, value in rest(knobs.rest):
        made.update({name: value})
    made.correct(
        pins=pins.pins(pins.with_pins(knobs.pins, marked), start),
        forbid=pins.forbidden(knobs.forbid, start),
        only_pins=knobs.only_pins,
    )
    return made


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
