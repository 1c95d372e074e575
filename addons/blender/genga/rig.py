# SPDX-License-Identifier: GPL-3.0-or-later
"""Selects a rig's bones for a clip, and their hierarchy. Independent of Blender.

Rigs also have controls, targets and mechanisms. Each selected bone becomes a child of its nearest selected ancestor.
"""

from fnmatch import fnmatchcase
from typing import NamedTuple

import numpy as np

from .refused import Refused

# Two bones coincide if their heads are this close, relative to the longest bone, and their directions this similar.
NEAR = 1e-4
SAME_WAY = 0.999


class Bone(NamedTuple):
    """A bone at rest, in armature space. `rest` is its 4 × 4 matrix."""

    name: str
    parent: int
    rest: np.ndarray
    length: float
    deforms: bool = True
    is_left_out: bool = False

    @property
    def head(self):
        return self.rest[:3, 3]

    @property
    def way(self):
        return self.rest[:3, 1]


class Chosen(NamedTuple):
    """The bones of a clip: their indices in the rig, parents first, and the index of each parent among them, or -1."""

    bones: list
    parents: list


def choose(bones, deforming, leave_out):
    """Returns the selected bones and their hierarchy."""
    stays = staying([(bone.name, bone.deforms) for bone in bones], deforming, leave_out)
    stay = [at for at, bone in enumerate(bones) if stays[at] and not bone.is_left_out]
    stay = singles(bones, stay)
    if not stay:
        raise Refused("no bone is left: leave out fewer bones, or include bones that do not deform")
    return in_order(stay, Ancestry(bones, stay).parents())


def staying(bones, deforming, leave_out):
    """Reports for each bone (name, whether it deforms) whether it stays. If `deforming` and any bone deforms, drops the
    others. Drops bones that match a pattern of `leave_out`."""
    patterns = [pattern.strip().casefold() for pattern in leave_out.split(",") if pattern.strip()]
    only_deforming = deforming and any(deforms for _, deforms in bones)
    is_named = lambda name: any(fnmatchcase(name.casefold(), pattern) for pattern in patterns)
    return [(deforms or not only_deforming) and not is_named(name) for name, deforms in bones]


def singles(bones, stay):
    """Keeps the first of coinciding bones. Rigs have bones that copy others, such as the D bones of MMD's legs.

    Keeps both if one descends from the other: a body's first bones often begin in one place.
    """
    near = NEAR * max((bone.length for bone in bones), default=0.0)
    heads = np.array([bones[at].head for at in stay]).reshape(-1, 3)
    tails = heads + np.array([bones[at].way * bones[at].length for at in stay]).reshape(-1, 3)
    made = []
    for row, at in enumerate(stay):
        same = (np.abs(heads[:row] - heads[row]).max(axis=1) <= near) & (np.abs(tails[:row] - tails[row]).max(axis=1) <= near)
        doubled = [stay[other] for other in np.flatnonzero(same)]
        if not any(not hangs_on(bones, at, other) and not hangs_on(bones, other, at) for other in doubled):
            made.append(at)
    return made


def hangs_on(bones, at, other):
    """Reports whether a bone is another or a descendant of it."""
    while at >= 0:
        if at == other:
            return True
        at = bones[at].parent
    return False


class Ancestry:
    """Finds the parent of each bone among the bones that stay."""

    def __init__(self, bones, stay):
        self.bones, self.stay = bones, stay
        self.near = NEAR * max(bone.length for bone in bones)
        self.is_staying = set(stay)

    def parents(self):
        found = {}
        for at in self.stay:
            found[at] = self.parent(at, found)
        return found

    def parent(self, at, found):
        """Returns the nearest ancestor that stays, or a bone that stays and coincides with an ancestor.

        In control rigs, deforming bones are children of mechanism bones that coincide with other deforming bones.
        """
        above = self.bones[at].parent
        while above >= 0:
            if above in self.is_staying:
                return above
            for other in self.stay:
                if other != at and self.lies_on(other, above) and not is_above(at, other, found):
                    return other
            above = self.bones[above].parent
        return -1

    def lies_on(self, one, other):
        one, other = self.bones[one], self.bones[other]
        is_near = np.linalg.norm(one.head - other.head) <= self.near
        return is_near and float(one.way @ other.way) >= SAME_WAY


def is_above(at, other, parents):
    """Reports whether `at` is `other` or a known ancestor of it."""
    while other >= 0:
        if other == at:
            return True
        other = parents.get(other, -1)
    return False


def in_order(stay, parents):
    """Sorts bones so that parents come first, otherwise in the rig's order."""
    order, placed = [], {}

    def place(at):
        if at in placed:
            return
        if parents[at] >= 0:
            place(parents[at])
        placed[at] = len(order)
        order.append(at)

    for at in stay:
        place(at)
    return Chosen(order, [placed.get(parents[at], -1) for at in order])
