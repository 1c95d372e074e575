"""blender --python picture.py -- TABS: the layout of the picture; TABS is written with the places of the sidebars' tabs."""

import os
import sys
import traceback
from pathlib import Path

import bpy
from io_anim_bvh import import_bvh

import addon
import rigs

TABS = Path(sys.argv[-1])
# The genga that is shown, and how much of the height the dope sheet has.
SHOWN, SHEET = 7, 0.2
# Where genga's tab stands below the top of a sidebar, beside the tabs of Blender itself, and from its right side.
TAB_BELOW, TAB_BESIDE = {"VIEW_3D": 241, "DOPESHEET_EDITOR": 174}, 14


def areas():
    of = {area.type: area for area in bpy.context.window_manager.windows[0].screen.areas}
    return of["VIEW_3D"], of["DOPESHEET_EDITOR"]


def inside(area, kind="WINDOW"):
    window = bpy.context.window_manager.windows[0]
    region = next(region for region in area.regions if region.type == kind)
    return bpy.context.temp_override(window=window, screen=window.screen, area=area, region=region)


def close_others():
    """The 3-D view alone."""
    window = bpy.context.window_manager.windows[0]
    for kind in ("OUTLINER", "PROPERTIES", "DOPESHEET_EDITOR"):
        area = next(area for area in window.screen.areas if area.type == kind)
        with bpy.context.temp_override(window=window, screen=window.screen, area=area):
            bpy.ops.screen.area_close()


def split():
    """The dope sheet below it."""
    window = bpy.context.window_manager.windows[0]
    view = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    with inside(view):
        bpy.ops.screen.area_split(direction="HORIZONTAL", factor=SHEET)
    lowest = min((area for area in window.screen.areas if area.type == "VIEW_3D"), key=lambda area: area.y)
    lowest.ui_type = "DOPESHEET"


def mend():
    """What Debian's Blender 3.4 lacks: its importer opens files as its Python no longer does, and words have no context."""
    import_bvh.open = lambda path, _mode: open(path)
    for name in ("BoolProperty", "EnumProperty", "FloatProperty", "IntProperty", "StringProperty"):
        own = getattr(bpy.props, name)
        setattr(bpy.props, name, lambda own=own, translation_context=None, **about: own(**about))


def play():
    """A kick on its sheet, one of its genga shown."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    mend()
    bpy.ops.import_anim.bvh(filepath=str(addon.DATA / "kick.bvh"), update_scene_fps=True, global_scale=0.01)
    thing = rigs.active(rigs.armature())
    genga = addon.load()
    # All of the panel is to be seen.
    genga.panel.Sampled.bl_options = set()
    for panel in genga.panel.PANELS:
        panel.bl_options = set()
    genga.register()
    with inside(areas()[0]):
        bpy.ops.object.mode_set(mode="POSE")
        bpy.ops.pose.select_all(action="SELECT")
        bpy.ops.genga.find_keys()
    markers = thing.animation_data.action.pose_markers
    bpy.context.scene.frame_set(next(marker.frame for marker in markers if marker.name.split()[0] == str(SHOWN)))


def look():
    view, sheet = areas()
    sheet.spaces.active.mode = "ACTION"
    for area in (view, sheet):
        area.spaces.active.show_region_ui = True
    with inside(view):
        bpy.ops.view3d.view_axis(type="RIGHT")
        bpy.ops.view3d.view_selected()
    with inside(sheet):
        bpy.ops.action.view_all()


def tell():
    high = bpy.context.window_manager.windows[0].height
    places = []
    for area in areas():
        side = next(region for region in area.regions if region.type == "UI")
        x, y = side.x + side.width - TAB_BESIDE, high - side.y - side.height + TAB_BELOW[area.type]
        places.append(f"{x},{y}\n")
    whole = TABS.with_suffix(".part")
    whole.write_text("".join(places))
    whole.rename(TABS)


STEPS = [close_others, split, play, look, tell]


def step():
    """One after the other, with a drawn window between them."""
    try:
        STEPS.pop(0)()
    except BaseException:
        traceback.print_exc()
        os._exit(1)
    return 1.0 if STEPS else None


bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(step, first_interval=2.0)
