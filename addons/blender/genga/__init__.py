# SPDX-License-Identifier: GPL-3.0-or-later
"""genga in Blender: finds the key drawings of an armature's take, and applies timesheets to rigs."""

import bpy
from bpy.props import PointerProperty

from . import bones, curves, export, find, findings, from_file, knobs, panel, preferences, turn, watch, words

CLASSES = (
    preferences.GengaPreferences,
    knobs.GengaPassage,
    knobs.GengaKnobs,
    *from_file.OPERATORS,
    find.GENGA_OT_find_keys,
    curves.GENGA_OT_curves,
    *turn.CLASSES,
    *bones.CLASSES,
    export.GENGA_OT_export,
    *panel.CLASSES,
)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Object.genga = PointerProperty(type=knobs.GengaKnobs)
    bpy.types.Bone.genga_left_out = bones.LEFT_OUT
    bpy.types.TOPBAR_MT_file_import.append(from_file.menu)
    bpy.app.handlers.load_post.append(findings.forget)
    bpy.app.timers.register(watch.look, first_interval=watch.LOOK, persistent=True)
    words.speak(preferences.of(bpy.context).language)


def unregister():
    findings.forget()
    words.be_silent()
    bpy.app.timers.unregister(watch.look)
    bpy.app.handlers.load_post.remove(findings.forget)
    bpy.types.TOPBAR_MT_file_import.remove(from_file.menu)
    del bpy.types.Bone.genga_left_out
    del bpy.types.Object.genga
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
