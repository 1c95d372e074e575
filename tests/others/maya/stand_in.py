"""As much of maya.cmds as the script asks for: nodes with keyed attributes, time units, undo."""

import types


class Cmds(types.ModuleType):
    """Curves are straight between keys and held outside, or stepped where a key says so."""

    def __init__(self, unit="film"):
        super().__init__("maya.cmds")
        self.unit = unit
        self.children = {}
        self.attributes = {}
        self.keys = {}
        self.selected = []
        self.ranges = {}
        self.chunks = []

    def add(self, node, parent=None, order=0, **values):
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
        return below or None

    def listAttr(self, node, keyable=False, scalar=False):
        found = [name.split(".")[1] for name in self.attributes if name.startswith(f"{node}.")]
        return [name for name in found if name != "rotateOrder"] or None

    def keyframe(self, name, query=False, keyframeCount=False):
        return len(self.keys.get(name, ()))

    def getAttr(self, name, time=None):
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

    def playbackOptions(self, **ranges):
        self.ranges = ranges

    def undoInfo(self, openChunk=False, closeChunk=False, chunkName=None):
        self.chunks.append("open" if openChunk else "close")
