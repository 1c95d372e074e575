"""Reads every file of results folders with programs by others: check.py SCHEMA.json FOLDER …

A file that no row of READERS takes is an error. What is a timesheet is held against sheet.json koma by koma; what has a
length, against the length of the sheet.
"""

import csv
import io
import json
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree

import bvh
import html5lib
import jsonschema
import pygltflib
import pypmxvmd
import tomli
from PIL import Image

from timesheets import Sheet, after_effects, columns, digital, sts


def json_file(path, _):
    json.loads(path.read_text(encoding="utf-8"))


def schema(path, sheet):
    jsonschema.validate(json.loads(path.read_text(encoding="utf-8")), sheet.schema)


def table(path, _):
    header, *rows = csv.reader(io.StringIO(path.read_text(encoding="utf-8")), strict=True)
    assert rows and len(set(header)) == len(header), header
    assert all(len(row) == len(header) for row in rows), "rows of one length"


def koma_table(path, sheet):
    """The table of koma, a row a koma and layer."""
    table(path, sheet)
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for layer in sheet.layers:
        of_layer = [row for row in rows if row["layer"] == layer.name]
        assert [int(row["koma"]) for row in of_layer] == list(range(1, len(layer.shown) + 1))
        if "drawing" in of_layer[0]:
            assert [int(row["drawing"]) for row in of_layer] == layer.shown


def remap(path, sheet):
    table(path, sheet)
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == sum(len(layer.shown) for layer in sheet.layers)


def toml(path, _):
    assert tomli.loads(path.read_text(encoding="utf-8"))["turns"]


def concat(path, sheet):
    """ffmpeg itself plays lists in tests/others/video. Here their times add up to the sheet."""
    text = path.read_text(encoding="utf-8")
    seconds = sum(float(time) for time in re.findall(r"^duration (\S+)$", text, re.M))
    assert abs(seconds * sheet.fps + 1 - sheet.length) < 0.01, seconds


def motion(path, sheet):
    """A row a koma, and as many numbers in it as channels."""
    read = bvh.Bvh(path.read_text(encoding="utf-8"))
    channels = sum(len(read.joint_channels(name)) for name in read.get_joints_names())
    assert all(len(frame) == channels for frame in read.frames)
    if path.name == "limited.bvh":
        assert read.nframes == sheet.length
        assert abs(read.frame_time * sheet.fps - 1) < 1e-4


def glb(path, sheet):
    read = pygltflib.GLTF2().load_binary(str(path))
    named = {animation.name: animation for animation in read.animations}
    ends = [read.accessors[sampler.input].max[0] for sampler in named["koma"].samplers]
    assert abs(max(ends) * sheet.fps - sheet.length) < 1e-3, max(ends)


def keys_glb(path, _):
    """A cubic has two tangents a key."""
    read = pygltflib.GLTF2().load_binary(str(path))
    (animation,) = read.animations
    for sampler in animation.samplers:
        values = 3 if sampler.interpolation == "CUBICSPLINE" else 1
        keys, found = read.accessors[sampler.input].count, read.accessors[sampler.output].count
        assert found == values * keys, (sampler.interpolation, keys, found)


def keys_vmd(path, _):
    """Every bone has a key on the same frames, and IK bones with keys are on."""
    read = pypmxvmd.load_vmd(str(path))
    frames = {}
    for frame in read.bone_frames:
        frames.setdefault(frame.bone_name, []).append(frame.frame_number)
    (common,) = {tuple(numbers) for numbers in frames.values()}
    assert len(common) > 1, common
    switches = {bone.bone_name: bone.ik_enabled for frame in read.ik_frames for bone in frame.ik_bones}
    assert any(switches.values()), switches
    assert all(is_on == (bone in frames) for bone, is_on in switches.items()), switches


def vrma(path, sheet):
    """Holds end a hair before the change, and so does the last."""
    read = pygltflib.GLTF2().load_binary(str(path))
    assert "VRMC_vrm_animation" in read.extensionsUsed
    (animation,) = read.animations
    ends = [read.accessors[sampler.input].max[0] for sampler in animation.samplers]
    assert sheet.length - 1 <= max(ends) * sheet.fps <= sheet.length + 1e-3, max(ends)


def vmd(path, sheet):
    read = pypmxvmd.load_vmd(str(path))
    last = max(frame.frame_number for frame in read.bone_frames)
    assert abs(last / 30 * sheet.fps - sheet.length) < 2.5, (last, sheet.length)


def svg(path, _):
    ElementTree.parse(path)
    png = subprocess.run(["rsvg-convert", "--width", "64", path], check=True, capture_output=True).stdout
    assert len(Image.open(io.BytesIO(png)).getcolors(4096)) > 1, "an empty picture"


def png(path, _):
    with Image.open(path) as picture:
        picture.load()
        assert len(picture.getcolors(1 << 20)) > 1, "an empty picture"


def gif(path, sheet):
    with Image.open(path) as picture:
        milliseconds = 0
        for at in range(picture.n_frames):
            picture.seek(at)
            milliseconds += picture.info["duration"]
    shown = min(sheet.length, 480)
    assert abs(milliseconds / 1000 - shown / sheet.fps) < 0.011, milliseconds


def mp4(path, sheet):
    asked = ["-count_frames", "-show_entries", "stream=nb_read_frames,r_frame_rate,pix_fmt", "-of", "json"]
    said = subprocess.run(["ffprobe", "-v", "error", *asked, path], check=True, capture_output=True).stdout
    (stream,) = json.loads(said)["streams"]
    assert stream == {"pix_fmt": "yuv420p", "r_frame_rate": f"{sheet.fps}/1", "nb_read_frames": str(sheet.length)}, stream


def page(path, _):
    html5lib.HTMLParser(strict=True).parse(path.read_text(encoding="utf-8"))


def cut(path, sheet):
    """Every picture that it names is there."""
    contents = json.loads(path.read_text(encoding="utf-8"))
    assert contents["koma"] == sheet.length
    for column in contents["columns"]:
        for kind in ("genga", "douga"):
            for number in column[kind]:
                name = f"{column['folder']}_{number:04}.png"
                assert (path.parent / kind / column["folder"] / name).is_file(), name


def tvpaint(path, sheet):
    """Every koma has the pictures that the sheet shows, and they are there: the folder is below the file's own."""
    rows = list(csv.reader(path.read_text(encoding="utf-8").splitlines(), skipinitialspace=True))
    heads = {row[0]: row[1:] for row in rows if row[0].startswith("#") and not row[0][1:].isdigit()}
    shown = [row[1:] for row in rows if row[0][1:].isdigit()]
    assert [row[0] for row in rows[-len(shown):]] == [f"#{koma:05}" for koma in range(sheet.length)]
    wide, high = Image.open(next(path.parent.rglob("*.png"))).size
    sizes = rows[2][1:5]
    assert [int(size) for size in sizes] == [wide, high, sheet.length, len(heads["#Layers"])], rows[2]
    for pictures in shown:
        for folder, picture in zip(heads["#Folder"], pictures, strict=True):
            kind, below = folder.split("/", 1)
            assert kind == path.parent.name, folder
            assert not picture or (path.parent / below / picture).is_file(), picture


READERS = [
    (r"[^/]+/(genga|douga)/[^/]*\.csv", tvpaint),
    (r"sheet\.json", schema),
    (r".*/cut\.json", cut),
    (r".*\.json", json_file),
    (r"sheet\.csv", koma_table),
    (r"remap\.csv", remap),
    (r".*_timesheet\.csv", columns),
    (r"[^/]*\.csv", table),
    (r".*\.toml", toml),
    (r".*\.ffconcat", concat),
    (r".*\.bvh", motion),
    (r"keys\.glb", keys_glb),
    (r".*\.glb", glb),
    (r".*\.vrma", vrma),
    (r".*-keys\.vmd", keys_vmd),
    (r".*\.vmd", vmd),
    (r".*\.[xt]dts", digital),
    (r".*\.sts", sts),
    (r"ae/.*\.txt", after_effects),
    (r".*\.svg", svg),
    (r".*\.png", png),
    (r".*\.gif", gif),
    (r".*\.mp4", mp4),
    (r".*\.html", page),
]


def main(schema_path, *folders):
    read = Counter()
    for folder in map(Path, folders):
        sheet = Sheet(folder / "sheet.json", json.loads(Path(schema_path).read_text(encoding="utf-8")))
        for path in sorted(path for path in folder.rglob("*") if path.is_file()):
            name = path.relative_to(folder).as_posix()
            reader = next((reader for pattern, reader in READERS if re.fullmatch(pattern, name)), None)
            if reader is None:
                sys.exit(f"{path}: nothing reads this file")
            try:
                reader(path, sheet)
            except Exception as error:
                sys.exit(f"{path}: {type(error).__name__}: {error}")
            read[reader.__name__] += 1
    unused = {reader.__name__ for _, reader in READERS} - set(read)
    if unused:
        sys.exit(f"no file was read by {', '.join(sorted(unused))}")
    print(f"{sum(read.values())} files of {len(folders)} sheets: " + ", ".join(f"{n} {k}" for k, n in sorted(read.items())))


if __name__ == "__main__":
    main(*sys.argv[1:])
