# SPDX-License-Identifier: GPL-3.0-or-later
"""genga in Blender: finds the key drawings of an armature's take, and applies timesheets to rigs."""

import bpy
from bpy.props import PointerProperty

from . import bones, export, find, findings, from_file, knobs, panel, turn, words

CLASSES = (
    knobs.GengaKnobs,
    *from_file.OPERATORS,
    find.GENGA_OT_find_keys,
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
    operator = bpy.app.translations.contexts.operator_default
    bpy.app.translations.register(__name__, words.translations(operator))


def unregister():
    findings.forget()
    bpy.app.translations.unregister(__name__)
    bpy.app.handlers.load_post.remove(findings.forget)
    bpy.types.TOPBAR_MT_file_import.remove(from_file.menu)
    del bpy.types.Bone.genga_left_out
    del bpy.types.Object.genga
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
