"""What the add-on decides without Blender: bones, poses as a clip, corrections and settings."""

import importlib
import sys
import types
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import genga
import numpy as np

PLACE = Path(__file__).resolve().parents[2] / "addons" / "blender" / "genga"
package = types.ModuleType("genga_addon")
package.__path__ = [str(PLACE)]
sys.modules["genga_addon"] = package
motion, pins, refused, rig, run, settings = (
    importlib.import_module(f"genga_addon.{name}") for name in ("motion", "pins", "refused", "rig", "run", "settings")
)


def bone(name, parent, head, deforms=True, turn=None):
    rest = np.eye(4)
    rest[:3, :3] = np.eye(3) if turn is None else turn
    rest[:3, 3] = head
    return rig.Bone(name, parent, rest, 1.0, deforms)


def about_z(angle):
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])


class Bones(unittest.TestCase):
    CONTROLLED = [
        bone("root", -1, (0, 0, 0), False),
        bone("ORG-arm", 0, (1, 0, 0), False),
        bone("ORG-hand", 1, (2, 0, 0), False),
        bone("DEF-hand", 2, (2, 0, 0)),
        bone("DEF-arm", 0, (1, 0, 0)),
        bone("DEF-twist", 4, (1.5, 0, 0)),
    ]

    def names(self, deforming, leave_out=""):
        chosen = rig.choose(self.CONTROLLED, deforming, leave_out)
        return [(self.CONTROLLED[at].name, parent) for at, parent in zip(chosen.bones, chosen.parents)]

    def test_a_bone_hangs_on_what_lies_on_its_mechanism(self):
        self.assertEqual(self.names(True), [("DEF-arm", -1), ("DEF-hand", 0), ("DEF-twist", 0)])

    def test_all_bones_hang_as_they_do_in_the_rig(self):
        self.assertEqual([parent for _, parent in self.names(False)], [-1, 0, 1, 2, 0, 4])

    def test_patterns_leave_bones_out_whatever_their_case(self):
        self.assertEqual(self.names(True, "*TWIST*, nothing"), [("DEF-arm", -1), ("DEF-hand", 0)])
        with self.assertRaisesRegex(refused.Refused, "no bone is left"):
            self.names(True, "*")

    def test_a_rig_without_bones_that_deform_keeps_all(self):
        plain = [one._replace(deforms=False) for one in self.CONTROLLED]
        self.assertEqual(len(rig.choose(plain, True, "").bones), 6)


class Poses(unittest.TestCase):
    def test_every_rotation_comes_back(self):
        random = np.random.default_rng(7)
        wanted = random.normal(size=(500, 4))
        wanted[:4] = np.eye(4)
        wanted /= np.linalg.norm(wanted, axis=1, keepdims=True)
        x, y, z, w = wanted.T
        matrices = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        ).transpose(2, 0, 1)
        found = motion.quaternions(matrices)
        self.assertLess(np.abs(np.abs(np.sum(found * wanted, axis=1)) - 1).max(), 1e-12)

    def test_a_clip_stands_where_the_bones_stand(self):
        bones = [bone("a", -1, (0, 0, 0), turn=about_z(0.5)), bone("b", 0, (2, 0, 0), turn=about_z(1.0))]
        chosen = rig.choose(bones, True, "")
        poses = np.tile(np.eye(4), (30, 2, 1, 1))
        for frame in range(30):
            turn = about_z(0.1 * frame)
            poses[frame, 0, :3, :3] = 3.0 * turn @ about_z(0.5)
            poses[frame, 1, :3, :3] = 3.0 * turn @ about_z(1.0)
            poses[frame, 0, :3, 3] = (frame, 1, 0)
            poses[frame, 1, :3, 3] = poses[frame, 0, :3, 3] + turn @ (6, 0, 0)
        world = np.diag((3.0, 3.0, 3.0, 1.0))
        clip = motion.clip(bones, chosen, poses, world, 24.0, "take")
        self.assertLess(np.abs(clip.positions - poses[..., :3, 3]).max(), 1e-9)
        # As at rest is not turned: the second goes with the first.
        self.assertLess(np.abs(np.abs(clip.rotations[:, 1, 3]) - 1).max(), 1e-9)
        self.assertEqual(clip.to_bvh().count("Xposition"), 1)

    def test_what_is_no_pose_is_refused(self):
        flat = np.eye(3)[None, None].copy()
        flat[0, 0, :, 1] = 0.0
        with self.assertRaisesRegex(refused.Refused, "scaled to nothing"):
            motion.turns(flat)
        with self.assertRaisesRegex(refused.Refused, "no numbers"):
            motion.turns(flat * np.nan)


class Corrections(unittest.TestCase):
    def test_frames_of_blender_become_those_of_the_clip(self):
        self.assertEqual(pins.pins("12, 40:contact", 1), ["11", "39:contact"])
        self.assertEqual(pins.forbidden("50, 60..66", 10), ["40", "50..56"])
        for text in ("soon", "12 13", "1.5"):
            with self.subTest(text=text), self.assertRaisesRegex(refused.Refused, "40:contact"):
                pins.pins(text, 1)
        with self.assertRaisesRegex(refused.Refused, "50..60"):
            pins.forbidden("60..", 1)

    def test_marks_are_added_once_and_in_runs(self):
        self.assertEqual(pins.with_pins("40:contact", {40, 12}), "40:contact, 12")
        self.assertEqual(pins.with_forbidden("3", {3, 7, 8, 9, 12}), "3, 7..10, 12")
        self.assertEqual(pins.runs([]), [])


class Settings(unittest.TestCase):
    KNOBS = SimpleNamespace(
        rate=24.0, on="2", snap=np.float32(0.3).item(), naka_nashi=4.0, koma_dori=np.float32(100 / 3).item(),
        rest="", pins="", forbid="", only_pins=False, genga=0, drawings=0.0,
    )

    def recipe(self, marked=(), **turned):
        return settings.recipe(SimpleNamespace(**{**vars(self.KNOBS), **turned}), list(marked), 1)

    def test_knobs_that_nobody_turned_are_the_programs(self):
        self.assertEqual(self.recipe(), genga.Recipe())

    def test_knobs_set_what_they_say(self):
        found = self.recipe([31], on="1-3", snap=0.5, naka_nashi=12.5, rest="keys.min_price=8; filter.width=0.2s")
        wanted = genga.Recipe(spacing={"on": "1-3", "weight": 0.5}, omission={"naka_nashi": "12.5%"}, keys={"min_price": 8})
        wanted["filter.width"] = "0.2s"
        wanted.correct(pins=[30])
        self.assertEqual(found, wanted)
        with self.assertRaisesRegex(refused.Refused, "a setting is a name and a value"):
            self.recipe(rest="keys.min_price")

    def test_targets_are_asked_for_where_they_are_not_0(self):
        knobs = SimpleNamespace(genga=9, drawings=np.float32(6.1).item())
        self.assertEqual(settings.targets(knobs), {"keys": 9, "drawings_per_second": 6.1})
        self.assertEqual(set(settings.targets(self.KNOBS).values()), {None})


class Errors(unittest.TestCase):
    def test_an_add_on_without_its_wheel_says_so(self):
        with mock.patch.dict(sys.modules, {"genga": None}):
            with self.assertRaisesRegex(refused.Refused, "install the zip that addons/blender/build makes"):
                refused.engine()
            self.assertEqual(refused.kinds(), (refused.Refused, OSError))

    def test_what_is_no_persons_fault_stays_an_error(self):
        operator = type("Operator", (refused.Reported,), {"report": lambda self, *told: heard.append(told)})()
        heard = []

        def fails(error):
            raise error

        self.assertEqual(operator.reported(lambda: fails(refused.Refused("so"))), {"CANCELLED"})
        self.assertEqual(heard, [({"ERROR"}, "so")])
        with self.assertRaises(KeyError):
            operator.reported(lambda: fails(KeyError("a fault of ours")))


class Works(unittest.TestCase):
    def test_an_error_comes_out_where_the_result_is_asked_for(self):
        work = run.Work(lambda: 1 / 0)
        work.join()
        with self.assertRaises(ZeroDivisionError):
            work.result()
        work = run.Work(lambda: 7)
        work.join()
        self.assertEqual(work.result(), 7)


if __name__ == "__main__":
    unittest.main()
