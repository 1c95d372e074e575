"""What genga writes, as far as Blender needs it. Knows nothing of Blender."""

import json
import struct

SHEET_SCHEMA = "genga-sheet-1"


class NotAFile(Exception):
    """The file is not what it should be; the text is for a person."""


class Exposure:
    """A drawing and the koma on which it begins, from 0."""

    def __init__(self, koma, drawing):
        self.koma = koma
        self.role = drawing.get("role", "")
        if "frame" in drawing:
            self.frame, self.between, self.share = float(drawing["frame"]), None, 0.0
        else:
            self.frame = None
            self.between = tuple(float(place) for place in drawing["between"])
            self.share = float(drawing["share"])

    @property
    def places(self):
        """The source frames it needs."""
        return self.between or (self.frame,)


class Sheet:
    """A layer of a sheet.json: its exposures in order, and how long it is in koma."""

    def __init__(self, fps, source_fps, exposures, length):
        self.fps = fps
        self.source_fps = source_fps
        self.exposures = exposures
        self.length = length

    @classmethod
    def read(cls, path, layer_name=""):
        """Reads a layer by its name, or the first."""
        try:
            with open(path, encoding="utf-8-sig") as file:
                return cls._of(json.load(file), layer_name)
        except (ValueError, KeyError, IndexError, TypeError) as error:
            raise NotAFile(f"{path} is no timesheet of genga: {error!r}") from error

    @classmethod
    def _of(cls, sheet, layer_name):
        if sheet["schema"] != SHEET_SCHEMA:
            raise NotAFile(f"the sheet is {sheet['schema']}; this add-on reads {SHEET_SCHEMA}")
        layers = sheet["layers"]
        names = [layer["name"] for layer in layers]
        if layer_name and layer_name not in names:
            raise NotAFile(f"no layer {layer_name}; there are {', '.join(names)}")
        layer = layers[names.index(layer_name) if layer_name else 0]
        drawings = {drawing["drawing"]: drawing for drawing in layer["drawings"]}
        exposures, koma = [], 0
        for exposure in layer["exposures"]:
            exposures.append(Exposure(koma, drawings[exposure["drawing"]]))
            koma += exposure["koma"]
        if not exposures:
            raise NotAFile(f"layer {layer['name']} has no drawing")
        return cls(float(sheet["fps"]), float(sheet["clip"]["frame_rate"]), exposures, koma)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_ours(extras):
    """Whether the extras of an animation have all that the add-on looks at."""
    if not isinstance(extras, dict) or not isinstance(extras.get("keys"), list):
        return False
    has_rate = is_number(extras.get("fps")) and extras["fps"] > 0
    has_length = is_number(extras.get("koma")) and extras["koma"] >= 1
    is_key = lambda key: isinstance(key, dict) and is_number(key.get("koma")) and isinstance(key.get("role"), str)
    return has_rate and has_length and all(map(is_key, extras["keys"]))


def glb_animations(path):
    """Name → extras of every animation that genga wrote into a GLB."""
    try:
        with open(path, "rb") as file:
            magic, _, _, length, kind = struct.unpack("<4sII I4s", file.read(20))
            if (magic, kind) != (b"glTF", b"JSON"):
                raise NotAFile(f"{path} is no GLB")
            document = json.loads(file.read(length))
        animations = document.get("animations", [])
        extras = {animation.get("name", ""): animation.get("extras") for animation in animations}
    except (ValueError, AttributeError, TypeError, struct.error) as error:
        raise NotAFile(f"{path} is no GLB: {error}") from error
    ours = {name: extra for name, extra in extras.items() if is_ours(extra)}
    if not ours:
        raise NotAFile(f"{path} has no animation with genga's roles")
    return ours
