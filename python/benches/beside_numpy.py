"""Times genga from arrays to result, a plain NumPy version of the first paper's six cells, and the program.

    python beside_numpy.py [CLIP.bvh [PROGRAM]]     Markdown on stdout

Runs in one process on one clip. After a warm-up round, each round runs every row once. Ratios are taken within a round;
their median is printed. First it checks that both versions find the same counts in the six cells.
"""

import os
import subprocess
import sys
import tempfile
import time

import numpy as np

import genga

ROUNDS = int(os.environ.get("ROUNDS", "15"))
WIDTHS, PERSISTENCES = (10, 20, 30), (5, 10)
# The dead band that the paper's counts imply, in radians per second squared; and the tolerance for rounding.
BAND, DUST = np.radians(300.0), 1e-9


def speeds(rotations, rate):
    """Computes how fast each joint turns: the angle of q₁⁻¹q₂. The first row equals the second."""
    a, b = rotations[:-1], rotations[1:]
    w = np.sum(a * b, axis=-1)
    xyz = a[..., 3:] * b[..., :3] - b[..., 3:] * a[..., :3] - np.cross(a[..., :3], b[..., :3])
    steps = 2.0 * np.arctan2(np.linalg.norm(xyz, axis=-1), np.abs(w)) * rate
    return np.concatenate([steps[:1], steps])


def smoothed(signal, width):
    """Computes a moving average of even width, with mirrored ends and half weights at both edges."""
    half = width // 2
    padded = np.pad(signal, ((half + 1, half), (0, 0)), mode="symmetric")
    sums = np.cumsum(padded, axis=0)
    box = sums[width:] - sums[:-width]
    return (box[:-1] + box[1:]) / (2 * width)


def keys(filtered, rate, persistence):
    """Finds frames with the sign pattern of a key, after which all M frames are faster."""
    floor = DUST * np.abs(filtered).max()
    change = np.diff(filtered, axis=0)
    band = max(BAND / rate, floor)
    sign = (change > band).astype(np.int8) - (change < -band)
    before, after = sign[:-1], sign[1:]
    found = np.zeros(filtered.shape, bool)
    found[1:-1] = ((before < 0) & (after >= 0)) | ((before == 0) & (after > 0))
    found[len(filtered) - persistence :] = False
    for step in range(1, persistence + 1):
        found[:-step] &= filtered[step:] > filtered[:-step] + floor
    return found


def six_cells(rotations, rate):
    """Counts distinct key frames, and keys summed over the joints, for each width and persistence."""
    speed, cells = speeds(rotations, rate), []
    for width in WIDTHS:
        filtered = smoothed(speed, width)
        for persistence in PERSISTENCES:
            found = keys(filtered, rate, persistence)
            cells.append((int(found.any(axis=1).sum()), int(found.sum())))
    return cells


def main():
    path = sys.argv[1] if len(sys.argv) > 1 else "../shared/data/bvh/cmu-02_05-punch-strike.bvh"
    read = genga.read(path)
    rotations, rate = np.array(read.rotations), read.rate
    arrays = dict(names=read.names, parents=read.parents, offsets=read.offsets, rotations=rotations)
    arrays.update(root=np.array(read.positions[:, 0]), rate=rate)

    counts = ["union", "total"]
    table = genga.study(genga.Clip(**arrays), measures=counts)
    wanted = list(zip(table["union"].astype(int).tolist(), table["total"].astype(int).tolist()))
    found = six_cells(rotations, rate)
    if found != wanted:
        sys.exit(f"the counts differ: NumPy has {found}, genga {wanted}")

    rows = {
        "NumPy, arrays → six cells": lambda: six_cells(rotations, rate),
        "genga in Python, arrays → six cells": lambda: genga.study(genga.Clip(**arrays), measures=counts),
        "genga in Python, arrays → sheet": lambda: genga.run(genga.Clip(**arrays)).sheet,
        "genga in Python, file → sheet": lambda: genga.run(genga.read(path)).sheet,
    }
    if len(sys.argv) > 2:
        out = tempfile.mkdtemp()
        command = [sys.argv[2], "run", path, "--quiet", "--out", out]
        rows["the program, file → folder"] = lambda: subprocess.run(command, check=True)

    taken = {name: [] for name in rows}
    for round_ in range(ROUNDS + 1):
        for name, work in rows.items():
            began = time.perf_counter()
            work()
            if round_ > 0:
                taken[name].append(time.perf_counter() - began)
    first = np.array(next(iter(taken.values())))
    print(f"{os.path.basename(path)}, {len(read)} frames, {len(read.names)} joints; wall ms, median of {ROUNDS} rounds (best).\n")
    print("| what | ms | NumPy's six cells take |\n| --- | ---: | ---: |")
    for name, seconds in taken.items():
        ratio = np.median(first / np.array(seconds))
        print(f"| {name} | {1e3 * np.median(seconds):.2f} ({1e3 * min(seconds):.2f}) | {ratio:.2f} times |")


if __name__ == "__main__":
    main()
