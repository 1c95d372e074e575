"""Poses as matrices into a clip of genga. Knows nothing of Blender."""

import numpy as np

from .refused import Refused, engine


def clip(bones, chosen, poses, rest, rate, name):
    """A clip of the chosen bones.

    `poses` are where they stand in the world, frames × bones × 4 × 4 in the order of `chosen`, and `rest` is where they
    stand at rest. A bone that is as at rest is not turned, as in BVH: the body at rest is what genga compares rigs by.
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


def turns(matrices):
    """The rotations in some matrices: without scale, and without a mirror."""
    if not np.isfinite(matrices).all():
        raise Refused("the pose has values that are no numbers: a constraint or a driver fails")
    lengths = np.linalg.norm(matrices, axis=-2, keepdims=True)
    if (lengths < 1e-9).any():
        raise Refused("a bone is scaled to nothing: leave it out")
    made = matrices.astype(np.float64) / lengths
    mirrored = np.linalg.det(made) < 0.0
    made[mirrored] = made[mirrored] * (-1.0, 1.0, 1.0)
    return made


def local(parents, rotations):
    """Each rotation against its parent's; a root's as it is."""
    made = rotations.copy()
    hang = np.flatnonzero(parents >= 0)
    made[:, hang] = np.swapaxes(rotations[:, parents[hang]], -1, -2) @ rotations[:, hang]
    return made


def against(parents, rotations, places):
    """Each place in the axes of its parent; a root's as it is."""
    places = places.astype(np.float64)
    hang = np.flatnonzero(parents >= 0)
    apart, made = places[:, hang] - places[:, parents[hang]], places.copy()
    made[:, hang] = np.einsum("fjba,fjb->fja", rotations[:, parents[hang]], apart)
    return made


def quaternions(matrices):
    """Rotations as x, y, z, w: by whichever of the four is largest, so that nothing is divided by what is small."""
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
    """Where the bones end on which no other hangs; the others are open."""
    ends = np.full((len(chosen.bones), 3), np.nan)
    for row, at in enumerate(chosen.bones):
        if row not in chosen.parents:
            ends[row] = rest[row, :3, 1] * bones[at].length
    return ends
