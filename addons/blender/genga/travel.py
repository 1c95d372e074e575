# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the channels of a rig get in a round of a loop, so that the body travels on."""

import numpy as np

# Share of the longest way in a rig from which on a bone or control travels with the body. Others come back.
TRAVELS = 0.5


def ways(thing, source, first, last):
    """Returns how far each location channel gets from one source frame to another, if its bone carries the body."""
    channels = [group for _, group in source.groups if group[0][0].endswith("location")]
    gone = [np.array([source.value(own, last) - source.value(own, first) for own in group]) for group in channels]
    lengths = [np.linalg.norm(way) * scale(thing, group[0][0]) for way, group in zip(gone, channels)]
    longest = max(lengths, default=0.0)
    made = {}
    for group, way, length in zip(channels, gone, lengths):
        if length > TRAVELS * longest:
            made.update(zip(group, way))
    return made


def scale(thing, path):
    """Returns the size of a unit of a location channel in the world."""
    return np.mean(thing.matrix_world.to_scale()) if path.startswith("pose.") else 1.0
