"""Reads a VMD and writes it again, as PyPI's pypmxvmd does: names, numbers and curves are then its own."""

import sys

import pypmxvmd

source, target = sys.argv[1:]
motion = pypmxvmd.load_vmd(source)
pypmxvmd.save_vmd(motion, target)
with open(source, "rb") as before, open(target, "rb") as after:
    assert before.read() != after.read(), "the same bytes: nothing is shown"
