"""python find.py: what Find Keys does on a rig. GENGA is the program that it is compared with; QUICK=1 leaves the importers out."""

import os
from types import SimpleNamespace

import bpy
import numpy as np

import addon
import rigs
from addon import DATA, refused, say

from made import FOLDER, all_keys, begin, check_held, check_keys, find, genga, marks_of, stepping, take

KICK = DATA / "kick.bvh"


def held_still(thing, action):
    check_keys(action)
    held, same = check_held(thing, action)
    markers = {marker.name for marker in bpy.context.scene.timeline_markers}
    assert f"1 {thing.name}" in markers and action.pose_markers[0].frame == 1
    say(f"{held} koma stand still to the last bit, {same} drawings are the take's frames")


def undone():
    """One undo leaves no trace, and what comes after it works."""
    thing = begin(rigs.of_bvh, KICK)
    name = thing.name
    state = lambda: (sorted(action.name for action in bpy.data.actions), bpy.data.objects[name].animation_data.action.name,
                     len(bpy.context.scene.timeline_markers), bpy.context.scene.frame_current,
                     all_keys(bpy.data.objects[name].animation_data.action))
    bpy.ops.ed.undo_push(message="before")
    before = state()
    assert bpy.ops.genga.find_keys("EXEC_DEFAULT", True) == {"FINISHED"}
    assert state() != before
    bpy.ops.ed.undo()
    assert state() == before, "one undo"
    thing = bpy.data.objects[name]
    thing.genga.on = "3"
    thing.genga.on = "2"
    assert [action.name for action in bpy.data.actions] == ["kick", "kick koma"], "knobs after an undo"
    assert thing.animation_data.action.name == "kick koma"
    say("one undo leaves no trace")


def knobs_and_marks():
    thing = begin(rigs.of_bvh, KICK)
    fresh = genga.settings.recipe(thing.genga, genga.pins.read([]), 1)
    import genga as engine

    assert fresh == engine.Recipe(), "knobs that are not touched change nothing"
    action = find(thing)
    first = all_keys(action)
    assert find(thing) == action and all_keys(action) == first, "the take is looked at while its sheet is shown"
    count = lambda: len(action[take.BEGINS])
    all_drawings = count()
    thing.genga.genga = 9
    assert len(action.pose_markers) == 9, len(action.pose_markers)
    thing.genga.genga = 0
    bpy.ops.genga.preset(preset="threes")
    assert thing.genga.on == "3" and count() < all_drawings
    thing.genga.on = "2-3"
    assert count() == all_drawings
    keys = lambda: {marker.frame for marker in action.pose_markers}
    # The take's frame 25 is marked by hand; the sheet shows frames of the take on koma of the same number.
    played = take.Take(thing).action
    for curve in stepping.curves(played)[:1]:
        curve.keyframe_points[25].type = "EXTREME"
    assert 26 not in keys()
    find(thing)
    assert 26 in keys(), "a key marked as extreme is pinned"
    bpy.context.scene.frame_set(50)
    bpy.ops.genga.toggle()
    bpy.ops.genga.mark(what="ONLY")
    assert marks_of() == [("pin", 50)] and thing.genga.only_pins
    assert {1, 26, 50} < keys() and len(keys()) == 4, keys()
    bpy.ops.genga.mark(what="CLEAR")
    assert marks_of() == [] and len(keys()) > 4
    thing.genga.rest = "keys.min_prize=8"
    assert "did you mean keys.min_price" in thing.genga.told
    refused("did you mean keys.min_price", bpy.ops.genga.find_keys)
    thing.genga.rest = ""
    written = FOLDER / "sheet"
    assert bpy.ops.genga.export(directory=str(written), formats={"xdts", "xsheet", "csv", "cut"}) == {"FINISHED"}
    names = {path.name for path in written.rglob("*")}
    assert {"kick_genga_ts.xdts", "kick_xsheet.html", "keys.csv", "A_0001.png"} <= names, sorted(names)[:20]
    say("knobs, presets, marks and files")


def presets():
    """Each preset does on the kick what it is called."""
    found = {}
    for name in ("", *(preset[0] for preset in genga.presets.PRESETS)):
        thing = begin(rigs.of_bvh, KICK)
        name and bpy.ops.genga.preset(preset=name)
        action = find(thing)
        begins = list(action[take.BEGINS])
        stays = [round(until - at) for at, until in zip(begins, begins[1:])]
        found[name] = SimpleNamespace(genga=len(action.pose_markers), drawings=len(begins), stays=stays)
    usual = lambda name: max(set(found[name].stays), key=found[name].stays.count)
    laws = {
        "usual": lambda own: vars(own) == vars(found[""]),
        "twos": lambda own: usual("twos") == min(own.stays) == 2,
        "threes": lambda own: usual("threes") == 3 and 1 not in own.stays and own.drawings < found["twos"].drawings,
        "modulated": lambda own: {1, 2, 3} <= set(own.stays),
        "snappy": lambda own: own.drawings < found["soft"].drawings,
        "soft": lambda own: own.drawings > found[""].drawings,
        "few": lambda own: own.genga < found[""].genga,
    }
    assert set(laws) == set(found) - {""}, "each preset has a law"
    for name, law in laws.items():
        assert law(found[name]), (name, found)
    say(f"presets: {', '.join(laws)} do what they are called")


def feet_held(name, thing):
    """With held feet the rig stands as genga's own motion on the sheet does, and a sole on one place while it stands."""
    thing.genga.feet = True
    action = find(thing)
    result, sampled = genga.findings.of(thing).result, genga.findings.of(thing).sampled
    stepped, free = result.limited, result.again(feet="free").limited
    own = np.linalg.norm(stepped.positions - free.positions, axis=2)
    size = np.ptp(stepped.positions[0], axis=0).max()
    assert own.max() > 0.003 * size, "feet slide in this take"
    worst = 0.0
    for begin, exposure in zip(action[take.BEGINS], genga.findings.of(thing).sheet().layers[0].exposures):
        bpy.context.scene.frame_set(int(begin))
        drawn = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
        stood = np.array([drawn.matrix_world @ drawn.pose.bones[bone].head for bone in sampled.clip.names])
        worst = max(worst, np.abs(stood - stepped.positions[exposure.koma]).max() / size)
    assert worst < 2e-5, (name, worst)
    check_keys(action)
    thing.genga.feet = False
    say(f"{name}: feet held as on the sheet, off by {worst:.1e} of the body; without {own.max() / size:.3f}")


# A thigh of each rig that IK turns, without a constraint of its own.
LED = {"Rigify": "DEF-thigh.L", "MMD": "右足,"}


def led_by_controls(name, thing):
    """Feet of a rig whose legs no key of their own turns stay, and it is said."""
    thing.genga.feet = True
    told = thing.genga.told
    assert "the feet move with their drawings" in told and "limited.bvh" in told, told
    assert LED[name] in told, told
    thing.genga.feet = False
    assert "feet" not in thing.genga.told


def ticked():
    """A bone that is ticked in the list is not looked at, and is keyed all the same."""
    thing = begin(rigs.of_bvh, KICK)
    names = lambda: set(genga.findings.of(thing).sampled.clip.names)
    curves = len(stepping.curves(find(thing)))
    before = names()
    bpy.ops.object.mode_set(mode="POSE")
    rigs.select_bones(thing, {"LeftHand", "RightHand"})
    assert bpy.ops.genga.tick(what="SELECTED") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert {bone.name for bone in thing.data.bones if bone.genga_left_out} == {"LeftHand", "RightHand"}
    assert len(stepping.curves(find(thing))) == curves
    assert before - names() == {"LeftHand", "RightHand"}, before - names()
    assert bpy.ops.genga.tick(what="NONE") == {"FINISHED"}
    find(thing)
    assert names() == before
    say("bones are ticked in a list, and left out")


def told_kindly():
    """What cannot be is refused in words."""
    thing = begin(rigs.of_bvh, KICK)
    refused("choose a folder", lambda: find() and bpy.ops.genga.export(directory="", formats={"csv"}))
    markers = bpy.context.scene.timeline_markers
    for name, words in (("forbid soon", "is not understood"), ("forbid to", "has no “forbid from”"), ("forbid from", "has no “forbid to”")):
        marker = markers.new(name, frame=20)
        refused(words, bpy.ops.genga.find_keys)
        markers.remove(marker)
    marker = markers.new("pin", frame=1000)
    refused("which is frame 1 here", bpy.ops.genga.find_keys)
    markers.remove(marker)
    thing.genga.leave_out = "*"
    refused("no bone is left", bpy.ops.genga.find_keys)
    thing.genga.leave_out = ""
    thing.pose.bones["Head"].scale = (0.0, 0.0, 0.0)
    thing.animation_data.action = take.Take(thing).action
    refused("scaled to zero", bpy.ops.genga.find_keys)
    thing.animation_data.action = None
    refused("has no action", bpy.ops.genga.find_keys)
    thing.animation_data_clear()
    refused("has no action", bpy.ops.genga.find_keys)
    bpy.context.view_layer.objects.active = None
    refused("Select the armature", bpy.ops.genga.find_keys)
    say("what cannot be is refused in words")


def in_japanese():
    """Every label of the panel, the knobs and the presets has a Japanese word. Blender as a module has no languages."""
    said = genga.words.JAPANESE
    knobs = [own for name, own in genga.knobs.GengaKnobs.bl_rna.properties.items() if name not in ("rna_type", "name")]
    labels = {own.name for own in knobs if not own.is_hidden and own.type != "COLLECTION"} | {preset[1] for preset in genga.presets.PRESETS}
    labels |= {panel.bl_label for panel in genga.panel.PANELS} | {"Find Keys", "Show the Take", "Pin", "Forbid", "Only", "Clear"}
    labels |= {own.name for own in genga.knobs.GengaPassage.bl_rna.properties.values() if own.identifier in ("start", "end")}
    labels |= {"Keys with Curves", "Language", "Default Preset", "Left Out", "Leave Out Selected", "Leave Out None"}
    assert labels <= set(said), labels - set(said)
    # Nothing of what is translated is gone.
    source = "".join(path.read_text(encoding="utf-8") for path in addon.PLACE.glob("*.py") if path.name != "words.py")
    assert not [word for word in said if word not in source], [word for word in said if word not in source]
    say(f"{len(said)} labels and helps in Japanese")


def mixed_by_nla():
    """What NLA tracks mix is held too, and the strips are left alone."""
    thing = begin(rigs.of_bvh, KICK)
    animation = thing.animation_data
    track = animation.nla_tracks.new()
    strip = track.strips.new("kick", 5, animation.action)
    animation.action = None
    turning = bpy.data.actions.new("turning")
    animation.action = turning
    slot = turning.slots.new(id_type="OBJECT", name=thing.name) if hasattr(turning, "slots") else None
    if slot:
        animation.action_slot = slot
    for frame, value in ((1, 0.0), (92, 1.0)):
        stepping.new_curve(turning, slot, ("rotation_euler", 2), "").keyframe_points.insert(frame, value) if frame == 1 else \
            stepping.curves(turning, slot)[0].keyframe_points.insert(frame, value)
    action = find(thing)
    assert strip.action is not None and not track.mute and track.strips[:] == [strip]
    check_keys(action)
    held, same = check_held(thing, action)
    assert (held, action.name) == (96, "turning koma"), held
    say(f"NLA: {held} koma of a mix of two actions stand still, {same} drawings are its frames")


def slots():
    """Two armatures in one action: each is held by its own slot, and the other's take stays."""
    if "slots" not in bpy.types.Action.bl_rna.properties:
        return
    one = begin(rigs.of_bvh, KICK)
    shared = one.animation_data.action
    bpy.ops.import_anim.bvh(filepath=str(DATA / "swing.bvh"))
    two = bpy.context.active_object
    slot = shared.slots.new(id_type="OBJECT", name="two")
    for curve in list(stepping.curves(two.animation_data.action)):
        made = stepping.new_curve(shared, slot, (curve.data_path, curve.array_index), "")
        for point in curve.keyframe_points:
            made.keyframe_points.insert(*point.co)
    two.animation_data.action = shared
    two.animation_data.action_slot = slot
    before, own = all_keys(shared), {thing: thing.animation_data.action_slot.identifier for thing in (one, two)}
    first, second = (find(rigs.active(thing)) for thing in (one, two))
    assert first != second and all_keys(shared) == before
    for thing, action in ((one, first), (two, second)):
        rigs.active(thing)
        check_keys(action)
        check_held(thing, action)
        assert thing.animation_data.action_slot.identifier == own[thing]
    assert list(first[take.BEGINS]) != list(second[take.BEGINS]), "each has its own drawings"
    say("slots: two armatures in one action are held each by its own slot")


def importers():
    """A take of each importer ends in constant keys that stand still."""
    makers = {
        "FBX": lambda: rigs.of_fbx(KICK, FOLDER),
        "glTF": lambda: rigs.of_gltf(KICK, FOLDER),
        "VRM": lambda: rigs.of_vrm(KICK, FOLDER),
        "Rigify": lambda: rigs.of_rigify(KICK),
        "MMD": lambda: rigs.of_mmd(KICK),
    }
    for name, make in makers.items():
        thing = begin(make)
        action = find(thing)
        check_keys(action)
        held, _ = check_held(thing, action)
        clip = genga.findings.of(thing).sampled.clip
        keys = [marker.frame for marker in action.pose_markers]
        assert held >= 91 and len(keys) >= 8, (held, keys)
        say(f"{name}: {len(clip.names)} of {len(thing.data.bones)} bones, {len(keys)} genga, {held} koma stand still")
        (led_by_controls if name in LED else feet_held)(name, thing)


def main():
    print(f"Find Keys in Blender {bpy.app.version_string}")
    thing = begin(rigs.of_bvh, KICK)
    held_still(thing, find(thing))
    undone()
    knobs_and_marks()
    presets()
    feet_held("BVH", begin(rigs.of_bvh, KICK))
    ticked()
    told_kindly()
    in_japanese()
    mixed_by_nla()
    slots()
    os.environ.get("QUICK") or importers()
    genga.unregister()


addon.run(main)
