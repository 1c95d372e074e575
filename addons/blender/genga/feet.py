"""Feet that stay where they stand (接地): how far the bones of the legs turn out of a drawing's own pose. Knows nothing of Blender."""

import numpy as np


def turns(held, free, rest):
    """How each bone that gives way is turned, on every koma, in its own axes: its name, and koma × 3 × 3.

    `held` and `free` are the motion on the sheet with and without held feet, clips of the same bones; `rest` is where these
    stand at rest, bones × 4 × 4.
    """
    gives_way = (held.rotations != free.rotations).any(axis=(0, 2))
    made = {}
    for at in np.flatnonzero(gives_way):
        turn = np.swapaxes(matrices(free.rotations[:, at]), -1, -2) @ matrices(held.rotations[:, at])
        # As they are drawn, mirrored ones too: a turn stays a turn.
        axes = rest[at, :3, :3] / np.linalg.norm(rest[at, :3, :3], axis=0)
        made[held.names[at]] = np.linalg.inv(axes) @ turn @ axes
    return made


def matrices(rotations):
    """Rotations x, y, z, w as matrices, 3 × 3."""
    x, y, z, w = np.moveaxis(rotations, -1, 0)
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    return np.stack([np.stack(row, -1) for row in rows], -2)
