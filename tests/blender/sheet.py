"""python sheet.py: the sheet on the rig is the program's, with inserted poses, passages, loops, and keys with curves.

GENGA is the program.
"""

import os

import bpy
import numpy as np

import addon
import made
import rigs
from addon import DATA, refused, say
from genga_addon import curves, stepping, take
from made import begin, columns, find, genga, run

KICK, TENNIS = DATA / "kick.bvh", DATA / "tennis.bvh"
# Captures with a T-pose in front; kick.bvh where they are missing.
REAL = [addon.CLIPS / f"{name}.bvh" for name in ("cmu-09_01-run", "cmu-11_01-soccer-kick", "cmu-135_04-front-kick")]
HERE = [path for path in REAL if path.exists()] or [KICK, TENNIS, DATA / "swing.bvh"]


def sheet_of(thing):
    return genga.findings.of(thing).sheet()


def the_programs_sheet(clip):
    """The same clip has the same sheet on the rig and in the program, and an inserted pose is no genga."""
    wanted = run(clip, f"plain-{clip.stem}")
    thing = begin(rigs.of_bvh, clip)
    played = thing.animation_data.action
    before = made.all_keys(played)
    action = find(thing)
    found = sheet_of(thing)
    assert columns(found) == columns(wanted), clip.stem
    assert (found.first, found.length) == (wanted.first, wanted.length)
    begins, places = list(action[take.BEGINS]), list(action[take.PLACES])
    assert begins[0] == 1 + wanted.first and min(places) >= 1 + wanted.first, (begins[0], wanted.first)
    assert made.all_keys(played) == before and action != played and played.use_fake_user, "the take stays"
    if wanted.first:
        told = f"1 to {wanted.first} are" if wanted.first > 1 else "1 is"
        assert f"{told} no motion but an inserted pose" in thing.genga.told, thing.genga.told
        thing.genga.clean = False
        find(thing)
        assert sheet_of(thing).first == 0 and action[take.BEGINS][0] == 1, "a person wants the pose"
    say(f"{clip.stem}: {len(begins)} drawings as in the program's sheet, {wanted.first} frames of an inserted pose left out")


def mended():
    """A glitch is mended on the rig too, and said."""
    thing = begin(rigs.of_bvh, KICK)
    action = thing.animation_data.action
    turns = [curve for curve in stepping.curves(action) if curve.data_path.endswith('["LeftArm"].rotation_euler')]
    for curve in turns:
        curve.keyframe_points[80].co.y += 0.5
        curve.update()
    bpy.context.scene.timeline_markers.new("pin", frame=81)
    made_of = find(thing)
    begins = [begin for begin, place in zip(made_of[take.BEGINS], made_of[take.PLACES]) if place == 81]
    assert begins, "the frame is drawn"
    assert "glitches of the capture are mended (Clean Capture): 81" in thing.genga.told, thing.genga.told
    drawn = {curve.array_index: curve for curve in stepping.curves(thing.animation_data.action) if curve.data_path == turns[0].data_path}
    for curve in turns:
        beside = [curve.evaluate(frame) for frame in (80, 82)]
        assert min(beside) - 0.02 < drawn[curve.array_index].evaluate(begins[0]) < max(beside) + 0.02, beside
    say("a glitch is mended on the rig, and said")


def passages():
    """A marked range has settings of its own, as with the program's --within, and the rest stays as it is if asked."""
    thing = begin(rigs.of_bvh, KICK)
    scene = bpy.context.scene
    find(thing)
    refused("no range is marked", lambda: bpy.ops.genga.passage(what="ADD"))
    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 31, 60
    assert bpy.ops.genga.passage(what="ADD") == {"FINISHED"}
    scene.use_preview_range = False
    own = thing.genga.passages[0]
    assert (own.start, own.end) == (31, 60)
    own.on = "1"
    settings = [f"30..60:{name}" for name in ("spacing.on=1", "spacing.weight=0.3", "omission.naka_nashi=4%", "omission.koma_dori=1/3")]
    within = [word for setting in settings for word in ("--within", setting)]
    assert columns(sheet_of(thing)) == columns(run(KICK, "within", *within))
    thing.genga.outside = "SOURCE"
    own.on = "2-3"
    settings[0] = "30..60:spacing.on=2-3"
    within = [word for setting in settings for word in ("--within", setting)]
    assert columns(sheet_of(thing)) == columns(run(KICK, "outside", *within, "--outside", "source"))
    source, action = take.Take(thing), thing.animation_data.action
    for curve in source.curves():
        same = next(own for own in stepping.curves(action) if (own.data_path, own.array_index) == (curve.data_path, curve.array_index))
        for frame in (*range(1, 32), *range(61, 93)):
            assert same.evaluate(frame) == curve.evaluate(frame), (curve.data_path, frame)
    begins = list(action[take.BEGINS])
    assert len([begin for begin in begins if 31 <= begin < 61]) < 16, "the passage is on twos and threes"
    # Two markers are a range too.
    for frame in (70, 80):
        scene.timeline_markers.new("here", frame=frame).select = True
    for marker in scene.timeline_markers:
        marker.select = marker.name == "here"
    assert bpy.ops.genga.passage(what="ADD") == {"FINISHED"}
    assert (thing.genga.passages[1].start, thing.genga.passages[1].end) == (70, 80)
    assert bpy.ops.genga.passage(what="REMOVE") == {"FINISHED"}
    assert bpy.ops.genga.passage(what="REMOVE") == {"FINISHED"}
    assert columns(sheet_of(thing)) == columns(run(KICK, "without"))
    say("a marked range is a passage as in the program, and the rest stays as it is")


def joints(thing, names, frame):
    bpy.context.scene.frame_set(int(frame))
    drawn = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return np.array([drawn.matrix_world @ drawn.pose.bones[name].head for name in names])


def height_of(thing, names):
    """The height of the body as it stands, from the tips of its bones."""
    drawn = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    bones = [drawn.pose.bones[name] for name in names]
    ends = [drawn.matrix_world @ end for bone in bones for end in (bone.head, bone.tail)]
    return np.ptp(np.array(ends), axis=0).max()


def loops(clip, first, last):
    """The rounds of a loop are keys on the rig, and the body travels on as in limited.bvh."""
    thing = begin(rigs.of_bvh, clip)
    scene, own = bpy.context.scene, thing.genga
    own.frames, scene.use_preview_range = "SCENE", True
    scene.frame_preview_start, scene.frame_preview_end = first + 1, last + 1
    own.loop, own.cycles = True, 3
    action = find(thing)
    result, sheet = genga.findings.of(thing).result, sheet_of(thing)
    limited = result.limited
    rounds = [exposure.round for exposure in sheet.layers[0].exposures]
    assert max(rounds) >= 2 and sheet.length == len(limited) == 3 * result.report["koma"] // 3
    size = np.ptp(limited.positions[0], axis=0).max()
    per_koma = genga.findings.of(thing).sampled.rate / sheet.fps
    worst = 0.0
    shift = None
    for begin_at, exposure in zip(action[take.BEGINS], sheet.layers[0].exposures):
        stood = joints(thing, limited.names, begin_at)
        shift = limited.positions[exposure.koma] - stood if shift is None else shift
        worst = max(worst, np.abs(stood + shift[:1] - limited.positions[exposure.koma]).max() / size)
    way = np.linalg.norm(limited.positions[-1, 0] - limited.positions[0, 0]) / size
    assert worst < 1e-4, (clip.stem, worst)
    numbers = [marker.name for marker in action.pose_markers]
    assert numbers[: len(numbers) // 3] * 3 == numbers, numbers
    assert action.frame_range[1] - action.frame_range[0] > 3 * (last - first - per_koma)
    say(f"{clip.stem}: 3 rounds are keys, {way:.1f} bodies of travel as in limited.bvh, off by {worst:.1e}")


def no_round():
    thing = begin(rigs.of_bvh, DATA / "pitch.bvh")
    thing.genga.loop = True
    refused("a loop needs a round: the last pose is not the first", bpy.ops.genga.find_keys)


def with_curves(name, thing, percent):
    """Keys with curves are as close to the take as is asked, measured on the evaluated rig."""
    find(thing)
    played = take.Take(thing)
    before = made.all_keys(played.action, played.slot)
    thing.genga.curve_error = percent
    assert bpy.ops.genga.curves() == {"FINISHED"}
    action = thing.animation_data.action
    assert action[take.KIND] == take.KEYS and made.all_keys(played.action, played.slot) == before
    finding = genga.findings.of(thing)
    genga_frames = {frame + finding.sampled.start for frame in curves.genga_of(finding.sheet(), finding.sampled.clip)}
    types, kinds = {}, set()
    for curve in stepping.curves(action, getattr(thing.animation_data, "action_slot", None)):
        for point in curve.keyframe_points:
            types.setdefault(point.co.x, set()).add(point.type)
            kinds.add(point.interpolation)
    assert {frame for frame, own in types.items() if own == {"EXTREME"}} == genga_frames, types
    assert "BEZIER" in kinds <= {"BEZIER", "LINEAR"}, kinds
    first, last = int(min(types)), int(max(types))
    assert len(types) < 0.7 * (last - first), "few keys"
    names = finding.sampled.clip.names
    keyed = np.stack([joints(thing, names, frame) for frame in range(first, last + 1)])
    bpy.ops.genga.toggle()
    taken = np.stack([joints(thing, names, frame) for frame in range(first, last + 1)])
    height = height_of(thing, names)
    off = np.linalg.norm(keyed - taken, axis=2).max() / height
    assert off < percent / 100.0, (name, off)
    # Where there are keys, the rig stands as in the take.
    at = [int(frame) - first for frame in types]
    assert np.linalg.norm(keyed[at] - taken[at], axis=2).max() < 1e-4 * height
    said = thing.genga.told.splitlines()[-1]
    assert said.startswith(f"{len(types)} keys with curves, {len(types) - len(genga_frames)} beside the genga"), said
    say(f"{name}: {said}; joints {100.0 * off:.2f} % off")
    return len(types)


def all_curves():
    few, many = (with_curves("BVH", begin(rigs.of_bvh, KICK), percent) for percent in (5.0, 0.5))
    assert few < many, (few, many)
    os.environ.get("QUICK") or with_curves("Rigify", begin(rigs.of_rigify, KICK), 1.0)
    os.environ.get("QUICK") or with_curves("MMD", begin(rigs.of_mmd, KICK), 1.0)
    thing = begin(rigs.of_bvh, KICK)
    refused("this take has no sheet: find its keys first", bpy.ops.genga.curves)
    find(thing)
    thing.genga.leave_out = "*Hand"
    refused("other bones are left out now: find the keys first", bpy.ops.genga.curves)


def main():
    print(f"Sheet in Blender {bpy.app.version_string}")
    for clip in HERE:
        the_programs_sheet(clip)
    if HERE != REAL:
        say("LEFT OUT: the program's sheet of captures with a T-pose")
    mended()
    passages()
    loops(TENNIS, 0, 87)
    walk = addon.CLIPS / "cmu-07_01-walk.bvh"
    cycles = made.cycles(walk) if walk.exists() else []
    if cycles:
        loops(walk, *cycles[0])
    else:
        say(f"LEFT OUT: {walk.stem} does not loop")
    no_round()
    all_curves()
    genga.unregister()


addon.run(main)
