"""python3 tests/fuzz/seeds/make.py: the seeds of `fbx`, `gltf` and `model`, three bones each, written by the rules alone.

FBX is a tree of nodes, each a name, properties and children: the same tree as text, as binary, and as binary with packed
arrays and the longer words of 7.5.
"""

import base64
import json
import struct
import zlib
from pathlib import Path

HERE = Path(__file__).parent
SECOND = 46_186_158_000
HALF = 0.5**0.5


class Array(list):
    """Numbers that a binary file keeps as one property; `kind` is its letter."""

    def __init__(self, kind, numbers):
        super().__init__(numbers)
        self.kind = kind


def properties(*rows):
    return ("Properties70", [], [("P", list(row), []) for row in rows])


def limb(at, name, *rows):
    place = ("Lcl Translation", "Lcl Translation", "", "A", 0.0, 2.0, 0.0)
    attribute = ("NodeAttribute", [at + 90, f"NodeAttribute::{name}", "LimbNode"], [("TypeFlags", ["Skeleton"], [])])
    return [attribute, ("Model", [at, f"Model::{name}", "LimbNode"], [properties(place, *rows)])]


def take(at, name, degrees):
    curve = [
        ("Default", [0.0], []),
        ("KeyVer", [4008], []),
        ("KeyTime", [Array("l", [0, SECOND])], []),
        ("KeyValueFloat", [Array("f", [0.0, degrees])], []),
        ("KeyAttrFlags", [Array("i", [8456])], []),
        ("KeyAttrDataFloat", [Array("f", [0.0, 0.0, 0.0, 0.0])], []),
        ("KeyAttrRefCount", [Array("i", [2])], []),
    ]
    objects = [
        ("AnimationStack", [at, f"AnimStack::{name}", ""], [properties(("LocalStop", "KTime", "Time", "", SECOND))]),
        ("AnimationLayer", [at + 1, "AnimLayer::Base", ""], []),
        ("AnimationCurveNode", [at + 2, "AnimCurveNode::R", ""], [properties(("d|X", "Number", "", "A", 0.0))]),
        ("AnimationCurve", [at + 3, "AnimCurve::", ""], curve),
    ]
    wires = [("OO", at + 1, at), ("OO", at + 2, at + 1), ("OP", at + 2, 4, "Lcl Rotation"), ("OP", at + 3, at + 2, "d|X")]
    return objects, wires


def scene():
    turned = [("RotationActive", "bool", "", "", 1), ("PreRotation", "Vector3D", "Vector", "", 30.0, 0.0, 0.0)]
    inherits = ("InheritType", "enum", "", "", 2)
    objects = limb(3, "Hip") + limb(4, "Knee", *turned, inherits) + limb(5, "Foot")
    wires = [("OO", 3, 0), ("OO", 4, 3), ("OO", 5, 4), ("OO", 93, 3), ("OO", 94, 4), ("OO", 95, 5)]
    for at, name, degrees in [(10, "Walk", 90.0), (20, "Run", -90.0)]:
        more, of_take = take(at, name, degrees)
        objects, wires = objects + more, wires + of_take
    settings = [("UpAxis", "int", "Integer", "", 2), ("UpAxisSign", "int", "Integer", "", 1),
                ("FrontAxis", "int", "Integer", "", 1), ("FrontAxisSign", "int", "Integer", "", -1),
                ("CoordAxis", "int", "Integer", "", 0), ("CoordAxisSign", "int", "Integer", "", 1),
                ("UnitScaleFactor", "double", "Number", "", 100.0), ("TimeMode", "enum", "", "", 6)]
    header = [("FBXHeaderVersion", [1003], []), ("FBXVersion", [7400], [])]
    return [
        ("FBXHeaderExtension", [], header),
        ("GlobalSettings", [], [("Version", [1000], []), properties(*settings)]),
        ("Objects", [], objects),
        ("Connections", [], [("C", list(wire), []) for wire in wires]),
    ]


def as_text(nodes, depth=0):
    lines = []
    for name, values, children in nodes:
        words = []
        for value in values:
            if isinstance(value, Array):
                numbers = ",".join(map(str, value))
                words.append(f"*{len(value)} {{ a: {numbers} }}")
            else:
                words.append(f'"{value}"' if isinstance(value, str) else str(value))
        lines.append("\t" * depth + f"{name}: " + ", ".join(words) + (" {" if children else ""))
        if children:
            lines += as_text(children, depth + 1) + ["\t" * depth + "}"]
    return lines


def as_property(value, is_packed):
    if isinstance(value, Array):
        raw = struct.pack(f"<{len(value)}{ {'l': 'q', 'i': 'i', 'f': 'f'}[value.kind] }", *value)
        data = zlib.compress(raw) if is_packed else raw
        return value.kind.encode() + struct.pack("<III", len(value), is_packed, len(data)) + data
    if isinstance(value, float):
        return b"D" + struct.pack("<d", value)
    if isinstance(value, int):
        return b"L" + struct.pack("<q", value)
    # The kind of a thing stands behind its name.
    kind, sign, name = value.partition("::")
    text = f"{name}\0\1{kind}" if sign else value
    return b"S" + struct.pack("<I", len(text)) + text.encode()


def as_binary(nodes, at, word, is_packed):
    """The records from byte `at` on, with the empty one behind them."""
    size = struct.calcsize(f"<3{word}B")
    made = b""
    for name, values, children in nodes:
        own = b"".join(as_property(value, is_packed) for value in values)
        begin = at + len(made) + size + len(name) + len(own)
        inner = as_binary(children, begin, word, is_packed) if children else b""
        head = struct.pack(f"<3{word}B", begin + len(inner), len(values), len(own), len(name))
        made += head + name.encode() + own + inner
    return made + bytes(size)


def fbx():
    text = "; FBX 7.4.0 project file\n" + "\n".join(as_text(scene())) + "\n"
    (HERE / "fbx/text").write_text(text)
    for name, version, word, is_packed in [("binary", 7400, "I", 0), ("packed", 7500, "Q", 1)]:
        head = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", version)
        (HERE / "fbx" / name).write_bytes(head + as_binary(scene(), len(head), word, is_packed))


def document(between, uri):
    """A hip that travels and a knee that turns, with keys at 0, 0.5 and 1 second; one key of the hip is sparse."""
    rows = [x for at in (0.0, 1.0, 3.0) for x in ([0, 0, 0, at, 1, 0, 0, 0, 0] if between == "CUBICSPLINE" else [at, 1, 0])]
    turns = [0, 0, 0, 1, HALF, 0, 0, HALF, HALF, 0, 0, HALF]
    numbers = [0.0, 0.5, 1.0, *rows, *turns, 5.0, 1.0, 0.0]
    data = struct.pack(f"<{len(numbers)}f", *numbers) + struct.pack("<H", 2)
    first, second = 12, 12 + 4 * len(rows)
    last = second + 48
    ends = [(0, first), (first, second), (second, last), (last, last + 12), (last + 12, len(data))]
    sparse = {"count": 1, "indices": {"bufferView": 4, "componentType": 5123}, "values": {"bufferView": 3}}
    moved = {"bufferView": 1, "componentType": 5126, "count": len(rows) // 3, "type": "VEC3"}
    made = {
        "asset": {"version": "2.0"},
        "nodes": [
            {"name": "scene", "children": [1, 4]},
            {"name": "hip", "translation": [0, 1, 0], "children": [2]},
            {"name": "knee", "translation": [0, 1, 0], "scale": [2, 2, 2], "children": [3]},
            {"name": "foot", "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0, 1]},
            {"name": "lamp"},
        ],
        "skins": [{"joints": [1, 2, 3]}],
        "animations": [{
            "name": "walk",
            "channels": [
                {"sampler": 0, "target": {"node": 1, "path": "translation"}},
                {"sampler": 1, "target": {"node": 2, "path": "rotation"}},
            ],
            "samplers": [{"input": 0, "output": 1, "interpolation": between}, {"input": 0, "output": 2}],
        }],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "SCALAR"},
            moved if between == "CUBICSPLINE" else moved | {"sparse": sparse},
            {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC4"},
        ],
        "bufferViews": [{"buffer": 0, "byteOffset": begin, "byteLength": end - begin} for begin, end in ends],
        "buffers": [{"byteLength": len(data)}],
        "extensions": {"VRMC_vrm_animation": {"humanoid": {"humanBones": {"hips": {"node": 1}}}}},
    }
    if uri:
        made["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(made, separators=(",", ":")).encode(), data


def gltf():
    for between in ["LINEAR", "CUBICSPLINE"]:
        text, _ = document(between, True)
        (HERE / "gltf" / between.lower()).write_bytes(text)
    text, data = document("STEP", False)
    text, data = text + b" " * (-len(text) % 4), data + bytes(-len(data) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    (HERE / "gltf/glb").write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks)


# A thigh, a shin, a foot and the IK that brings them there: name, parent, place.
BONES = [("足", -1, (1, 10, 0)), ("ひざ", 0, (1, 6, 0.5)), ("足首", 1, (1, 1, 0.5)), ("足ＩＫ", -1, (1, 1, 0.5))]
IK, LINKS = 3, (1, 0)


def pmd():
    """A vertex, a face and a material, then bones, which end at one another, and the IK."""

    def name(text):
        return text.encode("cp932").ljust(20, b"\0")

    made = b"Pmd" + struct.pack("<f", 1) + name("doll") + bytes(256)
    made += b"".join(struct.pack("<I", count) + bytes(count * size) for count, size in [(1, 38), (3, 2), (1, 70)])
    made += struct.pack("<H", len(BONES))
    for at, (bone, parent, place) in enumerate(BONES):
        made += name(bone) + struct.pack("<hHBH3f", parent, at + 1, 0, 0, *place)
    links = struct.pack(f"<{len(LINKS)}H", *LINKS)
    return made + struct.pack("<HHHBHf", 1, IK, 2, len(LINKS), 40, 0.5) + links


def pmx(width, is_utf8):
    """Nothing but bones, with numbers of so many bytes; a bone ends at another or so far from where it begins."""

    def text(words):
        data = words.encode("utf-8" if is_utf8 else "utf-16-le")
        return struct.pack("<I", len(data)) + data

    def number(bone):
        return struct.pack({1: "<b", 2: "<h", 4: "<i"}[width], bone)

    made = b"PMX " + struct.pack("<fB", 2.0, 8)
    made += bytes([is_utf8, 0, width, 1, 1, width, 1, 1]) + b"".join(map(text, ["doll", "", "", ""]))
    made += struct.pack("<4I", 0, 0, 0, 0) + struct.pack("<I", len(BONES))
    for at, (bone, parent, place) in enumerate(BONES):
        is_ik, ends_at_bone = at == IK, at == 0
        made += text(bone) + text("") + struct.pack("<3f", *place) + number(parent)
        made += struct.pack("<iH", 0, 0x20 * is_ik + ends_at_bone)
        made += number(at + 1) if ends_at_bone else struct.pack("<3f", 0, 0, 1)
        if is_ik:
            made += number(2) + struct.pack("<ifI", 40, 0.5, len(LINKS))
            made += b"".join(number(link) + b"\0" for link in LINKS)
    return made


def model():
    (HERE / "model/pmd").write_bytes(pmd())
    for name, width, is_utf8 in [("pmx", 1, 0), ("pmx-wide", 4, 1)]:
        (HERE / "model" / name).write_bytes(pmx(width, is_utf8))


fbx()
gltf()
model()
