"""Pictures of a source, each in a colour that is its frame's: pictures.py REMAP.csv FOLDER."""

import csv
import sys
from pathlib import Path

table, folder = Path(sys.argv[1]), Path(sys.argv[2])
frames = [int(row["nearest_frame"]) for row in csv.DictReader(table.open(newline=""))]
for frame in range(max(frames) + 1):
    colour = bytes([frame % 256, frame // 256, 128])
    # Blender's numbers: frame 0 is picture 1.
    (folder / f"{frame + 1:04}.ppm").write_bytes(b"P6\n16 16\n255\n" + 256 * colour)
