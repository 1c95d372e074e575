"""Whether an action is the take that a sheet was made of, as far as both can tell. Knows nothing of Blender.

A sheet knows the names of the joints and the length of its take. Two takes of one length on one skeleton cannot be told
apart by that.
"""

import re

# More names than this are not listed.
MOST_NAMES = 5

BONE = re.compile(r'pose\.bones\["((?:[^"\\]|\\.)*)"\]')


def plain(name):
    """A name as importers leave it alone: without what stands before a colon, a number behind, case and marks."""
    name = re.sub(r"\.\d+$", "", name.rpartition(":")[2])
    return "".join(letter for letter in name.casefold() if letter.isalnum())


def bone_of(path):
    """The bone that a curve with this data path moves, or nothing."""
    found = BONE.match(path)
    return re.sub(r"\\(.)", r"\1", found.group(1)) if found else None


def listed(names):
    more = ", …" if len(names) > MOST_NAMES else ""
    return ", ".join(names[:MOST_NAMES]) + more


def doubts(sheet, bones, keyed, first_frame, step):
    """Why an action may be another take, in sentences.

    `bones` are the names of the rig's bones, `keyed` the first and the last frame with a key, `first_frame` where source
    frame 0 is said to lie and `step` how many frames a source frame takes.
    """
    there = {plain(bone) for bone in bones}
    missing = [joint for joint in sheet.joints if plain(joint) not in there]
    found = []
    if missing:
        found.append(f"the rig lacks {len(missing)} of {len(sheet.joints)} joints of {sheet.take}: {listed(missing)}")
    begin, end = keyed
    last = first_frame + (sheet.first + sheet.frames - 1) * step
    if abs(begin - first_frame) > 0.5:
        found.append(f"the action begins on frame {begin:g}, but source frame 0 is said to lie on {first_frame:g}")
    if end < last - 0.5:
        found.append(f"the action ends on frame {end:g}, but {sheet.take} goes on to {last:g}")
    if end > last + 0.5:
        found.append(f"the action goes on to frame {end:g}, but {sheet.take} ends on {last:g} (or was trimmed there)")
    return found


def can_hold(sheet):
    """Whether a rig that plays the take can hold the feet as a sheet has them: where each drawing is one pose of the take."""
    return sheet.feet_held and len(sheet.layers) == 1 and not sheet.root_on_ones and not sheet.exaggerated


def left_out(sheet, holds=False):
    """What a sheet has that the poses of an action do not show, in sentences. `holds`: feet are held where they can be."""
    found = []
    if sheet.exaggerated:
        found.append("the sheet is of an exaggerated motion, the rig plays the plain one")
    if sheet.root_on_ones:
        found.append("the sheet has the root on ones, here it stays with its drawings")
    if sheet.feet_held and not (holds and can_hold(sheet)):
        found.append("the sheet holds the feet, here they stay with their drawings")
    return [f"{sentence}; limited.bvh has it" for sentence in found]


def by_layer(layers, joints, paths):
    """For each layer the data paths of its own bones; then the bones that are in none.

    These, and what belongs to no bone, go with the layer of the first joint, which carries the body.
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
