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


def window():
    return bpy.context.window_manager.windows[0]


def areas(kind):
    return [area for area in window().screen.areas if area.type == kind]


def area(kind):
    return areas(kind)[0]


def region(of, kind="WINDOW"):
    return next(region for region in of.regions if region.type == kind)


def inside(of):
    return bpy.context.temp_override(window=window(), screen=window().screen, area=of, region=region(of))


def close_others():
    """The 3-D view alone."""
    for kind in ("OUTLINER", "PROPERTIES", "DOPESHEET_EDITOR"):
        with inside(area(kind)):
            bpy.ops.screen.area_close()


def split():
    """The dope sheet below it."""
    with inside(area("VIEW_3D")):
        bpy.ops.screen.area_split(direction="HORIZONTAL", factor=SHEET)
    min(areas("VIEW_3D"), key=lambda one: one.y).ui_type = "DOPESHEET"


def mend():
    """What Debian's Blender 3.4 lacks: its importer opens files as its Python no longer does, words have no context, and
    objects no id of the session."""
    import_bvh.open = lambda path, _mode: open(path)
    for name in ("BoolProperty", "EnumProperty", "FloatProperty", "IntProperty", "StringProperty"):
        own = getattr(bpy.props, name)
        setattr(bpy.props, name, lambda own=own, translation_context=None, **about: own(**about))
    for kind in (bpy.types.Object, bpy.types.Action):
        kind.session_uid = property(lambda own: own.as_pointer())
    bpy.types.Object.is_editable, bpy.types.Window.modal_operators = True, ()


def play():
    """A kick on its sheet, one of its genga shown."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    mend()
    bpy.ops.import_anim.bvh(filepath=str(addon.DATA / "kick.bvh"), update_scene_fps=True, global_scale=0.01)
    thing = rigs.active(rigs.armature())
    genga = addon.load()
    # All of the panel is to be seen.
    for panel in genga.panel.PANELS:
        panel.bl_options = set()
    genga.register()
    with inside(area("VIEW_3D")):
        bpy.ops.object.mode_set(mode="POSE")
        bpy.ops.pose.select_all(action="SELECT")
        bpy.ops.genga.find_keys()
    markers = thing.animation_data.action.pose_markers
    bpy.context.scene.frame_set(next(marker.frame for marker in markers if marker.name.split()[0] == str(SHOWN)))


def look():
    view, sheet = map(area, TAB_BELOW)
    sheet.spaces.active.mode = "ACTION"
    for one in (view, sheet):
        one.spaces.active.show_region_ui = True
    with inside(view):
        bpy.ops.view3d.view_axis(type="RIGHT")
        bpy.ops.view3d.view_selected()
    with inside(sheet):
        bpy.ops.action.view_all()


def tell():
    places = []
    for kind, below in TAB_BELOW.items():
        side = region(area(kind), "UI")
        x, y = side.x + side.width - TAB_BESIDE, window().height - side.y - side.height + below
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
