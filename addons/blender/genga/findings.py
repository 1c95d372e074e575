# SPDX-License-Identifier: GPL-3.0-or-later
"""Sampled takes and last results of each armature, kept until another file is opened and then sampled again.

Keeps ids of the session instead of Blender's data, because an undo recreates that data.
"""

import bpy

from . import apply, fit, marks, settings
from .refused import Refused, kinds
from .run import Finding
from .sample import Sampling
from .subject import give_id
from .take import KOMA, OWNER, Take

FINDINGS = {}
# Corrections that the markers of each armature said last.
SEEN = {}


def of(thing):
    """Returns the finding of an armature, or None."""
    return FINDINGS.get(thing.session_uid) if thing is not None else None


def keep(thing, finding):
    """Keeps the finding of an armature, which gets its id."""
    give_id(thing)
    FINDINGS[thing.session_uid] = finding


def ask(scene, thing, take, finding):
    """Notes what is asked of a finding: the recipe and the targets from an armature's settings, keys marked by hand and
    markers."""
    sampled = finding.sampled
    SEEN[thing.session_uid] = read = marks.read(scene, thing)
    marked = [frame for frame in marks.marked(take) if sampled.start <= frame <= sampled.end]
    finding.asked = settings.recipe(thing.genga, read.with_pins(marked), sampled.start), settings.targets(thing.genga)


def put(scene, thing, take, finding):
    """Applies the result to its rig. Returns sentences about the result, and about what the rig cannot show."""
    sheet = finding.sheet()
    turns = finding.turns(sheet)
    on_sheet = apply.apply(thing, take, finding.sampled, sheet, turns)
    numbered = apply.numbered(on_sheet.exposures, on_sheet.frames) if thing.genga.markers else ()
    marks.set_numbers(scene, thing, numbered)
    told = [*finding.told(), *finding.sampled.told()]
    left_out = [*fit.left_out(sheet, holds=True), *on_sheet.left_out]
    if fit.can_hold(sheet) and not turns:
        left_out.append("no foot stands still in this take, so no foot is held")
    tell(thing, [*told, *left_out])
    return told, left_out


def tell(thing, sentences):
    """Shows messages of a run in the panel."""
    thing.genga.told = "\n".join(sentences)


def again(context, thing):
    """Runs the take again with the current settings, if keys of the armature were found before. Shows errors in the panel."""
    if not was_found(thing):
        return
    try:
        take = Take(thing)
        finding = of(thing)
        if finding is None or not finding.sampled.is_of(take):
            finding = Finding(sampled_anew(context, thing, take))
        # Anew too, because an undo takes the id.
        keep(thing, finding)
        ask(context.scene, thing, take, finding)
        finding.find()
        put(context.scene, thing, take, finding)
    except kinds() as error:
        tell(thing, [str(error)])


def was_found(thing):
    """Reports whether keys of an armature were found, in this session or before the file was saved."""
    own = thing.genga.own_id
    return of(thing) is not None or bool(own) and any(action.get(OWNER) == own for action in bpy.data.actions)


def sampled_anew(context, thing, take):
    """Samples a take whose keys were found before: in an earlier session, or with another action in between."""
    if apply.found(thing, take, KOMA) is None:
        raise Refused("another action is active: find its keys first")
    sampling = Sampling(context, thing)
    for _ in sampling.steps():
        pass
    return sampling.sampled()


@bpy.app.handlers.persistent
def forget(*_):
    """Forgets all findings when another file is opened."""
    FINDINGS.clear()
    SEEN.clear()
