"""Writes the keys of many clips into one table: python keys_of_many.py OUT.csv CLIP.bvh...

The table is a dict of columns; pandas.DataFrame(table) and polars.DataFrame(table) accept it.
"""

import csv
import sys

import numpy as np

import genga

out, *paths = sys.argv[1:]
parts = []
for path in paths:
    try:
        clip = genga.read(path)
        keys = genga.run(clip).keys
    except genga.Error as error:
        # Skips a broken file.
        print(error, file=sys.stderr)
        continue
    seconds = keys["frame"] / clip.rate
    parts.append({"clip": np.repeat(path, len(seconds)), "seconds": seconds, **keys})

table = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
with open(out, "w", newline="", encoding="utf-8") as file:
    writer = csv.writer(file)
    writer.writerow(table)
    writer.writerows(zip(*table.values()))
print(f"{len(table['frame'])} keys of {len(parts)} clips")
