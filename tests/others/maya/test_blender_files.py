"""What the Blender add-on reads, without Blender."""

import importlib
import json
import struct
import sys
import tempfile
import types
import unittest
from pathlib import Path

PLACE = Path(__file__).resolve().parents[3] / "addons" / "blender" / "genga"


# Its files without the first, which asks for Blender.
package = types.ModuleType("addon")
package.__path__ = [str(PLACE)]
sys.modules["addon"] = package


def module(name):
    return importlib.import_module(f"addon.{name}")


files, fit = module("files"), module("fit")

EXTRAS = {"fps": 24, "koma": 3, "keys": [{"koma": 0, "role": "end"}, {"koma": 2, "role": "genga"}]}


class Animations(unittest.TestCase):
    def read(self, document):
        text = json.dumps(document).encode()
        with tempfile.NamedTemporaryFile(suffix=".glb") as file:
            file.write(struct.pack("<4sII I4s", b"glTF", 2, 20 + len(text), len(text), b"JSON") + text)
            file.flush()
            return files.glb_animations(file.name)

    def test_gengas_animations_are_found_among_others(self):
        other = {"name": "walk"}
        found = self.read({"animations": [other, {"name": "koma", "extras": EXTRAS}]})
        self.assertEqual(found, {"koma": EXTRAS})

    def test_extras_that_lack_something_are_refused_in_words(self):
        spoilt = [{name: value for name, value in EXTRAS.items() if name != gone} for gone in EXTRAS]
        spoilt += [{**EXTRAS, "fps": wrong} for wrong in (0, None, "24", True)]
        spoilt += [{**EXTRAS, "koma": 0}, {**EXTRAS, "keys": [{"koma": 0}]}, {**EXTRAS, "keys": [{"role": "end"}]}]
        for extras in [*spoilt, {**EXTRAS, "keys": [3]}, [], 3, None]:
            with self.subTest(extras=extras), self.assertRaisesRegex(files.NotAFile, "no animation with genga's roles"):
                self.read({"animations": [{"name": "koma", "extras": extras}]})
        for document in ([], {"animations": [3]}, {"animations": 3}):
            with self.subTest(document=document), self.assertRaises(files.NotAFile):
                self.read(document)


def layer(name, joints):
    drawing = {"drawing": 0, "role": "genga", "frame": 10}
    return {"name": name, "joints": joints, "drawings": [drawing], "exposures": [{"drawing": 0, "koma": 3}]}


TRUNK, ARM = layer("A", ["Hips", "Spine"]), layer("B", ["L Arm"])


def sheet(**changed):
    """A sheet of a take of 40 frames, from its frame 10 on, in two layers."""
    clip = {"file": "kick.bvh", "frame_rate": 24, "first_frame": 10, "frames": 40}
    clip["joints"] = ["Hips", "Spine", "L Arm"]
    whole = {"schema": "genga-sheet-2", "fps": 24, "clip": clip, "layers": [TRUNK, ARM]}
    return files.Sheet({**whole, **changed})


class Takes(unittest.TestCase):
    BONES = ["Hips", "Spine", "L Arm", "Extra"]

    def doubts(self, bones=None, keyed=(1, 50), first_frame=1, step=1.0):
        return fit.doubts(sheet(), bones or self.BONES, keyed, first_frame, step)

    def test_the_take_itself_is_taken(self):
        self.assertEqual(self.doubts(), [])
        renamed = ["Rig:Hips", "spine.001", "L_Arm"]
        self.assertEqual(self.doubts(renamed), [])
        self.assertEqual(self.doubts(keyed=(1, 123.5), step=2.5), [])
        self.assertEqual(self.doubts(keyed=(0, 49), first_frame=0), [])

    def test_joints_that_the_rig_lacks_are_named(self):
        self.assertEqual(self.doubts(["Hips"]), ["the rig lacks 2 of 3 joints of kick.bvh: Spine, L Arm"])

    def test_another_length_is_said_either_way(self):
        for keyed, words in (
            ((1, 49), "ends on frame 49, but kick.bvh lasts until 50"),
            ((1, 51), "lasts until frame 51, but kick.bvh ends on 50"),
            ((3, 50), "begins on frame 3, but source frame 0 is set to 1"),
        ):
            with self.subTest(keyed=keyed):
                (sentence,) = self.doubts(keyed=keyed)
                self.assertIn(words, sentence)

    def test_each_layer_has_its_own_bones_and_the_root_has_the_rest(self):
        path = lambda bone, what="rotation_euler": f'pose.bones["{bone}"].{what}'
        paths = [path("Hips", "location"), path("L_Arm"), path("Spine"), "location", path('a \\"b\\"')]
        parts, strangers = fit.by_layer(sheet().layers, sheet().joints, paths)
        self.assertEqual(parts, [[paths[0], paths[2], paths[3], paths[4]], [paths[1]]])
        self.assertEqual(strangers, ['a "b"'])
        self.assertEqual(fit.by_layer(sheet().of("B"), sheet().joints, paths), ([paths], []))
        swapped = sheet(layers=[ARM, TRUNK])
        parts, _ = fit.by_layer(swapped.layers, swapped.joints, paths)
        self.assertEqual(parts[1], [paths[0], paths[2], paths[3], paths[4]])

    def test_layers_are_taken_by_name_and_others_refused(self):
        self.assertEqual([layer.name for layer in sheet().of("")], ["A", "B"])
        with self.assertRaisesRegex(files.NotAFile, "no layer C; the sheet has A, B"):
            sheet().of("C")

    def test_what_poses_cannot_show_is_said(self):
        self.assertEqual(fit.left_out(sheet()), [])
        said = fit.left_out(sheet(root="ones", feet="held", exaggerate={"ease": 1}))
        self.assertEqual(len(said), 3)
        self.assertTrue(all(sentence.endswith("limited.bvh has it") for sentence in said))


if __name__ == "__main__":
    unittest.main()
