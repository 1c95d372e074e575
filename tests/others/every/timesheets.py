"""Timesheets by their published rules, held against sheet.json koma by koma. No registry has a reader of them."""

import csv
import io
import json
import struct
from pathlib import Path
from typing import NamedTuple


class Layer(NamedTuple):
    name: str
    # On each koma, from 1: the drawing, and the genga that began last.
    shown: list
    genga: list


class Sheet:
    """sheet.json as a list of koma."""

    def __init__(self, path, schema):
        read = json.loads(path.read_text(encoding="utf-8"))
        self.schema = schema
        self.fps = read["fps"]
        self.layers = [self.layer(layer) for layer in read["layers"]]
        self.length = max(len(layer.shown) for layer in self.layers)

    @staticmethod
    def layer(read):
        assert [drawing["drawing"] for drawing in read["drawings"]] == list(range(1, len(read["drawings"]) + 1))
        kept = [drawing["drawing"] for drawing in read["drawings"] if drawing["role"] != "inbetween"]
        shown, genga = [], []
        for exposure in read["exposures"]:
            drawing = exposure["drawing"]
            began = kept.index(drawing) + 1 if drawing in kept else genga[-1]
            shown += [drawing] * exposure["koma"]
            genga += [began] * exposure["koma"]
        return Layer(read["name"], shown, genga)

    def column(self, at, kind):
        """What stands on each koma of the cut; 0 where a layer has ended."""
        koma = getattr(self.layers[at], kind)
        return koma + [0] * (self.length - len(koma))


def held(length, cells):
    """Each cell until the next one."""
    koma = [0] * length
    for begin, number in cells:
        koma[begin:] = [number] * (length - begin)
    return koma


def track(frames, length):
    """A track of XDTS or TDTS: a symbol for nothing ends what is held, other symbols are marks."""
    cells = []
    for frame in frames:
        value = frame["data"][0]["values"][0]
        if value == "SYMBOL_NULL_CELL":
            cells.append((frame["frame"], 0))
        elif not value.startswith("SYMBOL_"):
            cells.append((frame["frame"], int(value)))
    return held(length, cells)


def digital(path, sheet):
    """XDTS has one field, of genga or of all drawings by its name; TDTS has both."""
    signature, text = path.read_text(encoding="utf-8").split("\n", 1)
    read = json.loads(text)
    if signature == "toeiDigitalTimeSheet Save Data":
        (read,) = read["timeSheets"]
        kinds = {0: "genga", 4: "shown"}
    else:
        assert signature == "exchangeDigitalTimeSheet Save Data", signature
        kinds = {0: "genga" if path.name.endswith("_genga_ts.xdts") else "shown"}
    (table,) = read["timeTables"]
    assert table["duration"] == sheet.length
    for field in table["fields"]:
        tracks = field["tracks"]
        assert len(tracks) == len(sheet.layers)
        for one in tracks:
            at = one["trackNo"]
            assert track(one["frames"], sheet.length) == sheet.column(at, kinds[field["fieldId"]]), (field["fieldId"], at)


def sts(path, sheet):
    data = path.read_bytes()
    assert data[:18] == b"\x11ShiraheiTimeSheet"
    layers, length = struct.unpack_from("<BH", data, 18)
    assert (layers, length) == (len(sheet.layers), sheet.length)
    numbers = struct.unpack_from(f"<{layers * length}H", data, 23)
    for at in range(layers):
        assert list(numbers[at * length : (at + 1) * length]) == sheet.column(at, "shown"), at
    names = data[23 + 2 * layers * length :]
    for layer in sheet.layers:
        size = names[0]
        assert names[1 : 1 + size].decode("cp932") == layer.name
        names = names[1 + size :]
    assert not names


def columns(path, sheet):
    """A row a koma below two of headings; genga left, drawings right; × ends, ○ marks an inbetween."""
    _, names, *rows = csv.reader(io.StringIO(path.read_text(encoding="utf-8")), strict=True)
    assert names[1:] == [layer.name for layer in sheet.layers] * 2
    assert [row[0] for row in rows] == [str(koma) for koma in range(1, sheet.length + 1)]

    def cells(column):
        filled = ((koma, row[column]) for koma, row in enumerate(rows))
        return [(koma, 0 if cell == "×" else int(cell)) for koma, cell in filled if cell not in ("", "○")]

    for at in range(len(sheet.layers)):
        for column, kind in ((1 + at, "genga"), (1 + at + len(sheet.layers), "shown")):
            assert held(sheet.length, cells(column)) == sheet.column(at, kind), (at, kind)


def after_effects(path, sheet):
    """Of one layer alone the name says which it is."""
    lines = path.read_text(encoding="utf-8").split("\n")
    assert lines[0] == "Adobe After Effects 9.0 Keyframe Data" and lines[-2] == "End of Keyframe Data"
    begin = lines.index("\tFrame\tseconds") + 1
    keys = (line.split("\t")[1:] for line in lines[begin : lines.index("", begin)])
    cells = [(int(frame), round(float(seconds) * sheet.fps) + 1) for frame, seconds in keys]
    at = [layer.name for layer in sheet.layers].index(Path(path).stem)
    assert held(len(sheet.layers[at].shown), cells) == sheet.layers[at].shown, at
