"""The built wheel: the same as the program, in Python's manners."""

import contextlib
import copy
import json
import math
import multiprocessing
import os
import pickle
import re
import signal
import struct
import subprocess
import sys
import threading
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

import genga

ROOT = Path(__file__).resolve().parents[2]
KICK = ROOT / "data" / "kick.bvh"
REAL = Path(os.environ.get("GENGA_CLIPS", ROOT.parent / "shared" / "data" / "bvh"))
PROGRAM = os.environ.get("GENGA", str(ROOT / "target" / "debug" / "genga"))
CLIPS = [
    "cmu-11_01-soccer-kick",
    "cmu-02_04-jump-balance",
    "cmu-131_03-start-hop-stop",
    "optitrack-arena-louise",
    "rokoko-jesse-dance",
]


@pytest.fixture(scope="module")
def clip():
    return genga.read(KICK)


def program(clip, out, *options):
    command = [PROGRAM, "run", str(clip), "--out", str(out), *options]
    subprocess.run(command, check=True, capture_output=True)


def same_files(result, out, *formats):
    for path in result.write(out / "python", *formats):
        name = path.relative_to(out / "python")
        assert path.read_bytes() == (out / "program" / name).read_bytes(), name
    assert result.recipe.to_toml() == (out / "program" / "recipe.toml").read_text(encoding="utf-8")


def told(call):
    """What a call returns, and its warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made = call()
    return made, [str(warning.message) for warning in caught]


@pytest.mark.parametrize("name", CLIPS)
def test_the_same_bytes_as_the_program_on_real_clips(name, tmp_path):
    path = REAL / f"{name}.bvh"
    if not path.exists():
        pytest.skip(f"LEFT OUT: the Python package does not look at {name}")
    program(path, tmp_path / "program", "--deliver", "xdts,vmd,glb,bvh-keys")
    formats = ["json", "csv", "remap", "bvh", "xdts", "vmd", "glb", "bvh-keys", "bars", "poses"]
    same_files(genga.run(genga.read(path)), tmp_path, *formats)


def test_settings_and_corrections_are_those_of_the_program(clip, tmp_path):
    options = ["--set", "keys.min_price=7.5", "--set", "spacing.on=3", "--pin", "30:wind-up", "--forbid", "50..60"]
    options += ["--deliver", "images,preview"]
    program(KICK, tmp_path / "program", *options)
    settings = {"keys": {"min_price": 7.5}, "spacing__on": 3}
    result = genga.run(clip, pins=[(30, "wind-up")], forbid=["50..60"], **settings)
    same_files(result, tmp_path, "json", "csv", "bvh", "images", "preview")
    assert "wind-up" in result.keys["name"]


def test_arrays_have_the_shapes_that_are_said(clip):
    frames, joints = len(clip), len(clip.names)
    assert clip.rotations.shape == (frames, joints, 4)
    assert clip.positions.shape == (frames, joints, 3)
    assert np.allclose(np.linalg.norm(clip.rotations, axis=2), 1.0)
    assert clip.rotations is clip.rotations, "made once"
    with pytest.raises(ValueError):
        clip.positions[0, 0, 0] = 1.0
    result = genga.run(clip)
    assert result.speeds.shape == result.filtered.shape == (frames, joints)
    assert result.speeds.flags.f_contiguous
    assert np.abs(result.filtered).max() < np.abs(result.speeds).max()


def test_positions_are_the_forward_kinematics_of_the_rotations(clip):
    def turned(rotation, vector):
        axis, w = rotation[:3], rotation[3]
        return vector + 2 * np.cross(axis, np.cross(axis, vector) + w * vector)

    def product(a, b):
        xyz = a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])
        return np.append(xyz, a[3] * b[3] - a[:3] @ b[:3])

    world = {}
    for joint, parent in enumerate(clip.parents):
        own = clip.rotations[40, joint]
        if parent < 0:
            world[joint] = own
        else:
            world[joint] = product(world[parent], own)
            place = clip.positions[40, parent] + turned(world[parent], clip.offsets[joint])
            assert np.allclose(place, clip.positions[40, joint], atol=1e-9), clip.names[joint]


def test_a_clip_from_arrays_is_the_same_motion(clip):
    made = genga.Clip(
        names=clip.names,
        parents=clip.parents,
        offsets=clip.offsets,
        rotations=clip.rotations,
        root=clip.positions[:, 0],
        rate=clip.rate,
    )
    assert np.allclose(made.positions, clip.positions, atol=1e-6)
    # End sites are not in the arrays, so that speeds are compared and not keys.
    assert np.allclose(genga.run(made).speeds, genga.run(clip).speeds, atol=1e-6)
    assert np.allclose(genga.read(made.to_bvh().encode()).positions, clip.positions, atol=1e-6)


def arrays_of(clip):
    """All that a clip says of itself."""
    names = ["name", "names", "parents", "offsets", "rotations", "translations", "tips", "rate", "first", "up", "metres"]
    return {name: getattr(clip, name) for name in names}


def real(*names):
    paths = [REAL / f"{name}.bvh" for name in names]
    return [path for path in paths if path.exists()]


def test_arrays_out_and_in_again_give_the_same_keys():
    for path in [KICK, ROOT / "data" / "kuroda-pitch.bvh", *real(*CLIPS[:2])]:
        clip = genga.read(path)
        made = genga.Clip(**arrays_of(clip))
        assert made.name == clip.name == path.stem
        asked, wanted = genga.run(made).keys, genga.run(clip).keys
        assert asked["frame"].tolist() == wanted["frame"].tolist(), path.name
        assert asked["reason"].tolist() == wanted["reason"].tolist(), path.name


def test_a_pickled_copy_is_exact_and_one_of_the_attributes_is_not(clip):
    result = genga.run(clip)
    assert told(lambda: genga.evaluate(pickle.loads(pickle.dumps(clip)), result))[1] == []
    assert told(lambda: genga.evaluate(genga.Clip(**arrays_of(clip)), result))[1] != []
    assert "differs by rounding" in " ".join(genga.Clip.__doc__.split())


def test_what_a_clip_says_of_itself_is_what_it_was_made_of(clip):
    tips = np.full((len(clip.names), 2, 3), np.nan)
    tips[-1] = [(0, -7, 0), (1, 0, 0)]
    made = genga.Clip(**{**arrays_of(clip), "tips": tips, "first": 12, "up": "z", "metres": 0.01})
    assert np.array_equal(made.tips, tips, equal_nan=True) and made.to_bvh().count("End Site") == 2
    assert (made.first, made.up, made.metres) == (12, "z", 0.01)
    assert genga.Clip(**{**arrays_of(clip), "name": "take 1.b"}).name == "take 1.b"
    assert (genga.read(KICK, name="other").name, genga.read(KICK.read_bytes()).name) == ("other", "clip")
    assert np.allclose(made.translations, clip.translations, atol=1e-9)
    assert made.translations is made.translations and not made.translations.flags.writeable
    assert (clip.up, clip.metres, clip.tips.shape) == (None, None, (len(clip.names), 3))
    with pytest.raises(genga.Error, match="up is x, y or z"):
        genga.Clip(**{**arrays_of(clip), "up": "w"})


@pytest.mark.parametrize("name", ["a/b", "../../b", "a\\b", "/b", "..", ".", ""])
def test_nothing_is_written_outside_of_the_folder(name, clip, tmp_path):
    for make in (lambda: genga.Clip(**{**arrays_of(clip), "name": name}), lambda: genga.read(KICK, name=name)):
        with pytest.raises(genga.Error, match="^name: expected a name without folders"):
            make()
    out = tmp_path / "a" / "out"
    for path in genga.run(clip, name=name).write(out, "json", "xdts", "cut"):
        assert out in Path(os.path.normpath(path)).parents, path


def test_joints_that_travel_and_tips_are_kept(clip):
    hips = 1
    travels = np.tile(clip.offsets, (len(clip), 1, 1))
    travels[:, 0] = clip.positions[:, 0]
    travels[:, hips, 0] += np.linspace(0, 30, len(clip))
    tips = np.full((len(clip.names), 3), np.nan)
    tips[-1] = (0, -7, 0)
    arrays = {"names": clip.names, "parents": clip.parents, "offsets": clip.offsets, "rotations": clip.rotations}
    made = genga.Clip(**arrays, translations=travels, tips=tips, rate=clip.rate)
    plain = genga.Clip(**arrays, root=clip.positions[:, 0], rate=clip.rate)
    moved = np.linalg.norm(made.positions - plain.positions, axis=2)
    below = [joint for joint in range(len(clip.names)) if clip.names[joint].startswith(clip.names[hips])]
    assert np.allclose(moved[-1, below], 30, atol=1e-6) and not moved[:, 0].any()
    text = made.to_bvh()
    assert text.count("Xposition") == 2 and "OFFSET 0 -7 0" in text
    with pytest.raises(genga.Error, match="neither root nor translations .* give one of them"):
        genga.Clip(**arrays, rate=clip.rate)
    with pytest.raises(genga.Error, match="both set the positions: give one of them"):
        genga.Clip(**arrays, root=clip.positions[:, 0], translations=travels, rate=clip.rate)


def test_arrays_are_cleaned_as_a_file_is(clip):
    posed = arrays_of(clip)
    still = np.zeros((3, *clip.rotations.shape[1:])) + (0, 0, 0, 1)
    posed["rotations"] = np.concatenate([still, clip.rotations])
    posed["translations"] = np.concatenate([np.repeat(clip.translations[:1], 3, axis=0), clip.translations])
    made = genga.Clip(**posed).cleaned()
    assert (made.first, len(made)) == (3, len(clip))
    assert [told["code"] for told in made.warnings] == ["W_LEAD_IN"]
    assert (genga.run(made).keys["frame"] - 3).tolist() == genga.run(clip).keys["frame"].tolist()
    kept = genga.Clip(**posed).cleaned(keep_lead_in=True, trim=(1, 40))
    assert (kept.first, len(kept), kept.warnings) == (1, 39, [])
    for path in real(*CLIPS[:2]):
        raw, wanted = genga.read(path, keep_lead_in=True, keep_glitches=True), genga.read(path)
        found = raw.cleaned()
        assert (found.first, len(found), found.warnings) == (wanted.first, len(wanted), wanted.warnings), path.name
        assert np.array_equal(found.rotations, wanted.rotations), path.name


def test_motions_are_measured_against_each_other(clip):
    assert clip.distances(clip).tolist() == [0.0] * len(clip)
    moved = arrays_of(clip)
    height = np.ptp(clip.positions[0], axis=0).max()
    moved["translations"] = clip.translations.copy()
    moved["translations"][40, 0, 0] += 0.1 * height
    off = clip.distances(genga.Clip(**moved))
    assert np.flatnonzero(off > 1e-9).tolist() == [40] and 0.08 < off[40] < 0.12
    with pytest.raises(genga.Error, match="the same joints and frames"):
        clip.distances(clip.cleaned(trim=(0, 40)))


def test_curves_through_keys_come_close_to_the_samples():
    frames = np.arange(31.0)
    samples = np.stack([frames**2, np.sin(frames / 4), np.full(31, 5.0)], axis=1)
    keys = [0, 9, 20, 30]
    found = genga.tangents(keys, samples)
    assert found.shape == (4, 3) and np.allclose(found[:, 0], 2.0 * frames[keys], atol=0.05)
    assert np.allclose(found[:, 2], 0.0)
    for wrong in ([0], [0, 0, 30], [0, 31]):
        with pytest.raises(genga.Error, match="two or more of the 31 frames"):
            genga.tangents(wrong, samples)
    with pytest.raises(genga.Error, match="frames, channels"):
        genga.tangents(keys, frames)


def test_rounds_are_those_of_the_program():
    tennis = ROOT / "data" / "tennis.bvh"
    said = subprocess.run([PROGRAM, "split", str(tennis), "--cycles"], check=True, capture_output=True, encoding="utf-8").stdout
    found = genga.read(tennis).cycles()
    assert len(found["first"]) > 0
    for first, last in zip(found["first"], found["last"]):
        assert f"{first}..{last + 1} " in said, said


def test_targets_are_those_of_the_program(clip, tmp_path):
    program(KICK, tmp_path / "program", "--keys", "9", "--drawings-per-second", "6")
    result = genga.run(clip, targets={"keys": 9, "drawings_per_second": 6, "max_error": None})
    same_files(result, tmp_path, "json", "csv")
    assert [told["target"] for told in result.outcomes] == ["keys", "drawings_per_second"]
    assert result.outcomes[0]["reached"] == 9 and result.outcomes[0]["why"] is None
    with pytest.raises(genga.Error, match="no such target"):
        genga.run(clip, targets={"frames": 9})


@pytest.mark.parametrize(
    "path, keys, corrections, says",
    [
        (REAL / "cmu-09_01-run.bvh", None, [], "W_LEAD_IN"),
        (REAL.parent / "keyed" / "db-mecha_2903d-death.bvh", 9, [], "W_BODY_GUESS"),
        (KICK, None, ["--move", "3:33", "--forbid", "4", "--hold", "4:9"], "none was moved to 33"),
        (KICK, 500, [], "500"),
    ],
)
def test_the_notes_of_a_report_are_those_of_the_program(path, keys, corrections, says, tmp_path):
    if not path.exists():
        pytest.skip(f"LEFT OUT: the Python package does not look at {path.name}")
    asked = ["--keys", str(keys)] if keys else []
    program(path, tmp_path / "program", *asked, *corrections, "--deliver", "json")
    told = json.loads((tmp_path / "program" / "report.json").read_text(encoding="utf-8"))
    own = dict(moves=[(3, 33)], forbid=[4], holds=[(4, 9)]) if corrections else {}
    result = genga.run(path, targets={"keys": keys}, **own)
    notes = [in_python(note) for note in told["notes"]]
    assert result.report["notes"] == notes and says in " ".join(notes)
    assert not any("--" in note for note in result.report["notes"])
    assert pickle.loads(pickle.dumps(result)).report == result.report


def test_the_sheet_covers_every_koma(clip):
    sheet = genga.run(clip).sheet
    begins, koma = sheet.exposures["begin"], sheet.exposures["koma"]
    assert begins[0] == 0 and np.array_equal(begins[1:], np.cumsum(koma)[:-1])
    assert koma.sum() == sheet.koma == 92
    assert set(sheet.drawings["role"]) == {"genga", "inbetween", "end"}
    assert sheet.exposures["drawing"].max() < len(sheet.drawings["drawing"])


def test_the_turns_of_the_body_and_of_joints_are_the_programs(clip):
    result = genga.run(clip)
    found, first = result.body_turns, clip.first
    turns = found["frame"][found["kind"] == "turn"]
    assert len(turns) == genga.study(clip, x=("rate", [24]), measures=["turns"])["turns"][0]
    assert result.dips.shape == result.evidence.shape == (1, len(clip))
    assert result.evidence[0, turns - first].tolist() == found["strength"][found["kind"] == "turn"].tolist()
    peaks = result.dips[0, turns - first]
    assert (peaks >= result.dips[0, turns - first - 1]).all() and (peaks >= result.dips[0, turns - first + 1]).all()
    at = {frame: e for frame, e in zip(range(first, first + len(clip)), result.evidence[0])}
    keys = result.keys
    of_turns = keys["reason"] == "turn"
    assert np.allclose([at[frame] for frame in keys["frame"][of_turns]], keys["strength"][of_turns])
    limbs = genga.run(clip, layers="limbs")
    assert len(limbs.dips) == len(set(limbs.body_turns["layer"])) > 1
    out = subprocess.run([PROGRAM, "keys", str(KICK), "--per-joint"], check=True, capture_output=True, text=True).stdout
    header, *rows = [line.split(",") for line in out.splitlines()]
    assert header == list(result.turns) and [clip.names[joint] for joint in result.turns["joint"]] == [row[0] for row in rows]
    assert np.allclose(result.turns["speed_deg_s"], [float(row[3]) for row in rows])


def test_tables_go_into_pandas(clip):
    pandas = pytest.importorskip("pandas")
    result = genga.run(clip)
    keys = pandas.DataFrame(result.keys)
    assert list(keys.columns) == ["layer", "frame", "strength", "price", "reason", "name", "joints"]
    assert keys.frame.is_monotonic_increasing
    assert len(result.why) == len(pandas.DataFrame(result.sheet.drawings))
    assert len(pandas.DataFrame(result.turns)) > len(keys)


def test_tables_go_into_polars(clip):
    polars = pytest.importorskip("polars")
    result = genga.run(clip)
    for table in (result.keys, result.turns, result.sheet.drawings, result.sheet.exposures, genga.study(clip)):
        made = polars.DataFrame(table)
        assert made.columns == list(table) and len(made) == len(next(iter(table.values())))
    assert polars.DataFrame(result.keys)["frame"].to_list() == result.keys["frame"].tolist()


def test_a_recipe_is_a_mapping_with_the_names_of_its_file():
    recipe = genga.Recipe(filter={"width": "0.2s"})
    assert recipe["filter.width"] == "0.2s" and recipe["rate"] == 24
    assert genga.Recipe.parse(recipe.to_toml()) == recipe != genga.Recipe()
    assert dict(recipe) == dict(recipe.items()) and len(recipe) == len(list(recipe))
    recipe["keys.per_second"] = float("inf")
    recipe.update({"rate": 12}, spacing__on="2-3")
    assert (recipe["keys.per_second"], recipe["rate"]) == (float("inf"), 12)
    del recipe["rate"]
    assert recipe["rate"] == 24
    with pytest.raises(KeyError):
        recipe["rates"]
    with pytest.raises(genga.Error, match="filter.width"):
        recipe["filter.width"] = -1


def bounds(knob):
    """Numbers in words: a range says its ends, and whether they are in it, as `0 to below 1`."""
    words = knob["takes"]
    ends = [("above " not in words, knob["least"]), ("below" not in words, knob["most"])]
    return [(is_in, end) for is_in, end in ends if math.isfinite(end)]


def test_knobs_say_what_the_recipe_takes():
    knobs = genga.knobs()
    recipe = genga.Recipe()
    assert [knob["name"] for knob in knobs] == list(recipe)
    assert {knob["who"] for knob in knobs} == {"animator", "researcher"}
    for knob in knobs:
        name, kind = knob["name"], knob["kind"]
        assert knob["default"] == recipe[name] and knob["help"] and knob["japanese_help"] and knob["japanese"], name
        assert (kind == "choice") == bool(knob["choices"]), name
        for choice in knob["choices"]:
            genga.Recipe(**{name: choice})
        if kind in ("number", "span"):
            assert f"{knob['least']:g}" in knob["takes"], knob
        for is_in, end in bounds(knob) if kind == "number" else []:
            inside = contextlib.nullcontext() if is_in else pytest.raises(genga.Error)
            with inside:
                genga.Recipe(**{name: round(end) if knob["whole"] else end})
        if kind == "number":
            least, most = knob["slider"]
            assert knob["least"] <= least < most <= knob["most"], name
            with pytest.raises(genga.Error):
                genga.Recipe(**{name: -1})
        if knob["optional"]:
            assert genga.Recipe(**{name: None})[name] is None
    speaks = {knob["name"]: knob for knob in knobs}
    assert (speaks["rate"]["unit"], speaks["rate"]["whole"]) == ("koma a second", False)
    assert speaks["spacing.weight"]["most"] == 1.0 and speaks["keys.per_second"]["most"] == math.inf


def test_a_sheet_says_how_long_it_is(clip):
    result = genga.run(clip, omission={"naka_nashi": 4})
    assert repr(result.sheet) == repr(result).replace("Result kick", "Sheet")
    limbs = genga.run(clip, layers="limbs")
    assert repr(limbs.sheet) == repr(limbs).replace("Result kick", "Sheet")


@pytest.mark.parametrize("name", ["kick", *CLIPS])
def test_keys_and_drawings_have_the_same_price(name):
    path = KICK if name == "kick" else REAL / f"{name}.bvh"
    if not path.exists():
        pytest.skip(f"LEFT OUT: the Python package does not look at {name}")
    result = genga.run(path)
    drawings = result.sheet.drawings
    kept = drawings["role"] != "inbetween"
    assert drawings["price"][kept].tolist() == result.keys["price"].tolist()
    assert np.isnan(drawings["price"][~kept]).all()
    assert np.isinf(result.keys["price"]).any()


def test_every_format_has_its_method(clip):
    result = genga.run(clip)
    for form in genga.formats():
        made = getattr(result, "to_" + form["name"].replace("-", "_"))()
        suffixes = {Path(name).suffix for name in made}
        assert {Path(name).suffix for name in form["files"]} <= suffixes, form["name"]
        assert all(made.values()), form["name"]


def test_the_stepped_motion_is_that_of_its_file(clip):
    result = genga.run(clip, feet="held", root="ones")
    stepped, sheet = result.limited, result.sheet
    assert (len(stepped), stepped.rate) == (sheet.koma, sheet.rate)
    assert stepped.to_bvh().encode() == result.to_bvh()["limited.bvh"]
    held = genga.run(clip).limited.rotations
    for begin, koma in zip(sheet.exposures["begin"], sheet.exposures["koma"]):
        assert (held[begin : begin + koma] == held[begin]).all()


def test_layers_can_be_named_from_python(clip):
    layers = [{"name": "A", "joints": ["Hips"]}, {"name": "B", "joints": ["*Arm*", "*Hand*"]}]
    assert set(genga.run(clip, layers=layers).keys["layer"]) == {"A", "B"}


def test_the_text_of_a_bvh_is_read_and_no_text_is_repeated(clip):
    text = clip.to_bvh()
    assert genga.read(text).to_bvh() == text
    assert genga.run(text).to_json() == genga.run(genga.read(text.encode())).to_json()
    result = genga.run(clip)
    for call in (lambda: genga.read("# " + text), lambda: genga.evaluate(clip, result, reference="# " + text)):
        with pytest.raises(OSError, match="given as bytes") as raised:
            call()
        assert len(str(raised.value)) < 300 and len(raised.value.filename) == 80


def test_errors_say_file_line_and_column(tmp_path):
    broken = tmp_path / "broken.bvh"
    broken.write_text(KICK.read_text().replace("JOINT", "JIONT", 1))
    with pytest.raises(genga.Error) as caught:
        genga.read(broken)
    error = caught.value
    assert error.file == str(broken) and error.line > 1 and error.column >= 1
    assert str(error).startswith(f"{broken}:{error.line}:{error.column}: ")
    with pytest.raises(FileNotFoundError):
        genga.read(tmp_path / "nothing.bvh")
    with pytest.raises(genga.Error) as caught:
        genga.Recipe.parse("rate = 24\n[filter]\nwidht = 3\n")
    assert (caught.value.file, caught.value.line) == (None, 3)
    with pytest.raises(genga.Error, match="pinned frame 1000 is not in the clip"):
        genga.run(genga.read(KICK), pins=[1000])


@pytest.mark.parametrize(
    "corrections, says",
    [
        ({"pins": [-3]}, r'pins: expected a frame, as in 42, .* found -3'),
        ({"pins": ["a"]}, 'pins: expected FRAME.* found "a"'),
        ({"forbid": [(5, "a")]}, r"forbid: expected a frame or a range .* found \(5, 'a'\)"),
        ({"moves": [4]}, "moves: expected two frames, .* found 4"),
        ({"holds": [(4, 1.5)]}, r"holds: expected a frame and a number of koma, .* found \(4, 1.5\)"),
    ],
)
def test_wrong_corrections_are_told_in_python(corrections, says, clip):
    with pytest.raises(genga.Error, match=says):
        genga.run(clip, **corrections)


def test_a_pin_has_a_frame_a_name_and_a_weight(clip):
    def pinned(*pins):
        recipe = genga.Recipe()
        recipe.correct(pins=pins)
        return recipe.to_toml()

    assert pinned((40, "a", 0.5)) == pinned("40:a@0.5") != pinned((40, "a"))
    for wrong in [(40,), (40, 0.5), (40, None), (40, "a", "b"), (40, "a", 0.5, 1), ()]:
        with pytest.raises(genga.Error, match="pins: expected a frame, as in 42, .* found "):
            pinned(wrong)


@pytest.mark.parametrize(
    "function, arguments, says",
    [
        ("run", {"forbidden": [4]}, "forbidden: .*; did you mean forbid[?]"),
        ("run", {"pin": [4]}, "pin: .*; did you mean pins[?]"),
        ("run", {"rat": 12}, "rat: .*; did you mean rate[?]"),
        ("run", {"settngs": 12}, "settngs: there is no such setting of the method; genga.knobs.. lists them, and help"),
        ("study", {"stability": True}, "stability: there is no such setting of the method; genga.knobs.. lists them"),
        ("study", {"measure": ["union"]}, "measure: .*; did you mean measures[?]"),
        ("study", {"x": ("nose", [1])}, "nose: .*; did you mean noise[?]"),
        ("study", {"x": ("noise.sed", [1])}, "noise.sed: .*; did you mean noise.seed[?]"),
        ("study", {"nose": 0.1}, "nose: .*; did you mean noise[?]"),
        ("study", {"noise__sed": 1}, "noise.sed: .*; did you mean noise.seed[?]"),
        ("study", {"noise": 0.1}, r"noise: it is no setting but an axis of a study, as in x=\("),
        ("study", {"x": ("filter.width", 10)}, "filter.width: expected a list of values"),
        ("compare", {"nois": 0.1}, "nois: .*; did you mean noise[?]"),
        ("Recipe", {"keys__weights": 2}, "keys.weights: .* keys.weights.JOINT=2"),
        ("Recipe", {"keys": {"weights": {"Hips": "x"}}}, "keys.weights"),
    ],
)
def test_an_unknown_argument_is_told_what_may_be_meant(function, arguments, says, clip):
    given = [] if function == "Recipe" else [clip]
    with pytest.raises(genga.Error, match=says) as raised:
        getattr(genga, function)(*given, **arguments)
    assert "--" not in str(raised.value)


@pytest.mark.parametrize(
    "arguments, says",
    [
        ({"target": {"keys": 9}}, r'^target.keys: .*; did you mean targets\? as in targets=\{"keys": 9\}'),
        ({"keys": 9}, r'^keys: .*; a number of keys is asked for by targets=\{"keys": 9\}'),
        ({"keys": {"count": 9}}, "^keys.count: .*; a number of keys is asked for by targets="),
        ({"keys": {"keys": 9}}, "^keys.keys: .*; a number of keys is asked for by targets="),
        ({"keys": {"min_prise": 9}}, "^keys.min_prise: .*; did you mean keys.min_price"),
        ({"max_error": 5}, r'^max_error: it is no setting but a target, as in targets=\{"max_error": 8\}'),
        ({"targets": 9}, r'^targets: expected a dict of targets, as in \{"keys": 9\}, found 9'),
        ({"targets": {1: 9}}, "^targets: expected a dict of targets"),
        ({"targets": {"keys": "9"}}, "^keys: expected a number, found '9'"),
    ],
)
def test_a_target_that_is_asked_for_otherwise_is_told_how(arguments, says, clip):
    for run in (lambda: genga.run(clip, **arguments), lambda: genga.run(clip).again(**arguments)):
        with pytest.raises(genga.Error, match=says):
            run()


def test_a_new_run_is_told_its_own_arguments(clip):
    with pytest.raises(genga.Error, match="target: .*; did you mean targets[?]"):
        genga.run(clip).again(target=9)


def test_options_of_the_program_are_told_as_arguments():
    text = KICK.read_text(encoding="utf-8")
    row = text.rstrip().rsplit("\n", 1)[1]
    with pytest.raises(genga.Error, match="; repair=True holds the value before it"):
        genga.read(text.replace(row, row.replace(row.split()[5], "nan", 1)).encode())
    with pytest.raises(genga.Error, match="; fps "):
        genga.read("\n".join("Frame Time: 24" if "Frame Time" in line else line for line in text.splitlines()).encode())


def in_python(text):
    """Any text as an error of the package tells it: an axis that is none."""
    arrays = dict(names=["a"], parents=[-1], offsets=np.zeros((1, 3)), root=np.zeros((1, 3)), rate=24.0)
    with pytest.raises(genga.Error) as raised:
        genga.Clip(**arrays, rotations=np.array([[[0.0, 0.0, 0.0, 1.0]]]), up=text)
    return str(raised.value).removeprefix("up is x, y or z, not ")


def messages_with_options():
    """All text in the library that names an option of the program, but that of work that Python does not do."""
    of_the_program = ["mp4", "marked", "into", "pins", "retimed", "blank"]
    places = [ROOT / "src", *(ROOT / "crates" / f"genga-{name}" / "src" for name in ("files", "lab", "read"))]
    for path in sorted(path for place in places for path in place.rglob("*.rs")):
        if "tests" in str(path) or {path.stem, path.parent.name} & {*of_the_program}:
            continue
        text = path.read_text(encoding="utf-8").split("#[cfg(test)]")[0]
        text = re.sub(r"\\\n\s*", "", re.sub(r"(?m)^\s*//.*$", "", text))
        for message in re.findall(r'"((?:[^"\\\n]|\\.)*)"', text):
            if re.search(r"--[a-z]|`genga |genga [a-z]+ --|genga inspect", message) and not message.startswith("as --"):
                yield path, message


def test_no_message_names_an_option_of_the_program():
    found = list(messages_with_options())
    assert len(found) > 30
    for path, message in found:
        told = in_python(message)
        assert not re.search(r"--[a-z]|`genga |genga inspect|genga split", told), (path.name, told)


def test_the_way_out_of_a_message_is_there(clip, tmp_path):
    passages = [{"frames": [20, 40], "spacing": {"on": 1}}]
    assert "frames = [20, 40]" in genga.run(clip, passages=passages, outside="source").recipe.to_toml()
    with pytest.raises(genga.Error, match="outside: .* as in passages="):
        genga.run(clip, outside="source")
    with pytest.raises(genga.Error, match="^passages: (?!there is no such setting)"):
        genga.run(clip, passages=[{"spacing": {"on": 1}}])
    with pytest.raises(genga.Error, match="^cycles: .*; loop=True makes one$"):
        genga.run(clip, cycles=2)
    with pytest.raises(genga.Error, match=r"^max_error: must be above 0"):
        genga.run(clip, targets={"max_error": -1})
    assert genga.read(KICK, up="z").up == "z" and genga.read(KICK).up is None
    with pytest.raises(FileNotFoundError, match="none.pmx"):
        genga.read(genga.run(clip).to_vmd()["kick.vmd"], skeleton=tmp_path / "none.pmx")


@pytest.mark.parametrize("trim", [(-1, 5), "10..20", (10,), 7, (1.5, 9)])
def test_a_wrong_trim_is_told_as_such(trim, clip):
    for read in (lambda: genga.read(KICK, trim=trim), lambda: clip.cleaned(trim=trim)):
        with pytest.raises(genga.Error, match=r"^trim: expected two frames, .* as in \(10, 50\), found "):
            read()


def test_a_list_of_two_frames_trims_too(clip):
    assert len(genga.read(KICK, trim=[10, 50])) == len(clip.cleaned(trim=np.array([10, 50]))) == 40


def test_what_cannot_be_written_is_told(clip, tmp_path):
    result, file = genga.run(clip), tmp_path / "file"
    file.write_text("")
    with pytest.raises(genga.Error, match=r"^write: no format is named; genga.formats\(\) lists them"):
        result.write(tmp_path)
    with pytest.raises(genga.Error, match="^mp4: only the program writes it$"):
        result.write(tmp_path, "mp4")
    with pytest.raises(OSError) as raised:
        result.write(file, "json")
    assert raised.value.filename == str(file)


def test_a_sheet_is_evaluated_from_its_path(clip, tmp_path):
    result = genga.run(clip)
    path = next(path for path in result.write(tmp_path, "json") if path.name == "sheet.json")
    wanted = genga.evaluate(clip, result)
    for sheet in (path, str(path), path.read_bytes(), path.read_text(encoding="utf-8")):
        assert genga.evaluate(clip, sheet) == wanted
    with pytest.raises(FileNotFoundError):
        genga.evaluate(clip, "nothing.json")
    with pytest.raises(TypeError, match="expected a genga.Result, "):
        genga.evaluate(clip, result.to_csv())


def test_measures_are_a_list_or_text(clip):
    same_table(genga.study(clip, measures="union, total"), genga.study(clip, measures=["union", "total"]))
    with pytest.raises(genga.Error, match="^measures: expected one of turns, "):
        genga.study(clip, measures=["unoin"])


def test_wrong_arrays_are_refused_in_words(clip):
    good = dict(names=["a", "b"], parents=[-1, 0], offsets=np.zeros((2, 3)), root=np.zeros((5, 3)), rate=30.0)
    unit = np.tile([0.0, 0.0, 0.0, 1.0], (5, 2, 1))
    assert len(genga.Clip(**good, rotations=unit)) == 5
    with pytest.raises(genga.Error, match="rotations has the shape"):
        genga.Clip(**good, rotations=unit[:, :1].copy())
    with pytest.raises(genga.Error, match="unit quaternion"):
        genga.Clip(**good, rotations=unit * 0.0)
    with pytest.raises(genga.Error, match="comes before its parent"):
        genga.Clip(**{**good, "parents": [1, -1]}, rotations=unit)
    with pytest.raises(genga.Error, match="-2 is no parent"):
        genga.Clip(**{**good, "parents": [-1, -2]}, rotations=unit)
    with pytest.raises(genga.Error, match=r"parents: expected whole numbers, .*astype\(int\), found array"):
        genga.Clip(**{**good, "parents": np.array([-1.0, 0.0])}, rotations=unit)
    with pytest.raises(genga.Error, match="needs a joint and a frame"):
        genga.Clip(**{**good, "root": np.zeros((0, 3))}, rotations=unit[:0])
    wrong = {"parents": [-1], "offsets": np.zeros((2, 2)), "root": np.zeros((4, 3)), "tips": np.zeros((3, 3))}
    wrong["translations"] = np.zeros((5, 1, 3))
    for name, array in wrong.items():
        arrays = {**good, "rotations": unit, name: array}
        if name == "translations":
            del arrays["root"]
        with pytest.raises(genga.Error, match=f"{name} has the shape"):
            genga.Clip(**arrays)
    for name in ("rate", "metres"):
        for number in (0.0, -1.0, math.nan, math.inf):
            with pytest.raises(genga.Error):
                genga.Clip(**{**good, name: number}, rotations=unit)


@pytest.mark.parametrize(
    "name, shape, at, says",
    [
        ("offsets", (2, 3), (1, 2), "offsets of b: nan is not a length"),
        ("rotations", (5, 2, 4), (3, 1, 0), "row 3: the rotation of b has length NaN"),
        ("root", (5, 3), (4, 1), "root, row 4: nan is not a length"),
        ("translations", (5, 2, 3), (2, 1, 1), "translations of b, row 2: nan is not a length"),
        ("tips", (2, 3), (0, 1), "a tip is three numbers, or three NaN"),
    ],
)
def test_no_clip_is_made_of_what_is_not_a_number(name, shape, at, says):
    arrays = dict(names=["a", "b"], parents=[-1, 0], offsets=np.zeros((2, 3)), root=np.zeros((5, 3)), rate=30.0)
    arrays["rotations"] = np.tile([0.0, 0.0, 0.0, 1.0], (5, 2, 1))
    if name == "translations":
        del arrays["root"]
    arrays[name] = np.array(arrays.get(name, np.zeros(shape)))
    genga.Clip(**arrays)
    arrays[name][at] = np.nan
    with pytest.raises(genga.Error, match=f"(?i){says}"):
        genga.Clip(**arrays)
    arrays[name][at] = 1e300
    with pytest.raises(genga.Error):
        genga.Clip(**arrays)


def test_a_study_is_the_programs(clip, tmp_path):
    table = genga.study(clip)
    out = subprocess.run([PROGRAM, "study", str(KICK), "--measure", "union,total"], check=True, capture_output=True)
    lines = [line.split(",") for line in out.stdout.decode().splitlines()]
    header, rows = lines[0], lines[1:]
    for measure in ("union", "total"):
        at = header.index(measure)
        assert [float(row[at]) for row in rows] == table[measure].tolist()
    own = genga.study(clip, x=("spacing.on", [1, 2, 3]), measures=["drawings"])
    assert own["spacing.on"].tolist() == [1, 2, 3] and own["drawings"][0] > own["drawings"][2]


def test_a_study_counts_what_the_program_counts(clip):
    asked = {"spacing.on": "1,2", "omission.naka_nashi": "0,2,4", "filter.width": "10,20", "": ""}
    for name, values in asked.items():
        axis = [f"--x={name}={values}"] if name else []
        out = subprocess.run([PROGRAM, "study", str(KICK), *axis], check=True, capture_output=True, text=True)
        header, *rows = [line.split(",") for line in out.stdout.splitlines()]
        table = genga.study(clip, x=(name, values)) if name else genga.study(clip)
        measures = list(table)[1 if name else 2 :]
        assert [column for column in header if column in measures] == measures and len(measures) >= 5, name
        assert not set(header[-len(measures) :]) - set(measures), name
        for measure in measures:
            of_program = [float(row[header.index(measure)]) for row in rows]
            assert np.allclose(of_program, table[measure], atol=1e-3), (name, measure)
    assert "drawings" in genga.study(clip, x=("spacing.on", [1, 2])) and "drawings" not in genga.study(clip)


@pytest.mark.parametrize(
    "axes, settings",
    [
        ({}, {"filter__width": 50}),
        ({"x": ("keys.min_price", [5])}, {"keys__min_price": 99}),
        ({"x": ("rate", [12]), "y": ("filter.width", [5])}, {"filter": {"width": 50}}),
    ],
)
def test_a_setting_that_a_study_varies_is_refused(axes, settings, clip):
    with pytest.raises(genga.Error, match=r"(filter.width|keys.min_price): a study varies it already"):
        genga.study(clip, **axes, **settings)


def test_a_study_names_its_recipe(clip):
    width = ("filter.width", [10, 20, 30])
    table = genga.study(clip)
    assert isinstance(table, genga.Study) and isinstance(table, dict)
    assert table.recipe == genga.study(clip, per_joint=True).recipe == genga.Recipe.table_1()
    assert genga.study(clip, x=width).recipe == genga.Recipe()
    assert genga.study(clip, x=width, rate=12).recipe == genga.Recipe(rate=12)
    assert pickle.loads(pickle.dumps(table)).recipe == table.recipe


def same_table(a, b):
    assert list(a) == list(b)
    for name in a:
        assert a[name].tolist() == b[name].tolist(), name


def test_clips_of_several_rates_are_told_in_seconds(clip):
    fast = genga.read(KICK, fps=120)
    table, notes = told(lambda: genga.study([clip, fast]))
    for says in ["0.417s, 0.833s, 1.25s at 24 a second", "0.083s, 0.167s, 0.25s at 120 a second"]:
        assert any(note.startswith("filter.width: 10, 20, 30 frames are ") and says in note for note in notes), notes
    assert table.notes == notes
    one, notes = told(lambda: genga.study(clip))
    assert len(one.notes) == 2 and notes == []


def test_the_same_axes_are_the_same_study_however_they_are_given(clip):
    table = genga.study(clip)
    width, persistence = "filter.width", "turns.persistence"
    for values in ("10,20,30", "10..30:10", [10, 20, 30], np.array([10, 20, 30])):
        same_table(genga.study(clip, x=(width, values), y=(persistence, [5, 10])), table)
        same_table(genga.study(clip, x={width: values}, y={persistence: [5, 10]}), table)
    for wrong in (7, "filter.width", {}, {width: [10], "rate": [12]}, (width,), (1, [10])):
        with pytest.raises(genga.Error, match=r"x: expected a name and its values, .* found "):
            genga.study(clip, x=wrong)
    same_table(genga.study(clip, genga.Recipe.table_1()), table)
    turned = genga.study(clip, x=(persistence, [5, 10]), y=(width, [10, 20, 30]))
    assert sorted(turned["union"].tolist()) == sorted(table["union"].tolist())
    own = genga.study(clip, genga.Recipe(), x=(width, [10, 20, 30]), y=(persistence, [5, 10]))
    assert own["union"].tolist() != table["union"].tolist(), "a recipe is taken at its word"
    out = subprocess.run([PROGRAM, "recipe", "--study"], check=True, capture_output=True, text=True, encoding="utf-8")
    assert genga.Recipe.table_1() == genga.Recipe.parse(out.stdout)


def test_counts_are_whole_numbers(clip):
    measures = ["union", "genga", "drawings", "longest_hold", "held_koma", "drawings_per_second", "peak_ssd"]
    table = genga.study(clip, x=("spacing.on", [1, 2]), measures=measures)
    assert [table[measure].dtype.kind for measure in measures] == list("iiiiiff")
    told = genga.run(clip, targets={"keys": 9}).outcomes[0]
    assert [type(told[what]) for what in ("asked", "reached")] == [int, int]


def test_an_axis_of_numbers_is_a_column_of_numbers(clip):
    table = genga.study(clip)
    assert len(table["union"][table["filter.width"] == 10]) == 2
    columns = {
        "10,20": [10, 20],
        "10,12.5": [10.0, 12.5],
        "0.10s,0.2s": ["0.1s", "0.2s"],
        "10,0.2s": ["10", "0.2s"],
    }
    for values, wanted in columns.items():
        made = genga.study(clip, x=("filter.width", values), measures=["genga"])["filter.width"]
        assert made.tolist() == wanted and made.dtype == np.array(wanted).dtype, values
    seeds = genga.study([clip, clip], x=("noise", [0, 0.5]), y=("noise.seed", [2**53 + 1]), measures=["genga"])
    assert seeds["noise"].tolist() == [0, 0.5] * 2 and seeds["noise.seed"].tolist() == [2**53 + 1] * 4
    gaps = genga.study(clip, x=("keys.per_second", [3, float("inf")]), measures=["genga"])
    assert gaps["keys.per_second"].tolist() == [3, float("inf")]


def test_a_study_per_joint_adds_up_to_the_total(clip):
    table, joints = genga.study(clip), genga.study(clip, per_joint=True)
    assert list(joints) == ["filter.width", "turns.persistence", "joint", "keys"]
    cells = joints["keys"].reshape(6, len(clip.names))
    assert cells.sum(axis=1).tolist() == table["total"].tolist()
    assert joints["joint"][: len(clip.names)].tolist() == clip.names
    turns = genga.run(clip, genga.Recipe.table_1(), filter__width=20, turns__persistence=5).turns
    of_joint = np.bincount(turns["joint"][turns["kind"] == "key"], minlength=len(clip.names))
    assert cells[2].tolist() == of_joint.tolist()
    with pytest.raises(genga.Error, match="leave measures out"):
        genga.study(clip, per_joint=True, measures=["union"])


def test_a_study_takes_several_clips(clip):
    pitch = ROOT / "data" / "kuroda-pitch.bvh"
    table = genga.study([clip, str(pitch)])
    assert table["clip"].tolist() == ["kick"] * 6 + ["kuroda-pitch"] * 6
    alone = [genga.study(one)["union"].tolist() for one in (clip, pitch)]
    assert table["union"].tolist() == alone[0] + alone[1]
    joints = genga.study([clip, pitch], per_joint=True)
    assert len(joints["keys"]) == 6 * (len(clip.names) + len(genga.read(pitch).names))
    assert joints["clip"].tolist() == sorted(joints["clip"].tolist())
    of_any = genga.study(one for one in (clip, pitch))
    same_table(of_any, table)
    for none in ([], iter(())):
        with pytest.raises(genga.Error, match="no clip in the list"):
            genga.study(none)
    with pytest.raises(TypeError, match="expected a genga.Clip, a path or bytes, not <class 'int'>"):
        genga.study(7)


@pytest.mark.parametrize("settings", [{}, {"rate": 12}, {"keys": {"min_price": 1}}, {"layers": "limbs"}])
def test_the_keys_and_the_report_count_alike(settings):
    for path in [KICK, *real(*CLIPS[:2])]:
        result = genga.run(path, **settings)
        report = result.report
        layers = report.get("layers") or [{"name": "A", "genga": report["genga"]}]
        for layer in layers:
            assert (result.keys["layer"] == layer["name"]).sum() == layer["genga"], (path.name, layer["name"])
        kept = result.sheet.drawings["role"] != "inbetween"
        assert len(result.keys["frame"]) == kept.sum(), path.name


def test_one_call_leads_from_a_file_to_its_keys(clip):
    wanted = genga.run(clip)
    for source in (KICK, str(KICK), KICK.read_bytes()):
        assert genga.run(source).keys["frame"].tolist() == wanted.keys["frame"].tolist()
    assert genga.run(KICK).to_json() == wanted.to_json()
    assert genga.evaluate(KICK, wanted.to_json()) == genga.evaluate(clip, wanted.to_json())
    assert genga.run(KICK).clip.warnings == clip.warnings
    with pytest.raises(TypeError, match="a path or bytes"):
        genga.run(7)
    with pytest.raises(FileNotFoundError):
        genga.run("nothing.bvh")


@pytest.mark.parametrize("amount", [1.0, 0.35, np.float32(1), np.float64(0.5)])
@pytest.mark.parametrize("name", ["naka_nashi", "koma_dori"])
def test_a_share_is_text_and_no_float(name, amount, clip):
    with pytest.raises(genga.Error, match=f'{name}: expected a whole number, as in 4, or a share as text, as in "35%"'):
        genga.omit(clip, **{name: amount})
    assert genga.omit(clip, **{name: np.int64(1)}).frames == 92


def test_omission_alone_is_the_programs(clip, tmp_path):
    found = genga.omit(clip, naka_nashi=6, koma_dori="30%")
    out = tmp_path / "omitted.bvh"
    command = [PROGRAM, "omit", str(KICK), "--naka-nashi", "6", "--koma-dori", "30%", "--out", str(out), "--table"]
    table = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    assert table[0] == "clip,frames,n_io,n_hf,time_ms" and len(table) == 2
    assert table[1].split(",")[:4] == ["kick", str(found.frames), str(found.n_io), str(found.n_hf)]
    assert found.limited.to_bvh() == out.read_text(encoding="utf-8")
    assert (found.n_io, found.frames, found.seconds > 0) == (6, 92, True)
    assert len(np.unique(found.sheet.exposures["drawing"])) == found.frames - found.n_io - found.n_hf
    with pytest.raises(genga.Error, match="naka_nashi"):
        genga.omit(KICK, naka_nashi="many")


def test_a_share_that_is_capped_is_told(clip):
    found, notes = told(lambda: genga.omit(clip, naka_nashi="50%"))
    assert found.n_io == 6
    assert notes == [
        "naka-nashi: 50% are 46 of 92 koma, and a share leaves out at most 6; a count, such as 46, is not limited"
    ]
    assert told(lambda: genga.omit(clip, naka_nashi="6%"))[1] == []


def test_evaluation_and_comparison(clip):
    result = genga.run(clip)
    drawings = result.sheet.drawings
    genga_on_sheet = drawings["place"][drawings["role"] == "genga"].astype(int)
    found = genga.evaluate(clip, result.to_json(), reference=genga_on_sheet.tolist())
    assert found["pace"]["drawings"] == len(set(result.sheet.exposures["drawing"].tolist()))
    assert found["timing"]["f1"] == 1.0 and 0 < found["shown"]["mean"] < 10
    assert genga.evaluate(clip, result, reference=genga_on_sheet.tolist()) == found
    with pytest.raises(TypeError, match="expected a genga.Result, .* not <class 'int'>"):
        genga.evaluate(clip, 7)
    table = genga.compare(clip, keys=[6], noise=0.0)
    assert set(table["asked"]) >= {6} and np.isnan(table["steady"]).all()


def test_what_is_cut_again_is_counted_as_said(clip):
    found = genga.omit(clip, naka_nashi=60, koma_dori=0)
    gone = found.frames - len(np.unique(found.sheet.exposures["drawing"]))
    assert found.n_io >= gone
    assert "cut again" in genga.Omitted.n_io.__doc__
    many = genga.omit(clip, naka_nashi=102, koma_dori=0)
    assert many.n_io > many.frames, "so that its representation says of what"
    assert f"koma cut {many.n_io} times (n_io)" in repr(many)


@pytest.mark.parametrize("tolerance", [-1, math.nan, math.inf])
def test_a_tolerance_that_is_no_length_is_refused(tolerance, clip):
    with pytest.raises(genga.Error, match="tolerance: expected koma, 0 or more"):
        genga.evaluate(clip, genga.run(clip), reference=[20], tolerance=tolerance)


def test_reference_keys_beyond_the_sheet_are_told_as_a_warning(clip):
    result = genga.run(clip)
    with pytest.warns(UserWarning, match=r"^1 reference key beyond frames 0 to \d+ of the sheet does not count$"):
        found = genga.evaluate(clip, result, reference=[20, 46, 5000])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert genga.evaluate(clip, result, reference=[20, 46]) == found


def test_its_own_keys_are_all_found_and_those_beside_an_end_are_told():
    # At 100 frames a second the last koma begins before the last frame.
    clip = genga.read(ROOT / "data" / "kuroda-pitch.bvh")
    result = genga.run(clip)
    keys, last = result.keys["frame"], clip.first + len(clip) - 1
    assert result.keys["reason"][-1] == "end" and last - 4 < keys[-1] < last
    found, notes = told(lambda: genga.evaluate(clip, result, reference=keys))
    assert found["timing"]["reference"] == found["timing"]["found"] == int((result.keys["reason"] != "end").sum())
    assert (found["timing"]["recall"], notes) == (1.0, [])
    assert genga.evaluate(clip, result, reference=result) == found
    beside, notes = told(lambda: genga.evaluate(clip, result, reference=[*keys, keys[-1] + 1]))
    assert beside == found
    says = f"1 reference key before frame {clip.first + 4} or from frame {keys[-1]} on, in the first or last koma, does"
    assert len(notes) == 1 and notes[0].startswith(says), notes


def test_a_repeated_reference_key_counts_once(clip, tmp_path):
    result = genga.run(clip)
    key = int(result.keys["frame"][1])
    once, notes = told(lambda: genga.evaluate(clip, result, reference=[key]))
    assert notes == []
    table = tmp_path / "keys.txt"
    table.write_text(f"{key}\n{key}\n")
    for reference in ([key, key], table):
        twice, notes = told(lambda: genga.evaluate(clip, result, reference=reference))
        assert twice == once and twice["timing"]["recall"] == 1.0
        assert notes == ["1 reference key repeats another one and does not count"]


def test_which_layer_is_judged_is_told(clip):
    layers = [{"name": "A", "joints": ["Hips"]}, {"name": "B", "joints": ["LeftArm"]}]
    result = genga.run(clip, layers=layers)
    _, notes = told(lambda: genga.evaluate(clip, result))
    assert len(notes) == 1 and notes[0].startswith("of several layers what is on screen is judged together"), notes


def test_reference_keys_are_frames_a_result_or_a_file(clip, tmp_path):
    result, other = genga.run(clip), genga.run(clip, rate=12)
    drawings = other.sheet.drawings
    frames = drawings["place"][drawings["role"] == "genga"].tolist()
    wanted = genga.evaluate(clip, result, reference=[int(frame) for frame in frames])
    table = tmp_path / "h.txt"
    table.write_text("# by hand\nframe\tbones keyed\n" + "".join(f"{frame}\t2\n" for frame in frames))
    for given in (frames, np.array(frames), np.array(frames, int), other, table, str(table), table.read_bytes()):
        assert genga.evaluate(clip, result, reference=given) == wanted, given
    table.write_text("frame\n12\nlate\n")
    with pytest.raises(genga.Error, match=r"h\.txt:3:1: expected the number of a source frame") as raised:
        genga.evaluate(clip, result, reference=table)
    assert (raised.value.file, raised.value.line) == (str(table), 3)
    with pytest.raises(FileNotFoundError):
        genga.evaluate(clip, result, reference="nothing.txt")
    for wrong in (7, [2.5], [-1], ["a"], np.array([math.nan]), result.keys):
        with pytest.raises(genga.Error, match=r"reference: expected source frames, .* found "):
            genga.evaluate(clip, result, reference=wrong)


def test_again_is_a_new_run_and_leaves_the_old(clip):
    first = genga.run(clip)
    before = first.to_json()
    again = first.again(spacing={"on": 3})
    assert again.to_json() == genga.run(clip, spacing={"on": 3}).to_json() != before == first.to_json()
    recipe = genga.Recipe(spacing={"on": 3})
    recipe.correct(pins=[30], forbid=["50..60"])
    corrected = genga.run(clip, pins=[30], forbid=["50..60"], spacing={"on": 3})
    assert again.again(recipe).to_json() == corrected.to_json() != again.to_json()
    assert corrected.again(genga.Recipe()).to_json() == before


def test_other_threads_run_meanwhile(clip):
    ticks, is_done = [], threading.Event()

    def tick():
        while not is_done.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    genga.study(clip, x=("filter.width", "1..100:1"), y=("turns.persistence", "1..100:1"), measures=["genga"])
    is_done.set()
    thread.join()
    assert len(ticks) > 10


def interrupted(work, after=0.5):
    """How long work goes on that Ctrl-C ends after some seconds."""
    # What runs behind a shell's back is begun with Ctrl-C ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(after, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    began = time.monotonic()
    try:
        with pytest.raises(KeyboardInterrupt):
            work()
    finally:
        timer.cancel()
        signal.signal(signal.SIGINT, before)
    return time.monotonic() - began - after


@pytest.mark.skipif(os.name == "nt", reason="signals are sent otherwise there")
@pytest.mark.parametrize(
    "kept, times",
    [({"measures": ["genga"]}, 1), ({"per_joint": True}, 1000)],
    ids=["measures", "joints"],
)
def test_ctrl_c_ends_a_study(kept, times, clip):
    axes = dict(x=("filter.width", "1..600:1"), y=("turns.persistence", "1..600:1"))
    long = many_times(clip, times)
    ends(lambda: genga.study(long, **axes, **kept))


@pytest.mark.skipif(os.name == "nt", reason="signals are sent otherwise there")
def test_ctrl_c_ends_the_drawing_of_pictures(clip):
    ends(genga.run(many_times(clip, 20), spacing={"on": 1}).to_images)


@pytest.mark.skipif(os.name == "nt", reason="signals are sent otherwise there")
@pytest.mark.parametrize(
    "work, times",
    [
        (lambda clip: genga.run(clip, targets={"max_error": 2, "drawings_per_second": 11.37}), 600),
        (lambda clip: genga.compare(clip, keys=[10, 30, 90]), 4),
    ],
    ids=["run", "compare"],
)
def test_ctrl_c_ends_the_work_and_not_the_wait(work, times, clip):
    long = many_times(clip, times)
    ends(lambda: work(long))


def ends(work):
    """Soon after Ctrl-C, the process is idle. The whole work takes half a minute of processor time or more, a stage of it
    a few seconds."""
    assert interrupted(work) < 1.5
    began = time.process_time()
    while busy(0.5) > 0.01:
        assert time.process_time() - began < 10.0


def busy(seconds):
    """Seconds of processor that the process spends in so many seconds."""
    before = time.process_time()
    time.sleep(seconds)
    return time.process_time() - before


def many_times(clip, times):
    arrays = dict(names=clip.names, parents=clip.parents, offsets=clip.offsets, rate=clip.rate)
    arrays.update(rotations=np.tile(clip.rotations, (times, 1, 1)), root=np.tile(clip.positions[:, 0], (times, 1)))
    return genga.Clip(**arrays)


def test_any_readers_matrices_give_the_keys_of_the_clip(clip, tmp_path):
    """What a reader of FBX would save, made of the clip with a scale on every matrix."""
    turned = []
    for joint, parent in enumerate(clip.parents):
        x, y, z, w = clip.rotations[:, joint].T
        own = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        ).transpose(2, 0, 1)
        turned.append(own if parent < 0 else turned[parent] @ own)
    matrices = np.zeros((len(clip), len(clip.names), 4, 4))
    matrices[..., :3, :3] = 1.5 * np.array(turned).swapaxes(0, 1)
    matrices[..., :3, 3], matrices[..., 3, 3] = clip.positions, 1.0
    take, out = tmp_path / "take.npz", tmp_path / "keys.json"
    np.savez(take, names=clip.names, parents=clip.parents, matrices=matrices, rate=clip.rate)
    script = ROOT / "python" / "examples" / "keys_of_fbx.py"
    subprocess.run([sys.executable, str(script), str(take), str(out)], check=True)
    arrays = dict(names=clip.names, parents=clip.parents, offsets=clip.offsets, rotations=clip.rotations)
    wanted = genga.run(genga.Clip(**arrays, root=clip.positions[:, 0], rate=clip.rate)).keys
    keys = json.loads(out.read_text(encoding="utf-8"))["keys"]
    assert [key["frame"] for key in keys] == wanted["frame"].tolist()
    assert [key["reason"] for key in keys] == wanted["reason"].tolist()


def test_a_plain_numpy_version_finds_the_same_six_cells(clip):
    """The first paper in fifty lines that share nothing with the library: an oracle, and what speed is told beside."""
    sys.path.insert(0, str(ROOT / "python" / "benches"))
    try:
        import beside_numpy
    finally:
        del sys.path[0]
    table = genga.study(clip)
    found = beside_numpy.six_cells(np.array(clip.rotations), clip.rate)
    assert found == list(zip(table["union"].astype(int).tolist(), table["total"].astype(int).tolist()))


def test_the_first_table_becomes_a_plot(tmp_path):
    pytest.importorskip("matplotlib")
    plot = tmp_path / "table.png"
    script = ROOT / "python" / "examples" / "table_1.py"
    subprocess.run([sys.executable, str(script), str(KICK), str(plot)], check=True, env={**os.environ, "MPLBACKEND": "agg"})
    assert plot.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    "words, says",
    [
        (["table_1.py", "data/kick.bvh", "{png}"], "union"),
        (["from_arrays.py"], "turn"),
        (["keys_of_many.py", "{out}", "data/kick.bvh", "data/kuroda-pitch.bvh"], "keys of 2 clips"),
    ],
)
def test_the_examples_run(words, says, tmp_path):
    script, *rest = [word.format(out=tmp_path / "keys.csv", png=tmp_path / "table.png") for word in words]
    command = [sys.executable, str(ROOT / "python" / "examples" / script), *rest]
    out = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    assert says in out.stdout


def test_an_error_goes_through_a_pool_of_processes_with_its_place(tmp_path):
    broken = tmp_path / "broken.bvh"
    broken.write_text("HIERARCHY\nJOIN Hips\n")
    with pytest.raises(genga.Error) as raised:
        genga.read(str(broken))
    again = pickle.loads(pickle.dumps(raised.value))
    assert type(again) is genga.Error and str(again) == str(raised.value)
    assert (again.file, again.line, again.column) == (str(broken), 2, 1)


def test_everything_can_be_pickled(clip):
    other = pickle.loads(pickle.dumps(clip))
    assert other.to_bvh() == clip.to_bvh() and repr(other) == repr(clip) and other.warnings == clip.warnings
    assert np.array_equal(other.rotations, clip.rotations) and other.first == clip.first
    recipe = genga.Recipe(spacing={"on": 3})
    recipe.correct(pins=[(30, "wind-up")])
    assert copy.deepcopy(recipe) == pickle.loads(pickle.dumps(recipe)) == recipe != genga.Recipe()
    result = genga.run(clip, recipe, targets={"keys": 9})
    again = pickle.loads(pickle.dumps(result))
    assert again.to_json() == result.to_json() and again.outcomes == result.outcomes and repr(again) == repr(result)
    assert again.recipe == result.recipe and again.clip.to_bvh() == clip.to_bvh()
    told = genga.read(result.to_vrma()["kick.vrma"])
    assert pickle.loads(pickle.dumps(told)).warnings == told.warnings != []
    omitted = genga.omit(clip, naka_nashi=6)
    other = pickle.loads(pickle.dumps(omitted))
    assert repr(other) == repr(omitted) and other.seconds == omitted.seconds
    assert other.limited.to_bvh() == omitted.limited.to_bvh() and repr(other.sheet) == repr(omitted.sheet)
    sheet = pickle.loads(pickle.dumps(result.sheet))
    assert (sheet.rate, sheet.koma) == (result.sheet.rate, result.sheet.koma)
    assert sheet.drawings["why"].tolist() == result.sheet.drawings["why"].tolist()


def test_a_clip_that_begins_late_and_says_its_up_is_pickled_with_it(clip):
    made = genga.Clip(**{**arrays_of(clip), "first": 12, "up": "y", "metres": 0.01})
    other = pickle.loads(pickle.dumps(made))
    assert (other.first, other.up, other.metres) == (12, "y", 0.01)
    assert genga.run(other).to_json() == genga.run(made).to_json()


def vmd_with_others(vmd):
    """Puts a key of a smile and one of the camera into a VMD."""
    bones = 54 + 111 * int.from_bytes(vmd[50:54], "little")
    smile = "笑い".encode("cp932").ljust(15, b"\0") + struct.pack("<If", 3, 0.5)
    camera = struct.pack("<I7f", 5, -45, 0, 10, 0, 0, 0.1, 0) + bytes([20, 107] * 12) + struct.pack("<IB", 30, 0)
    return vmd[:bones] + struct.pack("<I", 1) + smile + struct.pack("<I", 1) + camera + bytes(8)


def glb_with_others(glb):
    """Puts a camera and a lamp of no model into a GLB."""
    length = int.from_bytes(glb[12:16], "little")
    document, rest = json.loads(glb[20 : 20 + length]), glb[20 + length :]
    document["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}]
    document["nodes"] += [{"name": "Lamp", "translation": [1, 2, 3]}, {"name": "Camera", "camera": 0}]
    nodes = len(document["nodes"])
    document["scenes"][document.get("scene", 0)]["nodes"] += [nodes - 2, nodes - 1]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return glb[:8] + struct.pack("<III", 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest


@pytest.mark.parametrize("write", ["to_vmd", "to_glb"])
def test_what_stands_beside_the_body_is_pickled_with_it(write, clip):
    with_others = {"to_vmd": vmd_with_others, "to_glb": glb_with_others}[write]

    def written(result):
        with warnings.catch_warnings(action="ignore"):
            return list(getattr(result, write)().values())

    bare = written(genga.run(clip))[0]
    read = genga.read(with_others(bare))
    result, other = genga.run(read), pickle.loads(pickle.dumps(read))
    assert written(genga.run(genga.read(bare))) != written(result) == written(genga.run(other))
    assert written(pickle.loads(pickle.dumps(result))) == written(result)
    assert genga.run(other).to_xdts() == result.to_xdts()


@pytest.mark.parametrize("method", [method for method in multiprocessing.get_all_start_methods()])
def test_clips_and_results_go_through_pools_of_processes(method, clip):
    wanted = genga.run(clip)
    # A fork has none of the threads that have just worked here.
    with multiprocessing.get_context(method).Pool(2) as pool:
        jobs = [pool.apply_async(genga.run, (clip, genga.Recipe(rate=rate))) for rate in (24, 12)]
        first, second = (job.get(timeout=120) for job in jobs)
        assert first.to_json() == wanted.to_json() != second.to_json()
        with pytest.raises(genga.Error, match="pinned frame 1000 is not in the clip"):
            pool.apply_async(genga.run, (clip,), {"pins": [1000]}).get(timeout=120)


@pytest.mark.parametrize(
    "call, says",
    [
        (lambda clip: genga.compare(clip, keys=[-1]), r"keys: expected a list of whole numbers, .* found \[-1\]"),
        (lambda clip: genga.compare(clip, keys=5), "keys: expected a list of whole numbers, .* found 5"),
        (lambda clip: genga.omit(clip, max_hold=-1), "max_hold: expected a whole number, 0 or more, found -1"),
        (lambda clip: genga.run(clip, pins=40), "pins: expected a list, each of a frame, .* found 40"),
        (lambda clip: genga.run(clip, pins="40"), "pins: expected a list, each of a frame, .* found '40'"),
        (lambda clip: genga.run(clip, holds=40), "holds: expected a list, .* found 40"),
        (lambda clip: genga.Recipe().correct(moves=4), "moves: expected a list, .* found 4"),
        (
            lambda clip: genga.Clip(
                names=clip.names,
                parents=clip.parents,
                offsets=clip.offsets,
                rotations=clip.rotations,
                root=clip.positions[:, 0],
                rate=clip.rate,
                first=-3,
            ),
            "first: expected a whole number, 0 or more, found -3",
        ),
    ],
)
def test_a_wrong_argument_is_named(call, says, clip):
    with pytest.raises(genga.Error, match=says):
        call(clip)


@pytest.mark.parametrize(
    "call",
    [
        genga.read,
        genga.run,
        lambda path: genga.study(path, x=("filter.width", [10])),
        lambda path: genga.study([KICK, path], x=("filter.width", [10])),
        genga.omit,
        lambda path: genga.evaluate(path, genga.run(genga.read(path.read_bytes()))),
        lambda path: genga.compare(path, keys=[4], noise=0.0),
    ],
)
def test_a_damaged_file_is_told_by_every_call_that_reads_it(call, tmp_path):
    path = tmp_path / "cut.bvh"
    path.write_text("".join(KICK.read_text().splitlines(keepends=True)[:-20]))
    _, notes = told(lambda: call(path))
    of_file = [note for note in notes if note.startswith(f"{path}:")]
    assert len(of_file) == 1 and of_file[0].endswith("[W_FRAMES_MISMATCH]"), notes


def test_what_was_changed_in_a_clip_is_told_and_kept(tmp_path):
    lines = KICK.read_text().splitlines(keepends=True)
    damaged = "".join(lines[:-20])
    clip, notes = told(lambda: genga.read(damaged))
    assert [warning["code"] for warning in clip.warnings] == ["W_FRAMES_MISMATCH"]
    assert len(notes) == 1 and notes[0].endswith(f"{clip.warnings[0]['message']} [W_FRAMES_MISMATCH]")
    result, again = told(lambda: genga.run(clip))
    assert again == [] and any(notes[0] == note for note in result.report["notes"])
    assert told(lambda: genga.read(KICK))[1] == []


def test_what_is_lost_or_does_not_count_is_told_as_a_warning(clip):
    with pytest.warns(UserWarning, match="W_VMD_LEFT_OUT"):
        genga.run(clip).to_vmd()
    corrected = genga.Recipe()
    corrected.correct(pins=[30])
    with pytest.warns(UserWarning, match="corrections"):
        genga.study(clip, corrected, x=("filter.width", [10, 20]))
    with pytest.warns(UserWarning, match="corrections"):
        genga.compare(clip, corrected)
