# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads those parts of genga's files that the add-on needs. Independent of Blender."""

import json
import struct

from .refused import Refused

# Drawings are found by their numbers, whether these count from 1 or, in the first version, from 0.
SHEET_SCHEMAS = ("genga-sheet-2", "genga-sheet-1")


class NotAFile(Refused):
    """The file has the wrong format."""


class Exposure:
    """A drawing and its first koma, from 0."""

    def __init__(self, koma, drawing):
        self.koma = koma
        # The round of a loop that it is in. The body is a round's way further in each.
        self.round = 0
        self.role = drawing.get("role", "")
        # Its number as a genga, if that is not its place among them.
        self.number = str(drawing.get("genga_no", ""))
        why = drawing.get("why", {})
        # A rest, or an inbetween that also replaces others.
        self.is_held = why.get("reason") == "rest" or (self.role == "inbetween" and why.get("held_for", 0) > 0)
        if "frame" in drawing:
            self.frame, self.between, self.share = float(drawing["frame"]), None, 0.0
        else:
            self.frame = None
            self.between = tuple(float(place) for place in drawing["between"])
            self.share = float(drawing["share"])

    @property
    def place(self):
        """The source frame shown. For a blend, the place between its two frames."""
        if self.between is None:
            return self.frame
        before, after = self.between
        return before + self.share * (after - before)

    @property
    def is_key(self):
        """Whether it is a genga or an end, whose number is circled on the sheet."""
        return self.role != "inbetween"


class Layer:
    """A column of the sheet: its joints, and its exposures in order. The first drawing stands on koma `begin`, from 0."""

    def __init__(self, layer, begin=0):
        self.name = layer["name"]
        self.joints = [str(joint) for joint in layer.get("joints", [])]
        drawings = {drawing["drawing"]: drawing for drawing in layer["drawings"]}
        self.exposures, self.length = [], begin
        for exposure in layer["exposures"]:
            self.exposures.append(Exposure(self.length, drawings[exposure["drawing"]]))
            self.length += exposure["koma"]
        if not self.exposures:
            raise NotAFile(f"layer {self.name} has no drawing")


    def unwind(self, begin, frames):
        """Numbers the rounds of a loop of `frames` frames, whose first drawing is nearest to `begin`. Going back is going
        on in the next round; so is the only drawing of a round."""
        shown = [exposure.place for exposure in self.exposures]
        is_alone = len(set(shown)) == 1
        made = round((begin - shown[0]) / frames)
        for at, exposure in enumerate(self.exposures):
            made += bool(at) and (is_alone or shown[at] < shown[at - 1])
            exposure.round = made


class Sheet:
    """A sheet.json: its layers, its length in koma, and its take. `begin` is the source frame of its first koma, and
    `round` the number of frames of a loop's round, 0 if the sheet does not repeat."""

    def __init__(self, sheet):
        if sheet["schema"] not in SHEET_SCHEMAS:
            raise NotAFile(f"the sheet has schema {sheet['schema']}; this add-on reads {' and '.join(SHEET_SCHEMAS)}")
        clip = sheet["clip"]
        self.fps, self.source_fps = float(sheet["fps"]), float(clip["frame_rate"])
        self.take = str(clip["file"])
        self.joints = [str(joint) for joint in clip["joints"]]
        self.first, self.frames = int(clip["first_frame"]), int(clip["frames"])
        # Before the koma `at`, which counts from 1, and after the last drawing the cut is blank. The poses stand there.
        self.layers = [Layer(layer, int(sheet.get("at", 1)) - 1) for layer in sheet["layers"]]
        self.length = max([int(sheet.get("length", 0)), *(layer.length for layer in self.layers)])
        self.begin, self.round = self.first, 0
        if sheet.get("loop"):
            self.round, self.begin = int(sheet["loop"]["frames"]), round(self.layers[0].exposures[0].place)
            for layer in self.layers:
                layer.unwind(self.begin, self.round)
        self.root_on_ones = sheet.get("root") == "ones"
        self.feet_held = sheet.get("feet") == "held"
        self.exaggerated = "exaggerate" in sheet

    @classmethod
    def read(cls, path):
        try:
            with open(path, encoding="utf-8-sig") as file:
                return cls(json.load(file))
        except (ValueError, KeyError, IndexError, TypeError) as error:
            raise NotAFile(f"{path} is not a genga timesheet: {error!r}") from error

    def of(self, name):
        """Returns the layer of that name, or all layers."""
        names = [layer.name for layer in self.layers]
        if name and name not in names:
            raise NotAFile(f"no layer {name}; the sheet has {', '.join(names)}")
        return [layer for layer in self.layers if name in ("", layer.name)]


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_ours(extras):
    """Reports whether an animation's extras have all fields that the add-on needs."""
    if not isinstance(extras, dict) or not isinstance(extras.get("keys"), list):
        return False
    has_rate = is_number(extras.get("fps")) and extras["fps"] > 0
    has_length = is_number(extras.get("koma")) and extras["koma"] >= 1
    is_key = lambda key: isinstance(key, dict) and is_number(key.get("koma")) and isinstance(key.get("role"), str)
    return has_rate and has_length and all(map(is_key, extras["keys"]))


def glb_animations(path):
    """Returns name and extras of each animation that genga wrote into a GLB."""
    try:
        with open(path, "rb") as file:
            magic, _, _, length, kind = struct.unpack("<4sII I4s", file.read(20))
            if (magic, kind) != (b"glTF", b"JSON"):
                raise NotAFile(f"{path} is not a GLB file")
            document = json.loads(file.read(length))
        animations = document.get("animations", [])
        extras = {animation.get("name", ""): animation.get("extras") for animation in animations}
    except (ValueError, AttributeError, TypeError, struct.error) as error:
        raise NotAFile(f"{path} is not a GLB file: {error}") from error
    ours = {name: extra for name, extra in extras.items() if is_ours(extra)}
    if not ours:
        raise NotAFile(f"{path} has no animation with genga's roles")
    return ours
