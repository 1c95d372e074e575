"""Finds the keys of many clips on a Ray cluster: python genga_ray.py OUT.csv CLIP.bvh...

From your own program, call table(clips). A clip is a path, or a dict of arrays for genga.Clip(**clip). The table is a
dict of columns, in the order of the clips; pandas.DataFrame(table) accepts it. A broken clip has an entry in `errors`.
"""

import csv
import os
import sys

import numpy as np
import ray

import genga

# A task should take some seconds, because Ray's overhead per task is some milliseconds.
CLIPS_A_TASK = 64


@ray.remote
def keys_of(clips, settings):
    """Returns the keys of each clip (a path or a dict of arrays), or its error message."""
    found = []
    for clip in clips:
        try:
            clip = genga.Clip(**clip) if isinstance(clip, dict) else genga.read(clip)
            found.append(genga.run(clip, **settings).keys)
        except genga.Error as error:
            found.append(str(error))
    return found


def table(clips, **settings):
    """Returns the keys of all clips as columns, first `clip`, the index in the list, and the errors by index."""
    parts = [clips[at : at + CLIPS_A_TASK] for at in range(0, len(clips), CLIPS_A_TASK)]
    found = [one for part in ray.get([keys_of.remote(part, settings) for part in parts]) for one in part]
    errors = {at: one for at, one in enumerate(found) if isinstance(one, str)}
    tables = [(at, one) for at, one in enumerate(found) if not isinstance(one, str)]
    if not tables:
        return {"clip": np.zeros(0, int)}, errors
    places = np.concatenate([np.repeat(at, len(one["frame"])) for at, one in tables])
    columns = {name: np.concatenate([one[name] for _, one in tables]) for name in tables[0][1]}
    return {"clip": places, **columns}, errors


if __name__ == "__main__":
    out, *paths = sys.argv[1:]
    # All machines must see these files.
    columns, errors = table([os.path.abspath(path) for path in paths])
    for at, error in errors.items():
        print(f"{paths[at]}: {error}", file=sys.stderr)
    columns["clip"] = np.array(paths, object)[columns["clip"]]
    with open(out, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*columns.values()))
    print(f"{len(columns['clip'])} keys of {len(paths) - len(errors)} clips")
