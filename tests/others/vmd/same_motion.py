"""Holds two BVH of one skeleton against each other: every angle and place within a hundredth."""

import sys


def rows(path):
    with open(path, encoding="utf-8") as file:
        head, motion = file.read().split("MOTION\n")
    return head, [[float(word) for word in line.split()] for line in motion.splitlines()[2:]]


(head, one), (other_head, other) = (rows(path) for path in sys.argv[1:])
assert head == other_head, "another skeleton"
assert len(one) == len(other), f"{len(one)} and {len(other)} frames"
# An angle may stand there with another whole turn.
apart = max(abs((a - b + 180) % 360 - 180) for a, b in zip(sum(one, []), sum(other, [])))
assert apart < 0.05, f"off by {apart}"
print(f"a motion that pypmxvmd wrote: {len(one)} frames, off by {apart:.4f} at most")
