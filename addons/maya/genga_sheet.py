"""Applies a genga timesheet (sheet.json) to animated nodes in Maya.

Keeps only the poses on the sheet, as keys with stepped tangents on the sheet's koma, 24 per second. Blends
inbetweens that lie between two keys on the shortest arc.

Select the root of the skeleton that plays the take, then run in the script editor (Python):

    import genga_sheet
    genga_sheet.apply("/path/to/sheet.json")

It replaces the keys of the selected nodes and all nodes below them. One undo reverts it.

Tested with a mock of maya.cmds, not yet in Maya itself.
"""

import json
import math

# Drawings are found by their numbers, whether these count from 1 or, in the first version, from 0.
SCHEMAS = ("genga-sheet-2", "genga-sheet-1")
TIME_UNITS = {"game": 15, "film": 24, "pal": 25, "ntsc": 30, "show": 48, "palf": 50, "ntscf": 60}
# Units that a scene may have but a sheet never uses, in units per second.
OTHER_UNITS = {"hour": 1 / 3600, "min": 1 / 60, "sec": 1, "millisec": 1000}
# Axes in the order of rotation, by Maya's number of the rotate order.
ROTATE_ORDERS = ("xyz", "yzx", "zxy", "xzy", "yxz", "zyx")


def apply(path, nodes=None, first_frame=0.0, start=1, layer=""):
    """Applies the sheet at `path` to `nodes`, by default the selection, and all nodes below them.

    `first_frame` is the Maya frame of source frame 0, at the scene's rate before the call. `start` is the frame
    of the first koma. `layer` is the name of the sheet's layer, by default its first.
    Returns the number of drawings.
    """
    from maya import cmds

    sheet = read(path, layer)
    nodes = nodes or cmds.ls(selection=True, long=True)
    if not nodes:
        raise RuntimeError("nothing is selected: select the root of the skeleton that plays the take")
    return lay(cmds, sheet, nodes, first_frame, start)


def lay(cmds, sheet, nodes, first_frame, start):
    """Applies a layer of a sheet to nodes and all nodes below them, as one undo step."""
    cmds.undoInfo(openChunk=True, chunkName="genga timesheet")
    try:
        step = scene_rate(cmds) / sheet["source_fps"]
        tracks = [track for node in with_children(cmds, nodes) for track in tracks_of(cmds, node)]
        if not tracks:
            raise RuntimeError("neither the nodes nor the nodes below them have keys")
        keys = sample(tracks, sheet["exposures"], lambda place: first_frame + place * step)
        cmds.currentUnit(time=unit_name(sheet["fps"]), updateAnimation=False)
        for track, poses in keys:
            track.write(cmds, poses, [start + koma for koma, _ in sheet["exposures"]])
        end = start + sheet["length"] - 1
        cmds.playbackOptions(minTime=start, animationStartTime=start, maxTime=end, animationEndTime=end)
        if sheet["root_on_ones"]:
            cmds.warning("the sheet has the root on ones, but here it moves with its drawings; limited.bvh has it")
    finally:
        cmds.undoInfo(closeChunk=True)
    return len(sheet["exposures"])


def read(path, layer_name=""):
    """Reads a layer of the sheet at `path`, in the form of `layer_of`."""
    with open(path, encoding="utf-8-sig") as file:
        sheet = json.load(file)
    if not isinstance(sheet, dict) or sheet.get("schema") not in SCHEMAS:
        raise ValueError(f"{path} is not a genga timesheet ({' or '.join(SCHEMAS)})")
    return layer_of(sheet, layer_name)


def layer_of(sheet, layer_name=""):
    """Returns a layer as fps, source_fps, length in koma, root_on_ones, and exposures (first koma, source).

    A source is a place in the take, or (place, place, share) for a blend of two. Over the blank koma of a cut that the
    drawings enter late or leave early, the first and the last pose stand.
    """
    layers = {layer["name"]: layer for layer in reversed(sheet["layers"])}
    if layer_name and layer_name not in layers:
        raise ValueError(f"no layer {layer_name}; the sheet has {', '.join(layers)}")
    if not layers:
        raise ValueError("the sheet has no layer")
    layer = layers[layer_name] if layer_name else sheet["layers"][0]
    drawings = {drawing["drawing"]: drawing for drawing in layer["drawings"]}
    exposures, koma = [], sheet.get("at", 1) - 1
    for exposure in layer["exposures"]:
        drawing = drawings[exposure["drawing"]]
        blend = drawing.get("between")
        exposures.append((koma, (*blend, drawing["share"]) if blend else drawing["frame"]))
        koma += exposure["koma"]
    if not exposures:
        raise ValueError(f"layer {layer['name']} has no drawing")
    source_fps = sheet["clip"]["frame_rate"]
    return {
        "fps": sheet["fps"],
        "source_fps": source_fps,
        "length": max(koma, sheet.get("length", 0)),
        "root_on_ones": sheet.get("root") == "ones",
        "exposures": exposures,
    }


def scene_rate(cmds):
    """Returns the scene's frames per second."""
    unit = cmds.currentUnit(query=True, time=True)
    known = {**TIME_UNITS, **OTHER_UNITS}
    if unit in known:
        return known[unit]
    # "120fps", "23.976fps", and "29.97df" (drop frame).
    number = unit.replace("fps", "").replace("df", "")
    try:
        return float(number)
    except ValueError:
        raise RuntimeError(f"the scene's time unit {unit} has no known rate in frames per second") from None


def unit_name(fps):
    """Returns Maya's name for a rate."""
    named = {rate: name for name, rate in TIME_UNITS.items()}
    return named.get(fps, f"{fps:g}fps")


def with_children(cmds, nodes):
    """Returns the nodes and all transforms below them, each once."""
    found = []
    for node in nodes:
        below = cmds.listRelatives(node, allDescendents=True, fullPath=True, type="transform")
        found += [name for name in [node, *(below or [])] if name not in found]
    return found


class Track:
    """One attribute of a node, or its three rotation attributes together."""

    def __init__(self, cmds, node, attributes, order=None):
        self.names = [f"{node}.{attribute}" for attribute in attributes]
        self.order = order
        self.value = lambda time: tuple(cmds.getAttr(name, time=time) for name in self.names)

    def blend(self, before, after, share, near):
        """Blends two values: linearly, or on the shortest arc for a rotation."""
        if before == after:
            return before
        if self.order is None:
            return tuple(a + share * (b - a) for a, b in zip(before, after))
        ends = [quaternion(angles, self.order) for angles in (before, after)]
        return angles_of(slerp(*ends, share), self.order, near)

    def write(self, cmds, poses, times):
        """Replaces all keys by keys with stepped tangents."""
        for axis, name in enumerate(self.names):
            cmds.cutKey(name, clear=True)
            for pose, time in zip(poses, times):
                tangents = {"inTangentType": "linear", "outTangentType": "step"}
                cmds.setKeyframe(name, time=time, value=pose[axis], **tangents)


def tracks_of(cmds, node):
    """Yields the animated tracks of a node. A rotation with a key on any axis is one track."""
    attributes = cmds.listAttr(node, keyable=True, scalar=True) or []
    keyed = [name for name in attributes if cmds.keyframe(f"{node}.{name}", query=True, keyframeCount=True)]
    turns = ["rotateX", "rotateY", "rotateZ"]
    if any(name in keyed for name in turns):
        yield Track(cmds, node, turns, ROTATE_ORDERS[cmds.getAttr(f"{node}.rotateOrder")])
    yield from (Track(cmds, node, [name]) for name in keyed if name not in turns)


def sample(tracks, exposures, time_of):
    """Samples every track at every exposure, before anything changes."""
    return [(track, sampled(track, exposures, time_of)) for track in tracks]


def sampled(track, exposures, time_of):
    poses = []

    def at(place):
        before = math.floor(place)
        value = track.value(time_of(before))
        if place == before:
            return value
        near = poses[-1] if poses else value
        return track.blend(value, track.value(time_of(before + 1)), place - before, near)

    for _, source in exposures:
        if isinstance(source, tuple):
            before, after, share = at(source[0]), at(source[1]), source[2]
            poses.append(track.blend(before, after, share, poses[-1] if poses else before))
        else:
            poses.append(at(source))
    return poses


def product(p, q):
    """Multiplies two quaternions (x, y, z, w): q rotates first, then p."""
    (a, b, c, d), (x, y, z, w) = p, q
    return (
        d * x + a * w + b * z - c * y,
        d * y - a * z + b * w + c * x,
        d * z + a * y - b * x + c * w,
        d * w - a * x - b * y - c * z,
    )


def quaternion(angles, order):
    """Converts rotateX, rotateY, rotateZ in degrees to a quaternion."""
    turned = (0.0, 0.0, 0.0, 1.0)
    for axis in order:
        half = math.radians(angles["xyz".index(axis)]) / 2
        turn = [0.0, 0.0, 0.0, math.cos(half)]
        turn["xyz".index(axis)] = math.sin(half)
        turned = product(turn, turned)
    return turned


def slerp(p, q, share):
    """Interpolates from p to q on the shortest arc."""
    dot = sum(a * b for a, b in zip(p, q))
    if dot < 0.0:
        dot, q = -dot, tuple(-value for value in q)
    if dot > 1.0 - 1e-9:
        weights = (1.0 - share, share)
    else:
        angle = math.acos(dot)
        weights = (math.sin((1.0 - share) * angle), math.sin(share * angle))
    mixed = [weights[0] * a + weights[1] * b for a, b in zip(p, q)]
    length = math.sqrt(sum(value * value for value in mixed))
    return tuple(value / length for value in mixed)


def angles_of(rotation, order, near):
    """Converts a quaternion to rotateX, rotateY, rotateZ in degrees, nearest to the angles `near`."""
    i, j, k = ("xyz".index(axis) for axis in order)
    sign = 1.0 if (i + 1) % 3 == j else -1.0
    entry = lambda row, column: entry_of(rotation, row, column)
    sine = max(-1.0, min(1.0, -sign * entry(k, i)))
    middle = math.degrees(math.asin(sine))
    if abs(sine) > 1.0 - 1e-12:
        # Gimbal lock: keeps the last angle, and rotates the rest by the first.
        last = [0.0, 0.0, 0.0]
        last[k] = -near[k]
        left = product(quaternion(last, order), rotation)
        first = math.degrees(math.atan2(-sign * entry_of(left, j, k), entry_of(left, j, j)))
        return nearest([{i: first, j: middle, k: near[k]}], near)
    first = math.degrees(math.atan2(sign * entry(k, j), entry(k, k)))
    last = math.degrees(math.atan2(sign * entry(j, i), entry(i, i)))
    other = {i: first + 180.0, j: 180.0 - middle, k: last + 180.0}
    return nearest([{i: first, j: middle, k: last}, other], near)


def rotated(rotation, vector):
    x, y, z, w = rotation
    return product(product(rotation, (*vector, 0.0)), (-x, -y, -z, w))[:3]


def entry_of(rotation, row, column):
    """Returns an entry of the rotation's matrix."""
    return rotated(rotation, [float(column == at) for at in range(3)])[row]


def nearest(choices, near):
    """Returns the nearest of some triples of angles, each unwound by whole turns."""

    def unwound(choice):
        return tuple(choice[axis] - 360.0 * round((choice[axis] - near[axis]) / 360.0) for axis in range(3))

    return min(map(unwound, choices), key=lambda angles: sum(abs(a - b) for a, b in zip(angles, near)))
