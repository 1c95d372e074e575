"""Writes the keys of a take as JSON, from any FBX reader: python keys_of_fbx.py TAKE.npz KEYS.json.

Every reader has world matrices: EvaluateGlobalTransform in the FBX SDK, GetMatrix in MotionBuilder, node_to_world in
ufbx. Save them with numpy.savez: names (J), parents (J; -1 for the root, parents first), matrices (F, J, 4, 4; for
column vectors), rate.
"""

import json
import sys

import numpy as np

import genga


def quaternions(m):
    """Converts rotation matrices (…, 3, 3) to quaternions x, y, z, w by Bar-Itzhack's eigenvector."""
    k = np.empty((*m.shape[:-2], 4, 4))
    for a, b, c in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        k[..., a, a] = m[..., a, a] - m[..., b, b] - m[..., c, c]
        k[..., a, b] = k[..., b, a] = m[..., a, b] + m[..., b, a]
        k[..., a, 3] = k[..., 3, a] = m[..., c, b] - m[..., b, c]
    k[..., 3, 3] = np.trace(m, axis1=-2, axis2=-1)
    return np.linalg.eigh(k)[1][..., -1]


take = np.load(sys.argv[1])
parents, places, axes = take["parents"], take["matrices"][..., :3, 3], take["matrices"][..., :3, :3]
world = axes / np.linalg.norm(axes, axis=-2, keepdims=True)  # removes scale
local, offsets = world.copy(), np.zeros((len(parents), 3))
for joint, parent in enumerate(parents):
    if parent >= 0:
        local[:, joint] = np.swapaxes(world[:, parent], -1, -2) @ world[:, joint]
        offsets[joint] = (places[0, joint] - places[0, parent]) @ world[0, parent]

arrays = dict(names=take["names"].tolist(), parents=parents.tolist(), offsets=offsets, rotations=quaternions(local))
keys = genga.run(genga.Clip(**arrays, root=places[:, 0], rate=float(take["rate"]))).keys
keys["price"] = np.where(np.isfinite(keys["price"]), keys["price"], None)  # JSON has no infinity
rows = [dict(zip(keys, row)) for row in zip(*(column.tolist() for column in keys.values()))]
with open(sys.argv[2], "w", encoding="utf-8") as file:
    json.dump({"rate": float(take["rate"]), "keys": rows}, file, indent=1)
