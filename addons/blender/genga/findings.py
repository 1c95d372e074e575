"""What is known of each armature until another file is opened: what was sampled, and its last result.

Nothing of Blender's is kept, only names: an undo makes all of that anew.
"""

import bpy

from . import apply, fit, marks, settings
from .refused import Refused, kinds
from .take import Take

FINDINGS = {}
# What a turn of a knob came to, shown in the panel.
TOLD = {}


def of(thing):
    """The finding of an object, or nothing."""
    return FINDINGS.get(thing.name) if thing is not None else None


def asked(thing, take, sampled):
    """The recipe and the targets of an object's knobs, with the keys that are marked by hand."""
    marked = [frame for frame in marks.marked(take) if sampled.start <= frame <= sampled.end]
    return settings.recipe(thing.genga, marked, sampled.start), settings.targets(thing.genga)


def put(scene, thing, take, finding):
    """The finding's result onto its rig; gives what is found, and what the rig does not show."""
    sheet = finding.sheet()
    turns = finding.turns(sheet)
    on_sheet = apply.apply(thing, take, finding.sampled, sheet, turns)
    marks.remove_markers(scene, thing)
    if thing.genga.markers:
        marks.set_markers(scene, thing, apply.numbered(on_sheet.exposures, on_sheet.frames))
    told, left_out = finding.told(), [*fit.left_out(sheet, holds=True), *on_sheet.left_out]
    if fit.can_hold(sheet) and not turns:
        left_out.append("no foot was seen to stand in this take, so that none is held")
    TOLD[thing.name] = [*told, *left_out]
    return told, left_out


def again(scene, thing):
    """Runs what was sampled again, with the knobs as they are; what is wrong is shown in the panel."""
    finding = of(thing)
    if finding is None:
        return
    try:
        take = Take(thing)
        if take.name != finding.sampled.take:
            raise Refused("another action plays now: find its keys first")
        finding.find(*asked(thing, take, finding.sampled))
        put(scene, thing, take, finding)
    except kinds() as error:
        TOLD[thing.name] = [str(error)]


@bpy.app.handlers.persistent
def forget(*_):
    """Another file is opened."""
    FINDINGS.clear()
    TOLD.clear()
