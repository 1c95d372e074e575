"""What the Blender add-on reads, without Blender."""

import importlib.util
import json
import struct
import tempfile
import unittest
from pathlib import Path

PLACE = Path(__file__).resolve().parents[3] / "addons" / "blender" / "genga" / "files.py"
SPEC = importlib.util.spec_from_file_location("files", PLACE)
files = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(files)

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


if __name__ == "__main__":
    unittest.main()
