"""What the reviewers of Blender's extension site ask for, without Blender: licence, permissions, and code that is refused."""

import ast
import subprocess
import sys
import tempfile
import tomllib
import unittest
import zipfile
from pathlib import Path

ADDONS = Path(__file__).resolve().parents[2] / "addons" / "blender"
PLACE = ADDONS / "genga"
MANIFEST = tomllib.loads((PLACE / "blender_manifest.toml").read_text(encoding="utf-8"))

# Modules that open no connection, start no program and write no file. `genga` writes where a person said.
MODULES = {
    "bisect", "bpy", "bpy_extras", "contextlib", "fnmatch", "genga", "itertools", "json", "math", "mathutils", "numpy", "re", "struct",
    "threading", "time", "types", "typing", "uuid",
}
# Names that run text as code, or lead to the add-on's own folder.
NAMES = {"eval", "exec", "compile", "__import__", "__file__", "__path__", "__loader__", "__spec__"}
# What writes into a file or a folder, as a method or by NumPy.
WRITERS = {"write_text", "write_bytes", "mkdir", "tofile", "save", "savez", "savetxt", "user_resource", "extension_path_user"}


def imported(node):
    """The modules that a statement imports, but not those of the add-on."""
    if isinstance(node, ast.Import):
        return {name.name.split(".")[0] for name in node.names}
    if isinstance(node, ast.ImportFrom) and node.level == 0:
        return {node.module.split(".")[0]}
    return set()


def writes(node):
    """Whether a call opens a file other than for reading."""
    if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "open"):
        return False
    modes = [*node.args[1:2], *(word.value for word in node.keywords if word.arg == "mode")]
    return any(not isinstance(mode, ast.Constant) or set(mode.value) & set("wax+") for mode in modes)


def faults(source):
    """What the site refuses in a source, each with its line."""
    found = []
    for node in ast.walk(ast.parse(source)):
        words = imported(node) - MODULES
        if isinstance(node, ast.Name):
            words |= {node.id} & NAMES
        if isinstance(node, ast.Attribute):
            # `re.compile` is no code.
            words |= {node.attr} & (WRITERS | NAMES - {"compile"})
        if writes(node):
            words.add("open to write")
        found += [f"line {node.lineno}: {word}" for word in sorted(words)]
    return found


class Sources(unittest.TestCase):
    def test_no_source_does_what_is_refused(self):
        sources = sorted(PLACE.rglob("*.py"))
        self.assertGreater(len(sources), 20)
        for path in sources:
            with self.subTest(path=path.name):
                self.assertEqual(faults(path.read_text(encoding="utf-8")), [])

    def test_what_is_refused_is_found_however_it_is_written(self):
        for wrong in (
            "eval(text)", "exec(text)", "import builtins", "builtins.exec(text)", "import urllib.request", "from socket import socket",
            "import os", "from pathlib import Path", "def f():\n  import requests", "open(name, 'w')", "open(name, mode='ab')",
            "open(name, how)", "place.write_text('')", "numpy.save(name, a)", "open(__file__)",
            "bpy.utils.extension_path_user(__package__)",
        ):
            with self.subTest(wrong=wrong):
                self.assertNotEqual(faults(wrong), [])
        for right in ("from . import find", "import numpy as np", "open(name, 'rb')", "open(name, encoding='utf-8')", "result.write(folder)"):
            with self.subTest(right=right):
                self.assertEqual(faults(right), [])


class Licence(unittest.TestCase):
    def test_the_add_on_is_gpl_everywhere(self):
        self.assertEqual(MANIFEST["license"], ["SPDX:GPL-3.0-or-later"])
        text = (PLACE / "LICENSE").read_text(encoding="utf-8").split()
        self.assertEqual(" ".join(text[:7]), "GNU GENERAL PUBLIC LICENSE Version 3, 29")
        for path in sorted(PLACE.glob("*.py")):
            first = path.read_text(encoding="utf-8").splitlines()[0]
            self.assertEqual(first, "# SPDX-License-Identifier: GPL-3.0-or-later", path.name)


class Manifest(unittest.TestCase):
    def test_its_sentences_are_as_the_site_takes_them(self):
        permissions = MANIFEST["permissions"]
        self.assertEqual(set(permissions), {"files"}, "the sources do nothing else")
        for text in (MANIFEST["tagline"], *permissions.values()):
            self.assertLessEqual(len(text), 64, text)
            self.assertRegex(text, r"[\w)]$")
        for text in MANIFEST["copyright"]:
            self.assertRegex(text, r"^\d{4} \w")


class Zips(unittest.TestCase):
    def build(self, folder, *wheels):
        for wheel in wheels:
            (folder / wheel).write_bytes(wheel.encode())
        command = [sys.executable, ADDONS / "build", folder / "made", *(folder / wheel for wheel in wheels)]
        return subprocess.run(command, capture_output=True, encoding="utf-8")

    def test_each_platform_has_a_zip_with_its_own_wheel_alone(self):
        wheels = {
            "linux-x64": "genga_anime-9.8.7-cp39-abi3-manylinux_2_17_x86_64.manylinux2014_x86_64.whl",
            "macos-arm64": "genga_anime-9.8.7-cp39-abi3-macosx_11_0_arm64.whl",
            "windows-x64": "genga_anime-9.8.7-cp39-abi3-win_amd64.whl",
        }
        with tempfile.TemporaryDirectory() as folder:
            done = self.build(Path(folder), *wheels.values())
            self.assertEqual(done.returncode, 0, done.stderr)
            paths = [Path(line) for line in done.stdout.splitlines()]
            self.assertEqual([path.name for path in paths], [f"genga-9.8.7-blender-{name}.zip" for name in wheels])
            for path, (platform, wheel) in zip(paths, wheels.items()):
                archive = zipfile.ZipFile(path)
                inside = {name for name in archive.namelist() if name.endswith(".whl")}
                self.assertEqual(inside, {f"wheels/{wheel}"})
                self.assertLessEqual({"LICENSE", "__init__.py", "wheels/LICENSE-MIT", "wheels/LICENSE-APACHE"}, set(archive.namelist()))
                told = tomllib.loads(archive.read("blender_manifest.toml").decode())
                self.assertEqual((told["version"], told["platforms"]), ("9.8.7", [platform]))
                self.assertEqual(told["wheels"], [f"./wheels/{wheel}"])
                self.assertEqual(told["permissions"], MANIFEST["permissions"])

    def test_two_wheels_of_a_system_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.build(Path(folder), "genga_anime-1.0-cp39-abi3-linux_x86_64.whl", "genga_anime-1.0-cp39-abi3-manylinux2014_x86_64.whl")
            self.assertIn("one wheel per system", done.stderr)
            self.assertNotEqual(done.returncode, 0)


if __name__ == "__main__":
    unittest.main()
