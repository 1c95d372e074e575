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
feet, files, fit, motion, pins, refused, rig, run, settings = (
    importlib.import_module(f"genga_addon.{name}") for name in ("feet", "files", "fit", "motion", "pins", "refused", "rig", "run", "settings")
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
            finding.asked = genga.Recipe(**settings), {}
            finding.find()
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
    def test_markers_are_read_in_the_programs_notation(self):
        marks = [("pin contact", 40), ("Pin", 12), ("forbid", 50), ("forbid to", 66), ("forbid from", 60), ("3 Armature", 7), ("note", 8)]
        read = pins.read(marks)
        self.assertEqual(read.of_clip(1), (["11", "39:contact"], ["49..50", "59..66"]))
        self.assertEqual(read.with_pins([40, 41]).of_clip(0)[0], ["12", "40:contact", "41"])
        self.assertEqual(pins.read([("固定", 3), ("禁止 から", 5), ("禁止 まで", 8)]), ((((3, ""),)), ((5, 9),)))
        named = pins.owned("pin contact", "A [1]")
        self.assertEqual((named, pins.owner(named), pins.plain(named)), ("pin contact [A (1)]", "A (1)", "pin contact"))
        self.assertEqual((pins.owned(named, "B"), pins.owner("pin"), pins.plain("forbid from")), ("pin contact [B]", "", "forbid from"))
        self.assertEqual([pins.is_mark(name) for name in ("pin", "FORBID from", "pinned", "", "禁止")], [True, True, False, False, True])

    def test_what_a_marker_does_not_say_is_refused_in_words(self):
        for marks, words in (
            ([("forbid twice", 5)], "“forbid twice” on frame 5 is not understood: name it forbid"),
            ([("forbid to", 5)], "on frame 5 has no “forbid from” in front of it"),
            ([("forbid from", 5)], "on frame 5 has no “forbid to” behind it"),
            ([("forbid from", 5), ("forbid from", 8)], "on frame 8 follows another one on frame 5"),
        ):
            with self.subTest(marks=marks), self.assertRaisesRegex(refused.Refused, words):
                pins.read(marks)

    def test_frames_are_forbidden_one_by_one_or_in_runs(self):
        self.assertEqual(pins.forbidding([9, 3, 7, 8, 8]), [("forbid", 3), ("forbid from", 7), ("forbid to", 9)])
        self.assertEqual(pins.read(pins.forbidding([3, 7, 8, 9])).forbidden, ((3, 4), (7, 10)))
        self.assertEqual(pins.runs([]), [])


class Rounds(unittest.TestCase):
    def test_going_back_is_going_on_in_the_next_round(self):
        def rounds(begin, frames, *places):
            drawings = [{"drawing": at, "role": "genga", "frame": place} for at, place in enumerate(places)]
            exposures = [{"drawing": at, "koma": 2} for at in range(len(places))]
            layer = files.Layer({"name": "A", "drawings": drawings, "exposures": exposures})
            layer.unwind(begin, frames)
            return [exposure.round for exposure in layer.exposures]

        self.assertEqual(rounds(16, 87, 16, 40, 80, 3, 16, 40), [0, 0, 0, 1, 1, 1])
        self.assertEqual(rounds(1, 87, 86, 20, 86, 20), [-1, 0, 0, 1], "a drawing held over from the round before")
        self.assertEqual(rounds(5, 87, 5, 5, 5), [0, 1, 2], "the only drawing of a round")


class Settings(unittest.TestCase):
    KNOBS = SimpleNamespace(
        rate=24.0, on="2-3", snap=np.float32(0.3).item(), naka_nashi=4.0, koma_dori=np.float32(100 / 3).item(),
        feet=False, rest="", only_pins=False, genga=0, drawings=0.0, loop=False, cycles=1, passages=(), outside="TIMED",
    )

    def recipe(self, marked=(), **turned):
        corrections = pins.Corrections((), ()).with_pins(marked)
        return settings.recipe(SimpleNamespace(**{**vars(self.KNOBS), **turned}), corrections, 1)

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

    def test_a_passage_has_settings_of_its_own_in_frames_of_the_clip(self):
        own = SimpleNamespace(**{**vars(self.KNOBS), "start": 31, "end": 60, "on": "1", "rest": "spacing.drift=0"})
        wanted = genga.Recipe()
        of_passage = {"spacing.on": 1, "spacing.weight": 0.3, "spacing.drift": 0, "omission.naka_nashi": "4%", "omission.koma_dori": "1/3"}
        wanted["passages"], wanted["outside"] = [{"frames": [30, 60], **of_passage}], "source"
        self.assertEqual(self.recipe(passages=[own], outside="SOURCE"), wanted)
        with self.assertRaisesRegex(refused.Refused, "has no frame of the take, which begins on 1"):
            self.recipe(passages=[SimpleNamespace(**{**vars(own), "start": -9, "end": 0})])

    def test_a_loop_has_rounds_and_the_way_to_one_is_said(self):
        self.assertEqual(self.recipe(cycles=4), genga.Recipe(), "no loop")
        self.assertEqual(self.recipe(loop=True, cycles=4), genga.Recipe(loop=True, cycles=4))
        ways = {
            "swing": "Frames 6 to 29 are one (0.4 %): make them the preview range, and set Frames to Scene",
            "pitch": "and no part of the take is one",
        }
        for name, way in ways.items():
            finding = run.Finding(SimpleNamespace(clip=genga.read(DATA / f"{name}.bvh"), start=1))
            finding.asked = self.recipe(loop=True), {}
            with self.assertRaises(refused.Refused) as told:
                finding.find()
            self.assertTrue(str(told.exception).startswith("a loop needs a round: the last pose is not the first: "))
            self.assertTrue(str(told.exception).endswith(way), told.exception)

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
