# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs again after a person dragged, named or removed a marker that pins or forbids."""

import bpy

from . import findings, marks
from .refused import kinds
from .subject import armature_of

# Seconds between two looks. Blender tells nobody about markers.
LOOK = 0.5


def look():
    """Looks at the markers of the active armature, and asks to be called again."""
    context = bpy.context
    if not is_busy(context.window_manager):
        thing = armature_of(context)
        if thing is not None and thing.genga.live and findings.was_found(thing) and are_changed(context, thing):
            findings.again(context, thing)
    return LOOK


def is_busy(manager):
    """Reports whether Blender renders, or a person is in the midst of an operator: dragging holds on to markers, which a
    run replaces."""
    return manager.is_interface_locked or any(window.modal_operators for window in manager.windows)


def are_changed(context, thing):
    """Reports whether the markers of an armature say something else than at the last look."""
    try:
        read = marks.read(context.scene, thing)
    except kinds() as error:
        read = str(error)
    before = findings.SEEN.setdefault(thing.session_uid, read)
    findings.SEEN[thing.session_uid] = read
    return read != before
