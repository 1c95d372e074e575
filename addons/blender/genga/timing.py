# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts koma of a sheet to frames of a scene. Independent of Blender."""

import math

# Tolerance in frames, because rates are often written with few digits.
SAME = 0.01


class Timing:
    """Converts a koma, from 0, to the first scene frame that shows it. Koma 0 is on `start`."""

    def __init__(self, start, rate, fps):
        self.start, self.ratio = start, rate / fps

    def frame(self, koma):
        return self.start + math.ceil(koma * self.ratio - SAME)

    def of(self, exposures):
        """Returns exposures with their frames. If several share a frame, keeps the last."""
        shown = {self.frame(exposure.koma): exposure for exposure in exposures}
        return list(shown.values()), list(shown)
