# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: settings that go together. A preset sets its own and resets all others of the presets."""

# Identifier, label, description, and the settings that are not the usual ones.
PRESETS = (
    ("usual", "Usual", "All settings of the presets as at first", {}),
    ("twos", "On Twos", "One drawing every two koma", {"on": "2"}),
    ("threes", "On Threes", "One drawing every three koma", {"on": "3"}),
    ("modulated", "Ones to Threes", "Chosen for the motion of each interval", {"on": "1-3"}),
    ("snappy", "Snappy", "Faster in the middle of a movement", {"snap": 0.5, "naka_nashi": 4.0}),
    ("soft", "Soft", "Even spacing, no inbetweens left out", {"snap": 0.1, "naka_nashi": 0.0}),
    ("few", "Few Genga", "Only genga that prevent a large error", {"rest": "keys.min_price=16"}),
)

ITEMS = [preset[:3] for preset in PRESETS]

# Settings that a preset resets.
NAMES = ("genga", "drawings", "on", "snap", "naka_nashi", "koma_dori", "rest")


def values(name, knobs):
    """Returns the values of all settings of the presets."""
    own = next(preset[3] for preset in PRESETS if preset[0] == name)
    usual = {name: knobs.bl_rna.properties[name].default for name in NAMES}
    return {**usual, **own}
