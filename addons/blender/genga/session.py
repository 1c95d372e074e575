"""What is known of each armature until another file is opened: what was sampled, and its last result.

Nothing of Blender's is kept, only names: an undo makes all of that anew.
"""

import bpy

from . import apply, fit, marks, settings
from .refused import Refused, kinds
from .take import Take

SESSIONS = {}
# What a turn of a knob came to, shown in the panel.
TOLD = {}


def of(thing):
    """The session of an object, or nothing."""
    return SESSIONS.get(thing.name) if thing is not None else None


def asked(thing, take, sampled):
    """The recipe and the targets of an object's knobs, with the keys that are marked by hand."""
    marked = [frame for frame in marks.marked(take) if sampled.start <= frame <= sampled.end]
    return settings.recipe(thing.genga, marked, sampled.start), settings.targets(thing.genga)


def put(scene, thing, take, session):
    """The session's result onto its rig; gives what is found, and what the rig does not show."""
    sheet = session.sheet()
    on_sheet = apply.apply(thing, take, session.sampled, sheet)
    marks.remove_markers(scene, thing)
    if thing.genga.markers:
        marks.set_markers(scene, thing, apply.numbered(on_sheet.exposures, on_sheet.frames))
    TOLD[thing.name] = session.told()
    return TOLD[thing.name], fit.left_out(sheet)


def again(scene, thing):
    """Runs what was sampled again, with the knobs as they are; what is wrong is shown in the panel."""
    session = of(thing)
    if session is None:
        return
    try:
        take = Take(thing)
        if take.name != session.sampled.take:
            raise Refused("another action plays now: find its keys first")
        session.find(*asked(thing, take, session.sampled))
        put(scene, thing, take, session)
    except kinds() as error:
        TOLD[thing.name] = [str(error)]


@bpy.app.handlers.persistent
def forget(*_):
    """Another file is opened."""
    SESSIONS.clear()
    TOLD.clear()
