"""Pictures of a source, each in a colour of its own: pictures.py REMAP.csv FOLDER [PICTURES_PER_FRAME]."""

import csv
import sys
from pathlib import Path

table, folder = Path(sys.argv[1]), Path(sys.argv[2])
per_frame = float(sys.argv[3]) if len(sys.argv) > 3 else 1.0
frames = [int(row["nearest_frame"]) for row in csv.DictReader(table.open(newline=""))]
for picture in range(round(max(frames) * per_frame) + 1):
    colour = bytes([picture % 256, picture // 256, 128])
    # Blender's numbers: frame 0 is picture 1.
    (folder / f"{picture + 1:04}.ppm").write_bytes(b"P6\n16 16\n255\n" + 256 * colour)
