# SPDX-License-Identifier: GPL-3.0-or-later
"""Sampled takes and last results of each armature, kept until another file is opened.

Stores names instead of Blender's data, because an undo recreates that data.
"""

import bpy

from . import apply, fit, marks, settings
from .refused import Refused, kinds
from .take import Take

FINDINGS = {}
# Messages of the last run, shown in the panel.
TOLD = {}


def of(thing):
    """Returns the finding of an object, or None."""
    return FINDINGS.get(thing.name) if thing is not None else None


def asked(thing, take, sampled):
    """Returns the recipe and the targets from an object's settings, with keys marked by hand as pins."""
    marked = [frame for frame in marks.marked(take) if sampled.start <= frame <= sampled.end]
    return settings.recipe(thing.genga, marked, sampled.start), settings.targets(thing.genga)


def put(scene, thing, take, finding):
    """Applies the result to its rig. Returns sentences about the result, and about what the rig cannot show."""
    sheet = finding.sheet()
    turns = finding.turns(sheet)
    on_sheet = apply.apply(thing, take, finding.sampled, sheet, turns)
    marks.remove_markers(scene, thing)
    if thing.genga.markers:
        marks.set_markers(scene, thing, apply.numbered(on_sheet.exposures, on_sheet.frames))
    told, left_out = finding.told(), [*fit.left_out(sheet, holds=True), *on_sheet.left_out]
    if fit.can_hold(sheet) and not turns:
        left_out.append("no foot stands still in this take, so no foot is held")
    TOLD[thing.name] = [*told, *left_out]
    return told, left_out


def again(scene, thing):
    """Runs the sampled take again with the current settings. Shows errors in the panel."""
    finding = of(thing)
    if finding is None:
        return
    try:
        take = Take(thing)
        if take.name != finding.sampled.take:
            raise Refused("another action is active: find its keys first")
        finding.find(*asked(thing, take, finding.sampled))
        put(scene, thing, take, finding)
    except kinds() as error:
        TOLD[thing.name] = [str(error)]


@bpy.app.handlers.persistent
def forget(*_):
    """Forgets all findings when another file is opened."""
    FINDINGS.clear()
    TOLD.clear()
