"""Plots Table 1 of the first paper for any clip: python table_1.py [CLIP.bvh [PLOT.png]].

Without matplotlib it only prints the table.
"""

import sys

import genga

clip = genga.read(sys.argv[1] if len(sys.argv) > 1 else "data/kick.bvh")
table = genga.study(clip)
print(f"{'W':>4} {'M':>4} {'union':>6} {'total':>6}")
for w, m, union, total in zip(*(table[name] for name in ("filter.width", "turns.persistence", "union", "total"))):
    print(f"{w:>4} {m:>4} {union:6d} {total:6d}")

try:
    from matplotlib import pyplot
except ImportError:
    sys.exit()
for m in (5, 10):
    rows = table["turns.persistence"] == m
    pyplot.plot(table["filter.width"][rows], table["union"][rows], "o-", label=f"M = {m}")
pyplot.xlabel("W, frames")
pyplot.ylabel("key frames")
pyplot.legend()
pyplot.savefig(sys.argv[2] if len(sys.argv) > 2 else "table-1.png")
