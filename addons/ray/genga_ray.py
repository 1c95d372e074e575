"""The keys of many clips on a Ray cluster: python genga_ray.py OUT.csv CLIP.bvh...

From a program of your own: table(clips), where a clip is a dict of arrays, what genga.Clip(**clip) takes. The table is a
dict of columns, in the order of the clips; pandas.DataFrame(table) takes it as it is. A broken clip is a row of `errors`.
"""

import csv
import os
import sys

import numpy as np
import ray

import genga

# A task should take some seconds: Ray's own cost is some milliseconds each.
CLIPS_A_TASK = 64


@ray.remote
def keys_of(clips, settings):
    """The keys of some clips, each a path or a dict of arrays; a clip that cannot be read gives its error."""
    found = []
    for clip in clips:
        try:
            clip = genga.Clip(**clip) if isinstance(clip, dict) else genga.read(clip)
            found.append(genga.run(clip, **settings).keys)
        except genga.Error as error:
            found.append(str(error))
    return found


def table(clips, **settings):
    """Gives the keys of all clips as columns, behind `clip`, the place in the list, and the errors by place."""
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
    # Paths of files that all machines see.
    columns, errors = table([os.path.abspath(path) for path in paths])
    for at, error in errors.items():
        print(f"{paths[at]}: {error}", file=sys.stderr)
    columns["clip"] = np.array(paths, object)[columns["clip"]]
    with open(out, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*columns.values()))
    print(f"{len(columns['clip'])} keys of {len(paths) - len(errors)} clips")
