"""The Maya script against a stand-in for maya.cmds."""

import copy
import json
import math
import random
import sys
import tempfile
import types
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[2] / "addons" / "maya")]

import genga_sheet  # noqa: E402
from stand_in import Cmds  # noqa: E402


def drawing(number, role="inbetween", **source):
    return {"drawing": number, "role": role, **source}


SHEET = {
    "schema": "genga-sheet-2",
    "genga": "0.1.0",
    "cut": "test",
    "fps": 24,
    "frame_base": 0,
    "clip": {"file": "test.bvh", "frame_rate": 120, "first_frame": 0, "frames": 101, "joints": ["hips"]},
    "layers": [
        {
            "name": "A",
            "drawings": [
                drawing(1, "end", frame=0),
                drawing(2, frame=12.5),
                drawing(3, "genga", frame=50),
                drawing(4, between=[50, 100], share=0.25),
                drawing(5, "end", frame=100),
            ],
            "exposures": [{"drawing": at, "koma": koma} for at, koma in enumerate([3, 2, 10, 4, 2], 1)],
        },
        {"name": "B", "drawings": [drawing(1, frame=7)], "exposures": [{"drawing": 1, "koma": 5}]},
    ],
}
BEGINS = [1, 4, 6, 16, 20]


class Applied(unittest.TestCase):
    def setUp(self):
        self.cmds = Cmds("120fps")
        self.cmds.add("|hips", order=2)
        self.cmds.add("|hips|knee", parent="|hips")
        self.cmds.add("|hips|knee|still", parent="|hips|knee")
        self.cmds.animate("|hips.translateY", [(0, 0.0), (100, 100.0)])
        self.cmds.animate("|hips|knee.rotateX", [(0, 0.0), (100, 200.0)])
        self.cmds.selected = ["|hips"]
        maya = types.ModuleType("maya")
        maya.cmds = self.cmds
        sys.modules["maya"] = maya

    def tearDown(self):
        del sys.modules["maya"]

    def apply(self, sheet=SHEET, **options):
        with tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as file:
            json.dump(sheet, file)
            file.flush()
            return genga_sheet.apply(file.name, **options)

    def test_keys_are_stepped_and_stand_on_the_sheets_koma(self):
        self.assertEqual(self.apply(), 5)
        keys = self.cmds.keys["|hips.translateY"]
        self.assertEqual([time for time, _, _ in keys], BEGINS)
        self.assertEqual({tangent for _, _, tangent in keys}, {"step"})
        values = [value for _, value, _ in keys]
        for found, wanted in zip(values, [0.0, 12.5, 50.0, 62.5, 100.0]):
            self.assertAlmostEqual(found, wanted)

    def test_every_frame_shows_the_sheets_drawing_and_none_between(self):
        self.apply()
        shown = [e["drawing"] for e in SHEET["layers"][0]["exposures"] for _ in range(e["koma"])]
        places = [0.0, 12.5, 50.0, 62.5, 100.0]
        for koma, number in enumerate(shown):
            for part in (0.0, 0.5, 0.99):
                value = self.cmds.getAttr("|hips.translateY", time=1 + koma + part)
                self.assertAlmostEqual(value, places[number - 1])

    def test_a_sheet_of_the_first_version_counts_drawings_from_0(self):
        old = copy.deepcopy(SHEET)
        old["schema"] = "genga-sheet-1"
        for layer in old["layers"]:
            for numbered in layer["drawings"] + layer["exposures"]:
                numbered["drawing"] -= 1
        self.apply(old)
        keys = self.cmds.keys
        self.setUp()
        self.apply()
        self.assertEqual(self.cmds.keys, keys)

    def test_a_root_on_ones_is_left_out_and_said(self):
        self.apply()
        self.assertEqual(self.cmds.warnings, [])
        self.setUp()
        self.apply({**SHEET, "root": "ones"})
        self.assertIn("the sheet has the root on ones", self.cmds.warnings[0])

    def test_rotations_go_on_the_shortest_arc_and_get_all_three_axes(self):
        self.apply()
        keys = {axis: self.cmds.keys[f"|hips|knee.rotate{axis}"] for axis in "XYZ"}
        self.assertEqual({len(of_axis) for of_axis in keys.values()}, {5})
        angles = [value for _, value, _ in keys["X"]]
        for found, wanted in zip(angles, [0.0, 25.0, 100.0, 125.0, 200.0]):
            self.assertAlmostEqual(found, wanted)

    def test_what_has_no_keys_gets_none(self):
        self.apply()
        self.assertFalse([name for name in self.cmds.keys if "still" in name])
        self.assertNotIn("|hips.translateX", self.cmds.keys)

    def test_the_scene_gets_the_sheets_rate_and_range_in_one_step_of_undo(self):
        self.apply(start=101)
        self.assertEqual(self.cmds.unit, "film")
        wanted = {"minTime": 101, "animationStartTime": 101, "maxTime": 121, "animationEndTime": 121}
        self.assertEqual(self.cmds.ranges, wanted)
        self.assertEqual(self.cmds.chunks, ["open", "close"])

    def test_the_take_may_begin_elsewhere_and_play_at_another_rate(self):
        self.cmds.unit = "film"
        self.cmds.animate("|hips.translateY", [(10, 0.0), (30, 100.0)])
        self.apply(first_frame=10)
        values = [value for _, value, _ in self.cmds.keys["|hips.translateY"]]
        # Frame 12.5 of the source lies between two of them, here each a fifth of a frame of the scene.
        for found, wanted in zip(values, [0.0, 12.5, 50.0, 62.5, 100.0]):
            self.assertAlmostEqual(found, wanted)

    def test_a_layer_is_taken_by_its_name(self):
        self.assertEqual(self.apply(layer="B"), 1)
        with self.assertRaisesRegex(ValueError, "no layer C; the sheet has"):
            self.apply(layer="C")

    def test_every_unit_of_time_has_a_rate(self):
        for unit, rate in [
            ("film", 24), ("120fps", 120), ("23.976fps", 23.976), ("29.97df", 29.97), ("sec", 1), ("min", 1 / 60),
            ("hour", 1 / 3600), ("millisec", 1000),
        ]:
            self.cmds.unit = unit
            self.assertAlmostEqual(genga_sheet.scene_rate(self.cmds), rate, msg=unit)
        self.cmds.unit = "fortnight"
        with self.assertRaisesRegex(RuntimeError, "time unit fortnight"):
            self.apply()

    def test_what_is_wrong_is_said_and_nothing_is_changed(self):
        before = dict(self.cmds.keys)
        empty = copy.deepcopy(SHEET)
        empty["layers"][0]["exposures"] = []
        with self.assertRaisesRegex(ValueError, "layer A has no drawing"):
            self.apply(empty)
        with self.assertRaisesRegex(ValueError, "no layer"):
            self.apply({**SHEET, "layers": []})
        with self.assertRaisesRegex(ValueError, "not a genga timesheet"):
            self.apply({"schema": "other"})
        self.cmds.selected = []
        with self.assertRaisesRegex(RuntimeError, "nothing is selected"):
            self.apply()
        with self.assertRaisesRegex(RuntimeError, "have keys"):
            self.apply(nodes=["|hips|knee|still"])
        self.assertEqual(self.cmds.chunks, ["open", "close"], "closed when it fails, too")
        self.assertEqual(self.cmds.keys, before)


def matrix(angles, order):
    """The rotation by matrices, a way of its own: the first axis of the order turns first."""
    turned = [[float(row == column) for column in range(3)] for row in range(3)]
    for axis in order:
        at = "xyz".index(axis)
        sin, cos = math.sin(math.radians(angles[at])), math.cos(math.radians(angles[at]))
        turn = [[float(row == column) for column in range(3)] for row in range(3)]
        a, b = (at + 1) % 3, (at + 2) % 3
        turn[a][a], turn[a][b], turn[b][a], turn[b][b] = cos, -sin, sin, cos
        turned = [[sum(turn[r][k] * turned[k][c] for k in range(3)) for c in range(3)] for r in range(3)]
    return turned


class Rotations(unittest.TestCase):
    def assert_same(self, a, b, places=9):
        for row_a, row_b in zip(a, b):
            for value_a, value_b in zip(row_a, row_b):
                self.assertAlmostEqual(value_a, value_b, places)

    def test_angles_come_back_in_every_order(self):
        chance = random.Random(1)
        for order in genga_sheet.ROTATE_ORDERS:
            for _ in range(200):
                angles = [chance.uniform(-400, 400) for _ in range(3)]
                near = [chance.uniform(-400, 400) for _ in range(3)]
                turned = genga_sheet.quaternion(angles, order)
                columns = [genga_sheet.rotated(turned, [float(k == at) for k in range(3)]) for at in range(3)]
                self.assert_same(zip(*columns), matrix(angles, order))
                again = genga_sheet.angles_of(turned, order, near)
                self.assert_same(matrix(again, order), matrix(angles, order), 6)
                kept = genga_sheet.angles_of(turned, order, angles)
                for found, wanted in zip(kept, angles):
                    self.assertAlmostEqual(found, wanted, 4)

    def test_a_locked_gimbal_still_gives_the_rotation(self):
        chance = random.Random(2)
        for order in genga_sheet.ROTATE_ORDERS:
            for middle in (90.0, -90.0):
                angles = [chance.uniform(-180, 180) for _ in range(3)]
                angles["xyz".index(order[1])] = middle
                turned = genga_sheet.quaternion(angles, order)
                again = genga_sheet.angles_of(turned, order, [10.0, 20.0, 30.0])
                self.assert_same(matrix(again, order), matrix(angles, order), 5)

    def test_slerp_takes_the_short_way_at_one_speed(self):
        turn = lambda degrees: genga_sheet.quaternion([degrees, 0.0, 0.0], "xyz")
        for start, end, share, wanted in [(-170, 170, 0.25, -175), (10, -10, 0.5, 0), (0, 90, 0.1, 9), (5, 5, 0.3, 5)]:
            found = genga_sheet.slerp(turn(start), turn(end), share)
            self.assertAlmostEqual(abs(sum(a * b for a, b in zip(found, turn(wanted)))), 1.0)


if __name__ == "__main__":
    unittest.main()
