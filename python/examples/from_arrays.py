"""Builds a clip from arrays, as SMPL, FBX or a game engine provides them: python from_arrays.py."""

import numpy as np

import genga

FRAMES, RATE = 120, 60.0
names = ["Hips", "Spine", "Head", "UpperArm", "ForeArm"]
parents = [-1, 0, 1, 1, 3]
offsets = np.array([[0, 0, 0], [0, 40, 0], [0, 30, 0], [20, 25, 0], [30, 0, 0]], float)

# An arm waves about Z, and its forearm follows late. Quaternions are x, y, z, w.
rotations = np.zeros((FRAMES, len(names), 4))
rotations[..., 3] = 1.0
time = np.arange(FRAMES) / RATE
for joint, delay in ((3, 0.0), (4, 0.13)):
    half = 0.5 * np.radians(60.0) * np.sin(2 * np.pi * np.maximum(time - delay, 0.0))
    rotations[:, joint, 2], rotations[:, joint, 3] = np.sin(half), np.cos(half)
root = np.tile([0.0, 90.0, 0.0], (FRAMES, 1))

clip = genga.Clip(names=names, parents=parents, offsets=offsets, rotations=rotations, root=root, rate=RATE)
result = genga.run(clip)
for frame, reason, joints in zip(*(result.keys[name] for name in ("frame", "reason", "joints"))):
    print(frame, reason, joints)
