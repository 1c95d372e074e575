"""The table of the add-on beside that of a loop: paths, and the same clips as arrays."""

import sys
from pathlib import Path

import genga_ray
import numpy as np
import ray

import genga

ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
genga_ray.CLIPS_A_TASK = 7
paths = [str(path.resolve()) for path in sorted(Path(sys.argv[1]).rglob("*.bvh"))]
assert len(paths) == 60

clips, wanted, broken = {}, {}, {}
for at, path in enumerate(paths):
    try:
        clip = genga.read(path)
    except genga.Error as error:
        broken[at] = str(error)
        continue
    clips[at], wanted[at] = clip, genga.run(clip).keys
assert len(broken) == 6, broken


def check(table, wanted):
    assert sorted(set(table["clip"].tolist())) == [at for at in sorted(wanted) if len(wanted[at]["frame"])]
    for name in next(iter(wanted.values())):
        column = np.concatenate([wanted[at][name] for at in sorted(wanted)])
        assert np.array_equal(table[name], column), name


table, errors = genga_ray.table(paths)
assert errors == broken, errors
check(table, wanted)

some = list(clips.values())[:20]
arrays = [
    {
        "names": clip.names,
        "parents": clip.parents,
        "offsets": clip.offsets,
        "rotations": clip.rotations,
        "root": clip.positions[:, 0],
        "rate": clip.rate,
    }
    for clip in some
]
table, errors = genga_ray.table(arrays, keys={"min_price": 9})
assert not errors, errors
check(table, {at: genga.run(genga.Clip(**clip), keys={"min_price": 9}).keys for at, clip in enumerate(arrays)})
print(f"60 paths and {len(arrays)} clips of arrays: the tables are those of a loop")
