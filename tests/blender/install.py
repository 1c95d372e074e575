"""python install.py EXTENSION.zip [VERSION]: Blender installs the extension, and the wheel inside finds the keys of a take."""

import sys

import bpy

import addon
from addon import DATA, empty, say


def main():
    empty()
    bpy.ops.preferences.addon_enable(module="bl_pkg")
    done = bpy.ops.extensions.package_install_files(filepath=sys.argv[1], repo="user_default", enable_on_install=True)
    assert done == {"FINISHED"}
    import genga

    assert sys.argv[2:] in ([], [genga.__version__]), genga.__version__
    assert bpy.utils.user_resource("EXTENSIONS") in genga.__file__, genga.__file__
    bpy.ops.import_anim.bvh(filepath=str(DATA / "kick.bvh"))
    assert bpy.ops.genga.find_keys() == {"FINISHED"}
    names = [kind for kind in dir(bpy.types) if kind.startswith("GENGA_PT_")]
    assert len(names) == 10, names
    page = next(addon for addon in bpy.context.preferences.addons if addon.module.endswith(".genga")).preferences
    page.language, page.preset = "ja_JP", "few"
    page.language = "AUTO"
    print(f"Installed in Blender {bpy.app.version_string}")
    say(f"the wheel is its own, {len(names)} panels, a page of preferences")


addon.run(main)
