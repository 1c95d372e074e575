"""The add-on as Blender loads it, under a name that leaves `genga` to the wheel."""

import importlib.util
import os
import sys
import traceback
from pathlib import Path

import bpy

PLACE = Path(__file__).resolve().parents[2] / "addons" / "blender" / "genga"
CLIPS = Path(os.environ.get("GENGA_CLIPS", Path(__file__).resolve().parents[3] / "shared" / "data" / "bvh"))
DATA = Path(__file__).resolve().parents[2] / "data"


def load():
    spec = importlib.util.spec_from_file_location("genga_addon", PLACE / "__init__.py", submodule_search_locations=[str(PLACE)])
    addon = importlib.util.module_from_spec(spec)
    sys.modules["genga_addon"] = addon
    spec.loader.exec_module(addon)
    return addon


def empty(fps=24):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = fps


def run(main):
    """Runs the tests; Blender may never end by itself while an add-on is registered."""
    failed = 0
    try:
        main()
    except BaseException:
        traceback.print_exc()
        failed = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(failed)


def say(text):
    print(f"  {text}")


def refused(words, work):
    """That Blender reports an error in these words, and no traceback."""
    try:
        work()
    except RuntimeError as error:
        assert words in str(error), (words, str(error))
        assert "Traceback" not in str(error), str(error)
        return
    raise AssertionError(f"not refused: {words}")
