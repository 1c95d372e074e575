"""Finds the key drawings of the selected joints in Maya, and leaves those poses alone.

The joints are sampled over the playback range as the rig poses them, genga finds the keys and times them, and
genga_sheet applies the timesheet. That keys what has keys: joints that a control rig drives have to be baked first.

mayapy needs genga and NumPy: `mayapy -m pip install genga-0.1.0-….whl`. Select the root joint, then run in the
script editor (Python):

    import genga_keys
    genga_keys.find_keys(keys={"per_second": 4}, spacing={"on": 2})

Settings are those of a recipe, by name. Undo takes it back in one step.

Checked against a stand-in for maya.cmds, not yet in Maya itself.
"""

import json

import genga_sheet


def find_keys(nodes=None, start=1, **settings):
    """Finds the keys of `nodes` and all joints below them, by default the selection, and applies the timesheet.

    `start` is the frame that the first koma gets. Gives what genga found: a `genga.Result`.
    """
    from maya import cmds

    genga = with_genga()
    joints = joints_of(cmds, nodes or cmds.ls(selection=True, long=True))
    first = cmds.playbackOptions(query=True, minTime=True)
    last = cmds.playbackOptions(query=True, maxTime=True)
    frames = int(last - first) + 1
    worlds = [[cmds.getAttr(f"{node}.worldMatrix[0]", time=first + at) for node in joints] for at in range(frames)]
    clip = genga.Clip(**arrays(joints, worlds), rate=genga_sheet.scene_rate(cmds))
    result = genga.run(clip, **settings)
    sheet = json.loads(result.to_json()["sheet.json"])
    genga_sheet.lay(cmds, genga_sheet.layer_of(sheet), joints[:1], first, start)
    return result


def with_genga():
    try:
        import genga
    except ImportError:
        raise RuntimeError("mayapy has no genga yet: mayapy -m pip install the wheel, then start Maya again") from None
    return genga


def joints_of(cmds, nodes):
    """The joints of one skeleton by their full paths, parents first."""
    found = []
    for node in nodes or []:
        below = cmds.listRelatives(node, allDescendents=True, fullPath=True, type="joint") or []
        own = [node] if cmds.nodeType(node) == "joint" else []
        found += [name for name in own + below if name not in found]
    if not found:
        raise RuntimeError("no joint is selected: select the root joint of the skeleton that plays the take")
    found.sort(key=lambda path: path.count("|"))
    strange = [path for path, parent in zip(found[1:], parents_of(found)[1:]) if parent < 0]
    if strange:
        raise RuntimeError(f"{strange[0]} does not hang on {found[0]}: select the root of one skeleton")
    return found


def parents_of(paths):
    """The place of the nearest joint above each, -1 for the root; groups between joints are passed over."""
    place = {path: at for at, path in enumerate(paths)}

    def above(path):
        while "|" in path:
            path = path.rpartition("|")[0]
            if path in place:
                return place[path]
        return -1

    return [above(path) for path in paths]


def arrays(paths, worlds):
    """What genga.Clip takes, from the world matrices of every frame: F lists of J lists of 16 numbers, as Maya has them.

    Scale is left out, and a bone is as long as it is on the first frame.
    """
    import numpy as np

    # A point is a row in Maya and stands before its matrix.
    matrices = np.asarray(worlds, float).reshape(len(worlds), len(paths), 4, 4)
    places = matrices[:, :, 3, :3]
    axes = matrices[:, :, :3, :3]
    axes = axes / np.linalg.norm(axes, axis=-1, keepdims=True)
    turned = np.swapaxes(axes * np.sign(np.linalg.det(axes))[..., None, None], -1, -2)
    parents = parents_of(paths)
    local, offsets = turned.copy(), np.zeros((len(paths), 3))
    for joint, parent in enumerate(parents):
        if parent >= 0:
            local[:, joint] = np.swapaxes(turned[:, parent], -1, -2) @ turned[:, joint]
            offsets[joint] = (places[0, joint] - places[0, parent]) @ turned[0, parent]
    names = [path.rpartition("|")[2] for path in paths]
    # Two nodes may have one name in Maya, at different places.
    names = [name if names.count(name) == 1 else path.strip("|") for name, path in zip(names, paths)]
    return dict(names=names, parents=parents, offsets=offsets, rotations=quaternions(local), root=places[:, 0].copy())


def quaternions(matrices):
    """Of rotations (…, 3, 3) the quaternions x, y, z, w: the eigenvector of Bar-Itzhack, which no angle spoils."""
    import numpy as np

    m = np.moveaxis(matrices, (-2, -1), (0, 1))
    k = np.empty((4, 4, *m.shape[2:]))
    for a in range(3):
        b, c = (a + 1) % 3, (a + 2) % 3
        k[a, a] = m[a, a] - m[b, b] - m[c, c]
        k[a, b] = k[b, a] = m[a, b] + m[b, a]
        k[a, 3] = k[3, a] = m[c, b] - m[b, c]
    k[3, 3] = m[0, 0] + m[1, 1] + m[2, 2]
    return np.ascontiguousarray(np.linalg.eigh(np.moveaxis(k, (0, 1), (-2, -1)))[1][..., -1])
