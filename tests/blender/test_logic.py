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
DATA = Path(__file__).resolve().parents[2] / "data"
package = types.ModuleType("genga_addon")
package.__path__ = [str(PLACE)]
sys.modules["genga_addon"] = package
feet, fit, motion, pins, refused, rig, run, settings = (
    importlib.import_module(f"genga_addon.{name}") for name in ("feet", "fit", "motion", "pins", "refused", "rig", "run", "settings")
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
        wanted = [("root", -1), ("ORG-arm", 0), ("ORG-hand", 1), ("DEF-hand", 2), ("DEF-twist", 1)]
        self.assertEqual(self.names(False), wanted, "DEF-arm is a copy of ORG-arm")

    def test_patterns_leave_bones_out_whatever_their_case(self):
        self.assertEqual(self.names(True, "*TWIST*, nothing"), [("DEF-arm", -1), ("DEF-hand", 0)])
        with self.assertRaisesRegex(refused.Refused, "no bone is left"):
            self.names(True, "*")

    def test_a_bone_that_is_ticked_is_left_out_and_the_others_close_up(self):
        ticked = [one._replace(is_left_out=one.name == "DEF-arm") for one in self.CONTROLLED]
        chosen = rig.choose(ticked, True, "")
        self.assertEqual([ticked[at].name for at in chosen.bones], ["DEF-hand", "DEF-twist"])
        self.assertEqual(chosen.parents, [-1, -1])

    def test_a_bone_that_lies_on_another_of_another_chain_is_its_copy(self):
        legs = [
            bone("centre", -1, (0, 0, 0)),
            bone("spine", 0, (0, 0, 0)),
            bone("leg", 0, (1, 0, 0)),
            bone("knee", 2, (1, -1, 0)),
            bone("legD", 0, (1, 0, 0)),
            bone("kneeD", 4, (1, -1, 0)),
            bone("toe", 5, (1, -2, 0)),
        ]
        chosen = rig.choose(legs, True, "")
        told = [(legs[at].name, parent) for at, parent in zip(chosen.bones, chosen.parents)]
        self.assertEqual(told, [("centre", -1), ("spine", 0), ("leg", 0), ("knee", 2), ("toe", 3)])

    def test_a_rig_without_bones_that_deform_keeps_all(self):
        plain = [one._replace(deforms=False) for one in self.CONTROLLED]
        self.assertEqual(rig.choose(plain, True, ""), rig.choose(plain, False, ""))
        self.assertEqual(len(rig.choose(plain, True, "").bones), 5)


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
        clip = motion.clip(bones, chosen, poses, world @ np.stack([one.rest for one in bones]), 24.0, "take")
        self.assertLess(np.abs(clip.positions - poses[..., :3, 3]).max(), 1e-9)
        # As at rest is not turned: the second goes with the first.
        self.assertLess(np.abs(np.abs(clip.rotations[:, 1, 3]) - 1).max(), 1e-9)
        self.assertEqual(clip.to_bvh().count("Xposition"), 1)

    def test_what_is_no_pose_is_refused(self):
        flat = np.eye(3)[None, None].copy()
        flat[0, 0, :, 1] = 0.0
        with self.assertRaisesRegex(refused.Refused, "scaled to zero"):
            motion.turns(flat)
        with self.assertRaisesRegex(refused.Refused, "no numbers"):
            motion.turns(flat * np.nan)


class Feet(unittest.TestCase):
    def test_a_turned_leg_stands_as_on_the_sheet(self):
        """Forward kinematics of a rig whose bones have axes of their own, turned as it is said, are those of the sheet."""
        clip = genga.read(DATA / "kick.bvh")
        free, held = (genga.run(clip, feet=how).limited for how in ("free", "held"))
        random = np.random.default_rng(3)
        rest = np.tile(np.eye(4), (len(clip.names), 1, 1))
        rest[:, :3, :3] = 2.5 * feet.matrices(unit(random.normal(size=(len(clip.names), 4))))
        rest[5, :3, 0] *= -1.0
        turns = feet.turns(held, free, rest)
        self.assertEqual(set(turns), {f"{side}{name}" for side in ("Left", "Right") for name in ("UpLeg", "Leg", "Foot")})
        axes, wanted = rest[:, :3, :3] / 2.5, world(clip.parents, feet.matrices(held.rotations))
        drawn = world(clip.parents, feet.matrices(free.rotations))
        self.assertGreater(np.abs(drawn - wanted).max(), 1e-2)
        # As Blender has it: where a bone hangs at rest, and what turns it in its own axes.
        above = [axes[parent] if parent >= 0 else np.eye(3) for parent in clip.parents]
        hang = [np.linalg.inv(one) @ own for one, own in zip(above, axes)]
        posed = drawn @ axes
        for at, (name, parent) in enumerate(zip(clip.names, clip.parents)):
            over = (drawn[:, parent] @ axes[parent] if parent >= 0 else np.eye(3)) @ hang[at]
            own = np.linalg.inv(over) @ drawn[:, at] @ axes[at] @ turns.get(name, np.eye(3))
            posed[:, at] = (posed[:, parent] if parent >= 0 else np.eye(3)) @ hang[at] @ own
        self.assertLess(np.abs(posed @ np.linalg.inv(axes) - wanted).max(), 1e-12)

    def test_feet_are_held_where_a_drawing_is_a_pose_of_the_take(self):
        clip = genga.read(DATA / "kick.bvh")
        rest = np.tile(np.eye(4), (len(clip.names), 1, 1))

        def turned(**settings):
            finding = run.Finding(SimpleNamespace(clip=clip, rest=rest, start=1))
            finding.find(genga.Recipe(**settings), {})
            sheet = finding.sheet()
            return finding.turns(sheet), fit.left_out(sheet, holds=True)

        turns, told = turned(feet="held")
        self.assertEqual((len(turns), told), (6, []))
        self.assertEqual(turned(), ({}, []))
        for more in ({"root": "ones"}, {"layers": "limbs"}, {"exaggerate": {"ease": 0.5}}):
            turns, told = turned(feet="held", **more)
            self.assertEqual((turns, "holds the feet" in " ".join(told)), ({}, True), more)


def unit(rotations):
    return rotations / np.linalg.norm(rotations, axis=-1, keepdims=True)


def world(parents, local):
    """Rotations in the world, of those against their parents."""
    made = local.copy()
    for at, parent in enumerate(parents):
        if parent >= 0:
            made[:, at] = made[:, parent] @ local[:, at]
    return made


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
        rate=24.0, on="2-3", snap=np.float32(0.3).item(), naka_nashi=4.0, koma_dori=np.float32(100 / 3).item(),
        feet=False, rest="", pins="", forbid="", only_pins=False, genga=0, drawings=0.0,
    )

    def recipe(self, marked=(), **turned):
        return settings.recipe(SimpleNamespace(**{**vars(self.KNOBS), **turned}), list(marked), 1)

    def test_knobs_that_nobody_turned_are_the_programs(self):
        self.assertEqual(self.recipe(), genga.Recipe())

    def test_knobs_set_what_they_say(self):
        found = self.recipe([31], on="1-3", snap=0.5, naka_nashi=12.5, feet=True, rest="keys.min_price=8; filter.width=0.2s")
        wanted = genga.Recipe(spacing={"on": "1-3", "weight": 0.5}, omission={"naka_nashi": "12.5%"}, keys={"min_price": 8})
        wanted["filter.width"], wanted["feet"] = "0.2s", "held"
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
