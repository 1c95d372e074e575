# SPDX-License-Identifier: GPL-3.0-or-later
"""Held feet (接地): how far the leg bones turn away from a drawing's own pose. Independent of Blender."""

import numpy as np


def turns(held, free, rest):
    """Returns the rotation of each bone that adapts, on every koma, in its own axes: its name, and koma × 3 × 3.

    `held` and `free` are the sheet's motion with and without held feet, clips of the same bones. `rest` holds the world
    rest matrices of the bones, bones × 4 × 4.
    """
    gives_way = (held.rotations != free.rotations).any(axis=(0, 2))
    made = {}
    for at in np.flatnonzero(gives_way):
        turn = np.swapaxes(matrices(free.rotations[:, at]), -1, -2) @ matrices(held.rotations[:, at])
        # Also correct for mirrored axes: the result is a rotation.
        axes = rest[at, :3, :3] / np.linalg.norm(rest[at, :3, :3], axis=0)
        made[held.names[at]] = np.linalg.inv(axes) @ turn @ axes
    return made


def matrices(rotations):
    """Converts quaternions x, y, z, w to 3 × 3 matrices."""
    x, y, z, w = np.moveaxis(rotations, -1, 0)
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    return np.stack([np.stack(row, -1) for row in rows], -2)
