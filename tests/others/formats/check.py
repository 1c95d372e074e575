"""python check.py FOLDER NAME…: of each clip the key tables and the whole motion, from BVH, FBX and GLB, side by side.

FBX and GLB come from Blender and from assimp.

FOLDER has NAME.FORMAT.csv, the keys, and NAME.FORMAT, the motion as BVH in parts. Of MMD's 30 frames a second there are
NAME.vmd.csv and NAME-30.bvh.csv.
"""

import csv
import math
import sys
from pathlib import Path

# Of the height: how far a joint may be off in the world.
FAR = 1e-4
# Keys within a koma of one another are one.
LEAST_F1 = 0.95
# Blender's GLB has metres; assimp keeps the numbers of the BVH.
SCALES = {"fbx": 1.0, "glb": 0.01, "assimp.fbx": 1.0, "assimp.glb": 1.0}
# Frames that are looked at, evenly over the clip.
LOOKS = 20


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def applied(turn, point):
    return [sum(turn[i][k] * point[k] for k in range(3)) for i in range(3)]


def turn_about(axis, degrees):
    sin, cos = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    matrix = [[float(row == column) for column in range(3)] for row in range(3)]
    matrix[i][i], matrix[i][j], matrix[j][i], matrix[j][j] = cos, -sin, sin, cos
    return matrix


def read(path):
    """Joints (name, parent, offset, channels) and rows of a BVH as genga writes it."""
    head, table = path.read_text().split("MOTION\n")
    joints, open_joints, is_tip = [], [], False
    for line in map(str.strip, head.splitlines()):
        word, _, rest = line.partition(" ")
        if word in ("ROOT", "JOINT"):
            joints.append([rest, open_joints[-1] if open_joints else None, None, []])
        elif word == "End":
            is_tip = True
        elif line == "{":
            open_joints.append(len(joints) - 1)
        elif line == "}":
            open_joints.pop()
            is_tip = False
        elif word == "OFFSET" and not is_tip:
            joints[-1][2] = [float(number) for number in rest.split()]
        elif word == "CHANNELS" and not is_tip:
            joints[-1][3] = rest.split()[1:]
    rows = [[float(number) for number in line.split()] for line in table.splitlines()[2:]]
    return joints, rows


def places(joints, row):
    """Where each joint is in the world."""
    values, stands, found = iter(row), [], {}
    for name, parent, offset, channels in joints:
        place, turn = list(offset), turn_about(0, 0.0)
        for channel in channels:
            axis, value = "XYZ".index(channel[0].upper()), next(values)
            if channel.endswith("position"):
                place[axis] = value
            else:
                turn = product(turn, turn_about(axis, value))
        if parent is not None:
            carrier, carried = stands[parent]
            place = [a + b for a, b in zip(carrier, applied(carried, place))]
            turn = product(carried, turn)
        stands.append((place, turn))
        found[name] = place
    return found


def whole(folder):
    """The parts of a motion put together again."""
    parts = [read(path) for path in sorted(folder.glob("*.bvh"))]
    return parts[0][0], [row for _, rows in parts for row in rows]


def keys(path):
    with path.open(newline="", encoding="utf-8") as table:
        return [int(row["koma_first"]) for row in csv.DictReader(table)]


def f1(found, asked):
    """Each key is met once at the most."""
    left, met = list(asked), 0
    for key in found:
        near = [other for other in left if abs(other - key) <= 1]
        if near:
            left.remove(min(near, key=lambda other: abs(other - key)))
            met += 1
    return 2 * met / (len(found) + len(asked))


def check(folder, name):
    joints, rows = whole(folder / f"{name}.bvh")
    looks = sorted({round(at * (len(rows) - 1) / (LOOKS - 1)) for at in range(LOOKS)})
    standing = [place[1] for place in places(joints, rows[0]).values()]
    height = max(standing) - min(standing)
    asked = keys(folder / f"{name}.bvh.csv")
    assert len(asked) >= 2, f"{name}: {len(asked)} keys"
    for ending, scale in SCALES.items():
        others, other_rows = whole(folder / f"{name}.{ending}")
        assert len(other_rows) == len(rows), f"{name}.{ending}: {len(other_rows)} frames, not {len(rows)}"
        names = {joint[0] for joint in joints}
        assert names == {joint[0] for joint in others}, f"{name}.{ending}: other joints"
        off = 0.0
        for look in looks:
            found = places(others, other_rows[look])
            for joint, place in places(joints, rows[look]).items():
                off = max(off, math.dist(place, [axis / scale for axis in found[joint]]) / height)
        score = f1(keys(folder / f"{name}.{ending}.csv"), asked)
        print(f"{name}.{ending}: {off:.1e} of the height off, F1 {score:.3f} of {len(asked)} keys")
        assert off <= FAR, f"{name}.{ending}: a joint is {off:.1e} of the height off"
        assert score >= LEAST_F1, f"{name}.{ending}: F1 of its keys is {score:.3f}"


def check_mmd(folder, name):
    asked, own = keys(folder / f"{name}-30.bvh.csv"), keys(folder / f"{name}.bvh.csv")
    found = keys(folder / f"{name}.vmd.csv")
    score = f1(found, asked)
    print(f"{name}.vmd: F1 {score:.3f} of {len(asked)} keys, {f1(found, own):.3f} beside the file's own frames")
    assert score >= LEAST_F1, f"{name}.vmd: F1 of its keys is {score:.3f}"


for name in sys.argv[2:]:
    check_mmd(Path(sys.argv[1]), name)
    check(Path(sys.argv[1]), name)
