"""The keys of joints in Maya against a stand-in for maya.cmds. It needs NumPy and the wheel: python/check runs it."""

import builtins
import random
import sys
import types
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path[:0] = [str(HERE), str(ROOT / "addons" / "maya")]

import genga  # noqa: E402
import genga_keys  # noqa: E402
import genga_sheet  # noqa: E402
import numpy as np  # noqa: E402
from stand_in import Cmds  # noqa: E402

FRAMES = 60


def turned(rotation, vector):
    return np.array(genga_sheet.rotated(tuple(rotation), list(vector)))


class Arrays(unittest.TestCase):
    def test_positions_come_back_from_the_arrays(self):
        cmds, chance = Cmds("film"), random.Random(3)
        cmds.add("|group", order=3, rotateY=30.0, translateX=5.0)
        paths = ["|group|hips", "|group|hips|spine", "|group|hips|null|leg", "|group|hips|null|leg|foot"]
        cmds.add("|group|hips|null", parent="|group|hips", rotateX=20.0, translateY=-3.0)
        for at, path in enumerate(paths):
            parent = path.rpartition("|")[0]
            cmds.add(path, parent=parent, order=at, kind="joint", translateX=1.0 + at, translateZ=0.5)
            for axis in "XYZ":
                cmds.animate(f"{path}.rotate{axis}", [(time, chance.uniform(-170, 170)) for time in range(4)])
        worlds = [[cmds.getAttr(f"{path}.worldMatrix[0]", time=time) for path in paths] for time in range(4)]
        made = genga_keys.arrays(paths, worlds)
        self.assertEqual(made["names"], ["hips", "spine", "leg", "foot"])
        self.assertEqual(made["parents"], [-1, 0, 0, 2])
        for frame, matrices in enumerate(worlds):
            whole, places = [], []
            for joint, parent in enumerate(made["parents"]):
                own = tuple(made["rotations"][frame, joint])
                whole.append(own if parent < 0 else genga_sheet.product(whole[parent], own))
                hung = made["root"][frame] if parent < 0 else places[parent] + turned(whole[parent], made["offsets"][joint])
                places.append(hung)
                np.testing.assert_allclose(hung, matrices[joint][12:15], atol=1e-9)
                # A row of the matrix is where that axis points.
                for axis in range(3):
                    unit = np.eye(3)[axis]
                    np.testing.assert_allclose(turned(whole[joint], unit), matrices[joint][4 * axis : 4 * axis + 3], atol=1e-9)

    def test_scale_and_mirrors_are_no_rotation(self):
        plain = np.eye(4)
        for scale in ([2.0, 2.0, 2.0], [-1.0, -1.0, -1.0]):
            matrix = np.diag([*scale, 1.0])
            made = genga_keys.arrays(["|a"], [[matrix.ravel()]])
            same = genga_keys.arrays(["|a"], [[plain.ravel()]])
            np.testing.assert_allclose(np.abs(made["rotations"]), np.abs(same["rotations"]), atol=1e-12)

    def test_names_that_come_twice_are_told_apart(self):
        made = genga_keys.arrays(["|r", "|r|a|tip", "|r|b|tip"], [[np.eye(4).ravel()] * 3])
        self.assertEqual(made["names"], ["r", "r|a|tip", "r|b|tip"])


class Found(unittest.TestCase):
    def setUp(self):
        self.clip = genga.read(ROOT / "data" / "kick.bvh", trim=(0, FRAMES))
        self.cmds = Cmds("film")
        self.cmds.ranges = {"minTime": 1.0, "maxTime": float(FRAMES)}
        self.paths = []
        for joint, (name, parent) in enumerate(zip(self.clip.names, self.clip.parents)):
            above = self.paths[parent] if parent >= 0 else ""
            path = f"{above}|{name}"
            self.paths.append(path)
            offset = dict(zip(("translateX", "translateY", "translateZ"), self.clip.offsets[joint]))
            self.cmds.add(path, parent=above or None, kind="joint", **offset)
            near = [0.0, 0.0, 0.0]
            poses = []
            for rotation in self.clip.rotations[:, joint]:
                near = genga_sheet.angles_of(tuple(rotation), "xyz", near)
                poses.append(near)
            self.animate(path, "rotate", poses)
        self.animate(self.paths[0], "translate", self.clip.positions[:, 0])
        self.cmds.selected = [self.paths[0]]
        maya = types.ModuleType("maya")
        maya.cmds = self.cmds
        sys.modules["maya"] = maya

    def tearDown(self):
        del sys.modules["maya"]

    def animate(self, path, what, values):
        for axis, name in enumerate("XYZ"):
            self.cmds.animate(f"{path}.{what}{name}", [(1 + at, value[axis]) for at, value in enumerate(values)])

    def test_the_keys_are_those_of_the_same_motion_as_arrays(self):
        clip = self.clip
        arrays = dict(names=clip.names, parents=clip.parents, offsets=clip.offsets, rotations=clip.rotations)
        wanted = genga.run(genga.Clip(**arrays, root=clip.positions[:, 0], rate=24.0), spacing={"on": 3})
        found = genga_keys.find_keys(spacing={"on": 3})
        self.assertEqual(found.keys["frame"].tolist(), wanted.keys["frame"].tolist())
        begins = (1 + wanted.sheet.exposures["begin"]).tolist()
        keys = self.cmds.keys[f"{self.paths[0]}.translateY"]
        self.assertEqual([time for time, _, _ in keys], begins)
        self.assertEqual({tangent for _, _, tangent in keys}, {"step"})
        places = wanted.sheet.drawings["place"][wanted.sheet.exposures["drawing"]]
        for (_, value, _), place in zip(keys, places):
            if place == int(place):
                self.assertAlmostEqual(value, clip.positions[int(place), 0, 1], 6)
        self.assertEqual(self.cmds.chunks, ["open", "close"])

    def test_what_is_missing_is_said(self):
        self.cmds.selected = []
        with self.assertRaisesRegex(RuntimeError, "no joint is selected"):
            genga_keys.find_keys()
        self.cmds.add("|other", kind="joint")
        with self.assertRaisesRegex(RuntimeError, "is not below"):
            genga_keys.find_keys(nodes=[self.paths[0], "|other"])
        own = builtins.__import__

        def without(name, *rest):
            if name == "genga":
                raise ImportError(name)
            return own(name, *rest)

        builtins.__import__ = without
        try:
            with self.assertRaisesRegex(RuntimeError, "genga is not installed"):
                genga_keys.find_keys()
        finally:
            builtins.__import__ = own
        self.assertEqual(self.cmds.chunks, [])


if __name__ == "__main__":
    unittest.main()
