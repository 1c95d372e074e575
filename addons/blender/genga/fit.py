# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks whether an action is the take that a sheet was made from. Independent of Blender.

A sheet stores the joint names and the length of its take. Two takes with the same length and skeleton cannot be
distinguished.
"""

import re

# Largest number of names listed in a message.
MOST_NAMES = 5

BONE = re.compile(r'pose\.bones\["((?:[^"\\]|\\.)*)"\]')


def plain(name):
    """Normalises a name as importers change it: removes a namespace, a numeric suffix, case and punctuation."""
    name = re.sub(r"\.\d+$", "", name.rpartition(":")[2])
    return "".join(letter for letter in name.casefold() if letter.isalnum())


def bone_of(path):
    """Returns the bone that a data path animates, or None."""
    found = BONE.match(path)
    return re.sub(r"\\(.)", r"\1", found.group(1)) if found else None


def listed(names):
    more = ", …" if len(names) > MOST_NAMES else ""
    return ", ".join(names[:MOST_NAMES]) + more


def doubts(sheet, bones, keyed, first_frame, step):
    """Returns sentences about why an action may be another take.

    `bones` are the names of the rig's bones, `keyed` the first and the last frame with a key, `first_frame` the frame
    of source frame 0, and `step` the number of frames per source frame.
    """
    there = {plain(bone) for bone in bones}
    missing = [joint for joint in sheet.joints if plain(joint) not in there]
    found = []
    if missing:
        found.append(f"the rig lacks {len(missing)} of {len(sheet.joints)} joints of {sheet.take}: {listed(missing)}")
    begin, end = keyed
    last = first_frame + (sheet.first + sheet.frames - 1) * step
    if abs(begin - first_frame) > 0.5:
        found.append(f"the action begins on frame {begin:g}, but source frame 0 is set to {first_frame:g}")
    if end < last - 0.5:
        found.append(f"the action ends on frame {end:g}, but {sheet.take} lasts until {last:g}")
    if end > last + 0.5:
        found.append(f"the action lasts until frame {end:g}, but {sheet.take} ends on {last:g} (or was trimmed)")
    return found


def can_hold(sheet):
    """Reports whether the rig can hold the sheet's feet: each drawing must be one pose of the take."""
    return sheet.feet_held and len(sheet.layers) == 1 and not sheet.root_on_ones and not sheet.exaggerated


def left_out(sheet, holds=False):
    """Returns sentences about what an action cannot show of a sheet. `holds`: whether feet are held if possible."""
    found = []
    if sheet.exaggerated:
        found.append("the sheet shows an exaggerated motion, but the rig plays the original")
    if sheet.root_on_ones:
        found.append("the sheet has the root on ones, but here it moves with its drawings")
    if sheet.feet_held and not (holds and can_hold(sheet)):
        found.append("the sheet holds the feet, but here they move with their drawings")
    return [f"{sentence}; limited.bvh has it" for sentence in found]


def by_layer(layers, joints, paths):
    """Returns the data paths of each layer's bones, and the bones that are in no layer.

    Those bones, and paths without a bone, join the layer of the first joint, which carries the body.
    """
    if len(layers) == 1:
        return [list(paths)], []
    owner = {plain(joint): at for at, layer in enumerate(layers) for joint in layer.joints}
    carrier = owner.get(plain(joints[0]), 0) if joints else 0
    parts, strangers = [[] for _ in layers], []
    for path in paths:
        bone = bone_of(path)
        at = carrier if bone is None else owner.get(plain(bone))
        if at is None:
            strangers.append(bone)
            at = carrier
        parts[at].append(path)
    return parts, sorted(set(strangers))
