# SPDX-License-Identifier: GPL-3.0-or-later
"""The armature that the panel is about, and its id, which the file keeps."""

from uuid import uuid4

import bpy

from .refused import Refused


def armature_of(context):
    """Returns the active armature, or the one that moves the active mesh; None if there is none."""
    # Of the view layer, because a timer has no window with an active object.
    thing = context.view_layer.objects.active
    while thing is not None and thing.type != "ARMATURE":
        thing = thing.find_armature() or thing.parent
    return thing


def editable(context):
    """Returns the armature for an operator that changes it. One of another file keeps nothing."""
    thing = armature_of(context)
    if not thing.is_editable:
        raise Refused(f"{thing.name} is linked from another file: make a library override (Object › Library Override)")
    return thing


def give_id(thing):
    """Returns the armature's own id, and makes one if it has none or shares it with the armature that it is a copy of."""
    own = thing.genga.own_id
    is_original = lambda other: other.genga.own_id == own and other.session_uid < thing.session_uid
    if not own or any(is_original(other) for other in bpy.data.objects if other != thing):
        thing.genga.own_id = uuid4().hex
    return thing.genga.own_id
