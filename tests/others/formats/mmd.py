"""A motion and its model for MMD, by the rules of both files alone: the bones of a Blender armature and its poses.

The performer's own body is the model, as where an armature is exported whole: every bone stands where its joint does,
those that MMD has under MMD's names. So nothing is retargeted, and what comes back is what went in.
"""

import struct

from mathutils import Quaternion, Vector

# Units of MMD in a metre.
UNITS = 12.5
RATE = 30

# A bone of MMD, and what captures call it; without 左 and 右, Left and Right.
NAMES = {
    "Hips": "下半身", "Neck": "首", "Head": "頭",
    "Shoulder": "肩", "Arm": "腕", "ForeArm": "ひじ", "Hand": "手首",
    "UpLeg": "足", "Leg": "ひざ", "Foot": "足首",
}
CURVE = bytes([20] * 8 + [107] * 8)


def named(bones):
    """What each bone is called in MMD: at the most 15 bytes, each name once."""
    names = {}
    for at, bone in enumerate(bones):
        side, own = "", bone
        for english, word in [("Left", "左"), ("Right", "右")]:
            if bone.startswith(english):
                side, own = word, bone[len(english):]
        names[bone] = side + NAMES[own] if own in NAMES else f"骨{at}"
    return names


def turned(vector):
    """From a BVH's axes to MMD's, which are left-handed."""
    return Vector((vector.x, vector.y, -vector.z))


def mirrored(quaternion):
    """A rotation in those axes."""
    return Quaternion((quaternion.w, -quaternion.x, -quaternion.y, quaternion.z))


def stands(bones, matrix_of):
    """Where each bone begins, and how it is turned from its rest."""
    found = {}
    for bone in bones:
        matrix = matrix_of(bone)
        turn = matrix.to_quaternion() @ bone.matrix_local.to_quaternion().inverted()
        found[bone.name] = (UNITS * turned(matrix.translation), mirrored(turn))
    return found


def model(bones, names):
    """A PMX 2.0 that has bones and nothing to see."""
    def text(words):
        data = words.encode("utf-16-le")
        return struct.pack("<i", len(data)) + data

    made = b"PMX " + struct.pack("<f9B", 2.0, 8, 0, 0, 1, 1, 1, 2, 1, 1)
    made += text("performer") + text("performer") + text("") * 2
    made += struct.pack("<5i", 0, 0, 0, 0, len(bones))
    places = {bone.name: at for at, bone in enumerate(bones)}
    for bone, (place, _) in zip(bones, stands(bones, lambda bone: bone.matrix_local).values()):
        parent = places[bone.parent.name] if bone.parent else -1
        tip = UNITS * turned(bone.tail_local) - place
        # It turns and moves, is seen and may be touched; how far it goes follows.
        made += text(names[bone.name]) + text("") + struct.pack("<3fhiH3f", *place, parent, 0, 0x1E, *tip)
    return made + struct.pack("<4i", 0, 0, 0, 0)


def records(bones, names, rests, frame, poses):
    """A key of every bone, each against the bone it hangs on."""
    for bone in bones:
        (rest, _), (place, turn) = rests[bone.name], poses[bone.name]
        if bone.parent:
            (carrier, carried), (below, _) = poses[bone.parent.name], rests[bone.parent.name]
            place, rest, turn = place - carrier, rest - below, carried.inverted() @ turn
            place.rotate(carried.inverted())
        moved = place - rest
        x, y, z, w = turn.x, turn.y, turn.z, turn.w
        name = names[bone.name].encode("cp932").ljust(15, b"\0")
        yield name + struct.pack("<I7f", frame, *moved, x, y, z, w) + (CURVE * 4)


def write(folder, stem, scene, armature):
    """A take of 30 frames a second: STEM.vmd and the performer's STEM.pmx."""
    bones = list(armature.data.bones)
    names = named([bone.name for bone in bones])
    rests = stands(bones, lambda bone: bone.matrix_local)
    keys = []
    for frame in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        poses = stands(bones, lambda bone: armature.pose.bones[bone.name].matrix)
        keys += records(bones, names, rests, frame, poses)
    head = b"Vocaloid Motion Data 0002".ljust(30, b"\0") + b"performer".ljust(20, b"\0")
    (folder / f"{stem}.vmd").write_bytes(head + struct.pack("<I", len(keys)) + b"".join(keys) + bytes(20))
    (folder / f"{stem}.pmx").write_bytes(model(bones, names))
