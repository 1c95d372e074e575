"""Finds the key drawings of the selected joints in Maya, and keeps only those poses.

It samples the joints over the playback range as the rig poses them. genga finds and times the keys, and
genga_sheet applies the timesheet. Only joints with keys are keyed, so bake joints that a control rig drives first.

mayapy needs genga and NumPy: `mayapy -m pip install genga_anime-0.1.0-….whl`. Select the root joint, then run in the
script editor (Python):

    import genga_keys
    genga_keys.find_keys(keys={"per_second": 4}, spacing={"on": 2})

Settings have the names of a recipe. One undo reverts it.

Tested with a mock of maya.cmds, not yet in Maya itself.
"""

import json

import genga_sheet


def find_keys(nodes=None, start=1, **settings):
    """Finds the keys of `nodes` and all joints below them, by default the selection, and applies the timesheet.

    `start` is the frame of the first koma. Returns a `genga.Result`.
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
        raise RuntimeError("genga is not installed: run mayapy -m pip install with its wheel, then restart Maya") from None
    return genga


def joints_of(cmds, nodes):
    """Returns the joints of one skeleton by full path, parents first."""
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
        raise RuntimeError(f"{strange[0]} is not below {found[0]}: select the root of one skeleton")
    return found


def parents_of(paths):
    """Returns the index of each joint's nearest joint above, -1 for the root. Skips groups between joints."""
    place = {path: at for at, path in enumerate(paths)}

    def above(path):
        while "|" in path:
            path = path.rpartition("|")[0]
            if path in place:
                return place[path]
        return -1

    return [above(path) for path in paths]


def arrays(paths, worlds):
    """Builds the arguments of genga.Clip from world matrices: F lists of J lists of 16 numbers, in Maya's order.

    Removes scale. Bones have their length on the first frame.
    """
    import numpy as np

    # Maya multiplies row vectors by matrices from the left.
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
    # In Maya two nodes under different parents may have the same name.
    names = [name if names.count(name) == 1 else path.strip("|") for name, path in zip(names, paths)]
    return dict(names=names, parents=parents, offsets=offsets, rotations=quaternions(local), root=places[:, 0].copy())


def quaternions(matrices):
    """Converts rotations (…, 3, 3) to quaternions x, y, z, w by Bar-Itzhack's eigenvector, stable at any angle."""
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
