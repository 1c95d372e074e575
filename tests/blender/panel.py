"""python panel.py: what a person does with the panel: pins in the view and by markers, presets, saving, Esc.

GENGA is the program.
"""

from types import SimpleNamespace
from unittest import mock

import bpy

import addon
import made
import rigs
from addon import DATA, refused, say
from genga_addon import marks, modal, preferences, stepping, subject, take, watch, words
from made import FOLDER, begin, find, genga, marks_of
from window import Layout, Window, driven, modally

KICK = DATA / "kick.bvh"


def editor(kind):
    """Blender's context within an editor."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == kind)
    region = next(region for region in area.regions if region.type == "WINDOW")
    return bpy.context.temp_override(window=window, area=area, region=region)


def keys(action):
    return {marker.frame for marker in action.pose_markers}


def points(action):
    return [point for curve in stepping.curves(action) for point in curve.keyframe_points]


def pinned_in_the_view():
    """In the view a pin is the current frame, whatever keys are selected; in the dope sheet it is the selected keys."""
    thing = begin(rigs.of_bvh, KICK)
    played = thing.animation_data.action
    for point in points(played):
        point.select_control_point = True
    bpy.context.scene.frame_set(33)
    with editor("VIEW_3D"):
        assert driven(genga.turn.GENGA_OT_mark, what="PIN").invoke(Window(), None) == {"FINISHED"}
    assert marks_of() == [("pin", 33)], marks_of()
    action = find(thing)
    assert 33 in keys(action)
    assert not any(point.select_control_point or point.select_left_handle for point in points(action)), "made keys are not selected"
    assert not any(marker.select for marker in bpy.context.scene.timeline_markers)
    bpy.ops.genga.toggle()
    with editor("DOPESHEET_EDITOR"):
        assert len(marks.chosen(bpy.context, thing)) == 92
        window = Window()
        assert driven(genga.turn.GENGA_OT_mark, what="PIN").invoke(window, None) == {"RUNNING_MODAL"}
        assert window.asked[0] == "Pin 92 frames?" and marks_of() == [("pin", 33)], "it asks before it pins many"
        for point in points(played):
            point.select_control_point = point.co.x in (40, 41, 60)
        assert driven(genga.turn.GENGA_OT_mark, what="FORBID").invoke(Window(), None) == {"FINISHED"}
    assert marks_of() == [("forbid", 60), ("forbid from", 40), ("forbid to", 41), ("pin", 33)], marks_of()
    thing.genga.told = ""
    bpy.ops.genga.mark(what="CLEAR")
    assert marks_of() == [] and "genga" in thing.genga.told
    say("a pin in the view is the current frame; many pins are asked for; made keys are not selected")


def dragged():
    """A marker that is dragged, named by hand or removed changes the sheet; another armature's does not."""
    thing = begin(rigs.of_bvh, KICK)
    action, markers = find(thing), bpy.context.scene.timeline_markers
    plain = keys(action)
    assert watch.look() == watch.LOOK and keys(action) == plain
    pin = markers.new("pin contact", frame=33)
    watch.look()
    assert 33 in keys(action) and 35 not in plain
    result = genga.findings.of(thing).result
    assert "contact" in result.keys["name"].tolist()
    with mock.patch.object(watch, "is_busy", lambda _: True):
        pin.frame = 35
        watch.look()
        assert 33 in keys(action), "nothing changes while a hand holds the marker"
    watch.look()
    assert 35 in keys(action) and 33 not in keys(action)
    thing.genga.live = False
    pin.frame = 36
    watch.look()
    assert 36 not in keys(action)
    thing.genga.live = True
    watch.look()
    assert 36 in keys(action)
    pin.name = "forbid twice"
    watch.look()
    assert "is not understood" in thing.genga.told, thing.genga.told
    markers.remove(pin)
    watch.look()
    assert keys(action) == plain
    key = sorted(plain)[3]
    forbid = markers.new("forbid", frame=key)
    watch.look()
    assert key not in keys(action), (key, keys(action))
    forbid.name = "forbid [another]"
    watch.look()
    assert keys(action) == plain
    # A number that is named pin stays where it is.
    number = next(marker for marker in markers if marker.name.startswith("3 "))
    number.name, number.frame = "pin", number.frame + 1
    watch.look()
    assert number.frame in keys(action) and marks_of() == [("forbid", key), ("pin", number.frame)]
    say("markers that pin and forbid are dragged, named and removed")


def kept_in_the_file():
    """After saving, renaming and opening again knobs do what they say, and the panel has its message."""
    thing = begin(rigs.of_bvh, KICK)
    find(thing)
    thing.genga.on = "3"
    told = thing.genga.told
    bpy.context.scene.timeline_markers.new("pin contact [kick]", frame=33)
    thing.name = "renamed"
    file = str(FOLDER / "kept.blend")
    assert bpy.ops.wm.save_as_mainfile(filepath=file) == {"FINISHED"}
    bpy.ops.wm.open_mainfile(filepath=file)
    thing = bpy.data.objects["renamed"]
    assert genga.findings.of(thing) is None and thing.genga.told == told
    action = thing.animation_data.action
    drawings = len(action[take.BEGINS])
    numbers = lambda: [marker.name for marker in bpy.context.scene.timeline_markers if marker.name[0].isdigit()]
    assert len(numbers()) == len(action.pose_markers)
    thing.genga.on = "1"
    assert thing.animation_data.action == action and len(action[take.BEGINS]) > drawings, "a knob after opening"
    assert 33 in keys(action) and len(numbers()) == len(action.pose_markers), "its own markers"
    pins = lambda: [marker.name for marker in bpy.context.scene.timeline_markers if not marker.name[0].isdigit()]
    assert pins() == ["pin contact [renamed]"], pins()
    thing.name = "again"
    thing.genga.on = "2"
    assert len(bpy.data.actions) == 2 and all(name.endswith(" again") for name in numbers()), numbers()
    bpy.ops.genga.toggle()
    assert thing.animation_data.action == action[take.SOURCE]
    bpy.ops.genga.toggle()
    assert thing.animation_data.action == action
    bpy.ops.wm.save_as_mainfile(filepath=file)
    bpy.ops.wm.open_mainfile(filepath=file)
    thing = bpy.data.objects["again"]
    action = thing.animation_data.action
    watch.look()
    next(marker for marker in bpy.context.scene.timeline_markers if marker.name == "pin contact [again]").frame = 35
    watch.look()
    assert 35 in keys(action) and 33 not in keys(action), "a marker after opening"
    bpy.ops.wm.open_mainfile(filepath=file)
    thing = bpy.data.objects["again"]
    thing.animation_data.action = bpy.data.actions.new("other")
    thing.genga.on = "3"
    assert thing.genga.told == "another action is active: find its keys first", thing.genga.told
    say("after saving, renaming and opening again knobs and marks do what they say")


def copied():
    """A copy of an armature gets an id, a sheet and markers of its own."""
    thing = begin(rigs.of_bvh, KICK)
    action = find(thing)
    first = made.all_keys(action)
    bpy.ops.genga.toggle()
    copy = thing.copy()
    bpy.context.scene.collection.objects.link(copy)
    rigs.active(copy)
    assert copy.animation_data.action == thing.animation_data.action and copy.genga.own_id == thing.genga.own_id
    copy.genga.on = "1"
    other = find(copy)
    assert other != action and made.all_keys(action) == first and copy.genga.own_id != thing.genga.own_id
    count = lambda name: [marker.name.partition(" ")[2] for marker in bpy.context.scene.timeline_markers].count(name)
    assert (count("kick"), count("kick.001")) == (len(action.pose_markers), len(other.pose_markers))
    bpy.ops.genga.mark(what="PIN")
    assert [marker.name for marker in marks.of(bpy.context.scene, copy)] == ["pin [kick.001]"]
    assert marks.of(bpy.context.scene, thing) == []
    say("a copy has a sheet of its own")


def another_action():
    """A knob says what to do when another action is active."""
    thing = begin(rigs.of_bvh, KICK)
    find(thing)
    bpy.ops.import_anim.bvh(filepath=str(DATA / "swing.bvh"))
    swing = bpy.context.active_object
    thing.animation_data.action = swing.animation_data.action
    thing.genga.on = "3"
    assert thing.genga.told == "another action is active: find its keys first", thing.genga.told
    say("a knob says when another action is active")


def set_and_reset():
    """A preset sets its settings and takes back those of the one before."""
    thing = begin(rigs.of_bvh, KICK)
    own, names = thing.genga, genga.presets.NAMES
    usual = {name: getattr(own, name) for name in names}
    plain = keys(find(thing))
    own.feet = True
    for name in ("few", "snappy", "threes"):
        assert bpy.ops.genga.preset(preset=name) == {"FINISHED"}
    assert {name: getattr(own, name) for name in names} == {**usual, "on": "3"}
    own.genga = 9
    bpy.ops.genga.preset(preset="usual")
    assert {name: getattr(own, name) for name in names} == usual
    assert keys(thing.animation_data.action) == plain and own.feet, "what no preset sets stays"
    say("presets set and reset")


def preferred():
    """The page of the preferences has the language, the preset of new armatures, and the colours."""
    thing = begin(rigs.of_bvh, KICK)
    own = page()
    own.preset, own.sheet_colour = "threes", (0.25, 0.5, 0.75)
    action = find(thing)
    assert thing.genga.on == "3"
    groups = {curve.group for curve in stepping.curves(action) if curve.group}
    painted = {tuple(round(part, 2) for part in group.colors.normal) for group in groups}
    assert painted == {(0.25, 0.5, 0.75)}, painted
    thing.genga.on = "1"
    find(thing)
    assert thing.genga.on == "1", "what a person set stays"
    thing = begin(rigs.of_bvh, KICK)
    page().preset = "threes"
    thing.genga.snap = 0.5
    find(thing)
    assert thing.genga.on == "2-3", "settings of a person are no new ones"
    thing = begin(rigs.of_bvh, KICK)
    page().preset = "threes"
    bpy.context.scene.timeline_markers.new("forbid twice", frame=3)
    refused("is not understood", bpy.ops.genga.find_keys)
    assert thing.genga.on == "2-3", "nothing was changed"
    spoken(page())
    say("preferences: preset, colours and language")


def page():
    """The add-on's page. Opening a file resets it."""
    made = bpy.context.preferences.addons.new()
    made.module = genga.__name__
    own = preferences.of(bpy.context)
    assert own.bl_rna.identifier == "GengaPreferences"
    return own


def spoken(own):
    """The language of the page is that of the translations, also where Blender speaks another."""
    tables = SimpleNamespace(locale="en_US", contexts=bpy.app.translations.contexts, unregister=lambda _: heard.append(None))
    tables.register = lambda _, table: heard.append(table)
    fake, heard = SimpleNamespace(app=SimpleNamespace(translations=tables)), []
    with mock.patch.object(words, "bpy", fake):
        for language, locales in (("ja_JP", {"en_US", "ja_JP"}), ("en_US", set()), ("AUTO", {"ja_JP"})):
            heard.clear()
            own.language = language
            assert heard[0] is None and set(heard[1]) == locales, heard
            assert all(table["*", "Find Keys"] == "原画を探す" for table in heard[1].values())


def with_the_mesh():
    """With the mesh selected the panel stays, and works on its armature."""
    thing = begin(rigs.of_bvh, KICK)
    bpy.ops.mesh.primitive_cube_add()
    mesh = bpy.context.active_object
    panels = [panel for panel in genga.panel.PANELS if panel.bl_space_type == "VIEW_3D"]
    assert not any(panel.poll(bpy.context) for panel in panels) and not bpy.ops.genga.find_keys.poll()
    refused("Select the armature that plays the take, or its mesh", bpy.ops.genga.find_keys)
    mesh.modifiers.new("skin", "ARMATURE").object = thing
    assert subject.armature_of(bpy.context) == thing and all(panel.poll(bpy.context) for panel in panels)
    assert find(thing)[take.STEPPED] == "kick"
    assert bpy.ops.genga.mark(what="PIN") == bpy.ops.genga.toggle() == {"FINISHED"}
    mesh.modifiers.clear()
    prop = bpy.data.objects.new("prop", None)
    bpy.context.scene.collection.objects.link(prop)
    prop.parent, prop.parent_type, prop.parent_bone = thing, "BONE", "Head"
    mesh.parent = prop
    assert subject.armature_of(bpy.context) == thing, "a prop in the hand"
    say("the panel stays when the mesh is selected")


def settings_of(knobs):
    plain = [own.identifier for own in knobs.bl_rna.properties if own.type not in ("COLLECTION", "POINTER")]
    return [(name, getattr(knobs, name), knobs.is_property_set(name)) for name in plain]


def state():
    return (
        sorted(action.name for action in bpy.data.actions), len(bpy.context.scene.timeline_markers), bpy.context.scene.frame_current,
        [(thing.animation_data.action.name, *settings_of(thing.genga)) for thing in bpy.data.objects if thing.animation_data],
    )


def stopped_and_gone_on():
    """The window shows how far it is, Esc changes nothing however late it comes, and else the result is that of a script."""
    thing = begin(rigs.of_bvh, KICK)
    bpy.context.scene.frame_set(17)
    before = state()
    with mock.patch.object(modal, "SLICE", 0.0):
        for at in (0, 1, 40, 93):
            window = Window()
            done, said = modally(genga.find.GENGA_OT_find_keys, window, [*["TIMER", "MOUSEMOVE"] * at, "ESC"])
            assert (done, said) == ({"CANCELLED"}, [({"INFO"}, "Nothing was changed")]), (at, said)
            assert state() == before and window.timers == 0 and window.shown[-1] == "end" and window.status[-1] is None, at
        window = Window()
        done, said = modally(genga.find.GENGA_OT_find_keys, window, iter(lambda: "TIMER", None))
    assert done == {"FINISHED"} and window.shown[1:-1] == sorted(window.shown[1:-1]) and window.shown[-2] == 100, window.shown
    assert window.status[0] == "genga: frame 1 of 92. Esc cancels" and "genga: finding keys. Esc cancels" in window.status
    assert bpy.context.scene.frame_current == 17
    action = thing.animation_data.action
    by_hand = made.all_keys(action)
    find(thing)
    assert made.all_keys(action) == by_hand
    count = len(bpy.data.actions)
    before = state()
    with mock.patch.object(modal, "SLICE", 0.0):
        for at in (1, 30, 120):
            done, _ = modally(genga.curves.GENGA_OT_curves, Window(), [*["TIMER"] * at, "ESC"])
            assert done == {"CANCELLED"} and state() == before and len(bpy.data.actions) == count, at
    thing.genga.rest = "keys.min_prize=8"
    done, said = modally(genga.find.GENGA_OT_find_keys, Window(), iter(lambda: "TIMER", None))
    assert done == {"CANCELLED"} and "did you mean keys.min_price" in said[0][1], said
    say("progress and Esc, through the modal way")


def drawn():
    """Every panel draws, with passages and messages, and shows every setting once."""
    thing = begin(rigs.of_bvh, KICK)
    find(thing)
    thing.genga.passages.add()
    window, layout = Window(), Layout()
    window.region = SimpleNamespace(width=200)
    for panel in [panel for panel in genga.panel.PANELS if panel.bl_space_type == "VIEW_3D"]:
        panel.draw(SimpleNamespace(layout=layout), window)
    preferences.GengaPreferences.draw(SimpleNamespace(layout=layout, bl_rna=preferences.GengaPreferences.bl_rna), window)
    knobs = [own for own in genga.knobs.GengaKnobs.bl_rna.properties if not own.is_hidden]
    settings = {own.identifier for own in knobs if own.type not in ("COLLECTION", "POINTER")}
    assert settings - {"name"} <= set(layout.drawn), settings - set(layout.drawn)
    assert any("genga, " in text for text in layout.drawn), layout.drawn
    assert {"genga.find_keys", "genga.curves", "genga.toggle", "genga.mark", "genga.passage", "genga.export"} <= set(layout.drawn)
    say("all panels and the page of preferences draw")


def in_words():
    """What a person may run into is said in words: no traceback."""
    thing = begin(rigs.of_bvh, KICK)
    library = str(FOLDER / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=library)
    addon.empty()
    with bpy.data.libraries.load(library, link=True) as (there, here):
        here.objects = ["kick"]
    linked = bpy.data.objects["kick"]
    bpy.context.scene.collection.objects.link(linked)
    rigs.active(linked)
    refused("kick is linked from another file: make a library override", bpy.ops.genga.find_keys)
    refused("is linked from another file", lambda: bpy.ops.genga.mark(what="PIN"))
    refused("is linked from another file", lambda: bpy.ops.genga.preset(preset="few"))
    thing = begin(rigs.of_bvh, KICK)
    thing.genga.frames = "SCENE"
    scene = bpy.context.scene
    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 40, 40
    try:
        bpy.ops.genga.find_keys()
    except RuntimeError as error:
        assert "Traceback" not in str(error), error
    scene.use_preview_range = False
    thing.genga.rest = "layers=nowhere"
    refused("layers", bpy.ops.genga.find_keys)
    thing.genga.rest = ""
    find(thing)
    thing.genga.passages.add().start = 500
    assert "has no frame of the take" in thing.genga.told or "is not in the clip" in thing.genga.told, thing.genga.told
    thing.genga.passages.clear()
    thing.data.bones.active = None
    while thing.animation_data.action:
        bpy.data.actions.remove(thing.animation_data.action)
    thing.genga.on = "1"
    assert "has no action" in thing.genga.told, thing.genga.told
    say("errors are said in words")


def main():
    print(f"Panel in Blender {bpy.app.version_string}")
    pinned_in_the_view()
    dragged()
    kept_in_the_file()
    copied()
    another_action()
    set_and_reset()
    preferred()
    with_the_mesh()
    drawn()
    stopped_and_gone_on()
    in_words()
    genga.unregister()


addon.run(main)
