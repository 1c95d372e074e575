"""Legs of a rig that give way so that feet stay where they stand."""

from mathutils import Matrix

from . import fit, stepping

# How many curves a bone's turn takes.
WHOLE = {"rotation_quaternion": 4, "rotation_euler": 3}


class Legs:
    """Which curves are turned, and how; of a rig whose legs do not turn by keys of their own none, and `stuck` names those."""

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
        """The pose of an exposure, its legs turned."""
        made = list(pose)
        for at, (mode, group) in enumerate(source.groups):
            own = self.turns.get(group[0][0])
            if own is not None:
                made[at] = stepping.turned(mode, pose[at], Matrix(own[exposure.koma]).to_quaternion())
        return made

    def left_out(self):
        """What the rig does not show of them, in sentences."""
        if not self.stuck:
            return []
        names = fit.listed(sorted(self.stuck))
        return [f"the feet stay with their drawings: no keys of their own turn {names}; limited.bvh holds them"]


def path_of(bone):
    """The data path of what turns a bone, or nothing where its keys alone do not."""
    is_led = bone.is_in_ik_chain or any(not own.mute and own.influence > 0.0 for own in bone.constraints)
    if is_led or not bone.bone.use_inherit_rotation or bone.rotation_mode == "AXIS_ANGLE":
        return None
    how = "rotation_quaternion" if bone.rotation_mode == "QUATERNION" else "rotation_euler"
    return bone.path_from_id(how)
