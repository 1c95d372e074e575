"""As much of maya.cmds as the scripts ask for: nodes with keyed attributes, time units, undo."""

import math
import types


class Cmds(types.ModuleType):
    """Curves are straight between keys and held outside, or stepped where a key says so."""

    def __init__(self, unit="film"):
        super().__init__("maya.cmds")
        self.unit = unit
        self.children = {}
        self.kinds = {}
        self.attributes = {}
        self.keys = {}
        self.selected = []
        self.ranges = {}
        self.chunks = []
        self.warnings = []

    def add(self, node, parent=None, order=0, kind="transform", **values):
        self.kinds[node] = kind
        self.children.setdefault(parent, []).append(node)
        self.children.setdefault(node, [])
        self.attributes[f"{node}.rotateOrder"] = order
        for axis in "XYZ":
            for kind in ("translate", "rotate"):
                self.attributes[f"{node}.{kind}{axis}"] = 0.0
        for name, value in values.items():
            self.attributes[f"{node}.{name}"] = value

    def animate(self, name, keys):
        self.keys[name] = [(float(time), float(value), "linear") for time, value in keys]

    # What follows has the names, arguments and answers of Maya's commands.

    def ls(self, selection=False, long=False):
        return list(self.selected)

    def listRelatives(self, node, allDescendents=False, fullPath=False, type=None):
        below = [name for child in self.children[node] for name in [child, *(self.listRelatives(child) or [])]]
        # A joint is a transform too.
        return [name for name in below if type in (None, "transform", self.kinds[name])] or None

    def nodeType(self, node):
        return self.kinds[node]

    def listAttr(self, node, keyable=False, scalar=False):
        found = [name.split(".")[1] for name in self.attributes if name.startswith(f"{node}.")]
        return [name for name in found if name != "rotateOrder"] or None

    def keyframe(self, name, query=False, keyframeCount=False):
        return len(self.keys.get(name, ()))

    def getAttr(self, name, time=None):
        if name.endswith(".worldMatrix[0]"):
            return [value for row in self.world(name.split(".")[0], time) for value in row]
        keys = self.keys.get(name)
        if not keys:
            return self.attributes[name]
        before = [key for key in keys if key[0] <= time] or keys[:1]
        after = [key for key in keys if key[0] > time] or keys[-1:]
        (t0, from_, tangent), (t1, to, _) = before[-1], after[0]
        if tangent == "step" or t1 <= t0:
            return from_
        return from_ + (time - t0) / (t1 - t0) * (to - from_)

    def currentUnit(self, query=False, time=None, updateAnimation=True):
        if query:
            return self.unit
        assert updateAnimation is False, "keys that are there must not move"
        self.unit = time

    def cutKey(self, name, clear=False):
        self.keys.pop(name, None)

    def setKeyframe(self, name, time, value, inTangentType, outTangentType):
        keys = self.keys.setdefault(name, [])
        keys.append((float(time), value, outTangentType))
        keys.sort()

    def playbackOptions(self, query=False, **ranges):
        if query:
            (name,) = ranges
            return self.ranges[name]
        self.ranges = ranges

    def warning(self, message):
        self.warnings.append(message)

    def undoInfo(self, openChunk=False, closeChunk=False, chunkName=None):
        self.chunks.append("open" if openChunk else "close")

    # How Maya poses a node: a point is a row, and what is below comes first.

    def world(self, node, time):
        value = lambda what: self.getAttr(f"{node}.{what}", time=time)
        matrix = [[float(row == column) for column in range(4)] for row in range(4)]
        for axis in ("xyz", "yzx", "zxy", "xzy", "yxz", "zyx")[self.attributes[f"{node}.rotateOrder"]]:
            at = "xyz".index(axis)
            sin, cos = (of(math.radians(value(f"rotate{axis.upper()}"))) for of in (math.sin, math.cos))
            turn = [[float(row == column) for column in range(4)] for row in range(4)]
            a, b = (at + 1) % 3, (at + 2) % 3
            turn[a][a], turn[a][b], turn[b][a], turn[b][b] = cos, sin, -sin, cos
            matrix = product(matrix, turn)
        matrix[3][:3] = [value(f"translate{axis}") for axis in "XYZ"]
        parent = next((parent for parent, children in self.children.items() if node in children and parent), None)
        return product(matrix, self.world(parent, time)) if parent else matrix


def product(a, b):
    return [[sum(a[row][k] * b[k][column] for k in range(4)) for column in range(4)] for row in range(4)]
