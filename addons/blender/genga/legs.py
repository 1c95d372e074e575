# SPDX-License-Identifier: GPL-3.0-or-later
"""Leg rotations of a rig that hold its feet."""

from mathutils import Matrix

from . import fit, stepping

# Number of curves of a bone's rotation.
WHOLE = {"rotation_quaternion": 4, "rotation_euler": 3}


class Legs:
    """The curves to rotate, and how. Empty if some legs have no rotation keys of their own; `stuck` lists those."""

    def __init__(self, thing, channels, turns):
        keyed = [path for path, _ in channels]
        self.turns, self.stuck = {}, []
        for name, own in turns.items():
            path = path_of(thing.pose.bones[name])
            if path is not None and keyed.count(path) == WHOLE[path.rpartition(".")[2]]:
                self.turns[path] = own
            else:
                self.stuck.append(name)
        if self.stuck:
            self.turns = {}

    def drawn(self, source, exposure, pose):
        """Returns the pose of an exposure with its legs rotated."""
        made = list(pose)
        for at, (mode, group) in enumerate(source.groups):
            own = self.turns.get(group[0][0])
            if own is not None:
                made[at] = stepping.turned(mode, pose[at], Matrix(own[exposure.koma]).to_quaternion())
        return made

    def left_out(self):
        """Returns sentences about what the rig cannot show."""
        if not self.stuck:
            return []
        names = fit.listed(sorted(self.stuck))
        return [f"the feet move with their drawings: {names} lack rotation keys of their own; limited.bvh holds them"]


def path_of(bone):
    """Returns the data path of a bone's rotation, or None if its keys do not fully determine it."""
    is_led = bone.is_in_ik_chain or any(not own.mute and own.influence > 0.0 for own in bone.constraints)
    if is_led or not bone.bone.use_inherit_rotation or bone.rotation_mode == "AXIS_ANGLE":
        return None
    how = "rotation_quaternion" if bone.rotation_mode == "QUATERNION" else "rotation_euler"
    return bone.path_from_id(how)
