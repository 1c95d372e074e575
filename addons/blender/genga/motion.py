# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts poses, as matrices, to a genga clip. Independent of Blender."""

import numpy as np

from .refused import Refused, engine

# Share of body height by which a pose that was not mended may differ.
SAME = 1e-6


def clip(bones, chosen, poses, rest, rate, name):
    """Builds a clip of the chosen bones.

    `poses` are their world matrices, frames × bones × 4 × 4 in the order of `chosen`. `rest` are their world rest
    matrices. As in BVH, rotations are relative to the rest pose, because genga compares rigs by the body at rest.
    """
    parents = np.array(chosen.parents)
    unturned = np.swapaxes(turns(rest[:, :3, :3]), -1, -2)
    rotations = turns(poses[..., :3, :3]) @ unturned
    still = np.broadcast_to(np.eye(3), (1, len(chosen.bones), 3, 3))
    return engine().Clip(
        names=[bones[at].name for at in chosen.bones],
        parents=chosen.parents,
        offsets=against(parents, still, rest[None, :, :3, 3])[0],
        rotations=quaternions(local(parents, rotations)),
        translations=against(parents, rotations, poses[..., :3, 3]),
        tips=tips(bones, chosen, rest),
        rate=rate,
        name=name,
    )


def cleaned(whole):
    """Returns a clip without inserted poses and glitches, and the frames whose pose was mended."""
    clip = whole.cleaned()
    if not any(told["code"] == "W_GLITCH" for told in clip.warnings):
        return clip, frozenset()
    off = clip.distances(within(whole, clip.first, clip.first + len(clip)))
    return clip, frozenset(int(at) + clip.first for at in np.flatnonzero(off > SAME))


def within(clip, first, past):
    """Returns the frames of a clip from `first` up to, not including, `past`."""
    return clip.cleaned(keep_lead_in=True, keep_glitches=True, trim=(first, past))


def turns(matrices):
    """Extracts rotations from matrices, without scale and mirroring."""
    if not np.isfinite(matrices).all():
        raise Refused("the pose has values that are no numbers: check constraints and drivers")
    lengths = np.linalg.norm(matrices, axis=-2, keepdims=True)
    if (lengths < 1e-9).any():
        raise Refused("a bone is scaled to zero: leave it out")
    made = matrices.astype(np.float64) / lengths
    mirrored = np.linalg.det(made) < 0.0
    made[mirrored] = made[mirrored] * (-1.0, 1.0, 1.0)
    return made


def local(parents, rotations):
    """Converts rotations to be relative to the parent's. Roots stay unchanged."""
    made = rotations.copy()
    hang = np.flatnonzero(parents >= 0)
    made[:, hang] = np.swapaxes(rotations[:, parents[hang]], -1, -2) @ rotations[:, hang]
    return made


def against(parents, rotations, places):
    """Converts positions to the parent's axes. Roots stay unchanged."""
    places = places.astype(np.float64)
    hang = np.flatnonzero(parents >= 0)
    apart, made = places[:, hang] - places[:, parents[hang]], places.copy()
    made[:, hang] = np.einsum("fjba,fjb->fja", rotations[:, parents[hang]], apart)
    return made


def quaternions(matrices):
    """Converts matrices to quaternions x, y, z, w. Divides by the largest of the four, for precision."""
    m = np.moveaxis(matrices, (-2, -1), (0, 1))
    trace = m[0, 0] + m[1, 1] + m[2, 2]
    squares = np.stack([*(1.0 + 2.0 * m[at, at] - trace for at in range(3)), 1.0 + trace])
    rows = np.stack(
        [
            np.stack([squares[0], m[0, 1] + m[1, 0], m[2, 0] + m[0, 2], m[2, 1] - m[1, 2]], -1),
            np.stack([m[0, 1] + m[1, 0], squares[1], m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]], -1),
            np.stack([m[2, 0] + m[0, 2], m[1, 2] + m[2, 1], squares[2], m[1, 0] - m[0, 1]], -1),
            np.stack([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], squares[3]], -1),
        ]
    )
    largest = squares.argmax(axis=0)
    made = np.take_along_axis(rows, largest[None, ..., None], axis=0)[0]
    return made / np.linalg.norm(made, axis=-1, keepdims=True)


def tips(bones, chosen, rest):
    """Returns the ends of bones without children, and NaN for others."""
    ends = np.full((len(chosen.bones), 3), np.nan)
    for row, at in enumerate(chosen.bones):
        if row not in chosen.parents:
            ends[row] = rest[row, :3, 1] * bones[at].length
    return ends
