"""Each koma of a decoded film shows the frame that the table names: check.py REMAP.csv FILM.rgb."""

import csv
import sys
from pathlib import Path

rows = list(csv.DictReader(Path(sys.argv[1]).open(newline="")))
film = Path(sys.argv[2]).read_bytes()
picture = 16 * 16 * 3
shown = [film[at] + 256 * film[at + 1] for at in range(0, len(film), picture)]
wanted = [int(row["nearest_frame"]) for row in rows]
assert shown == wanted, len(shown) - len(wanted) or [(koma, *pair) for koma, pair in enumerate(zip(shown, wanted)) if pair[0] != pair[1]][:9]
assert len(set(shown)) > 10
print(f"{len(shown)} koma of {len(set(shown))} pictures: ffmpeg shows the frames of {sys.argv[1]}")
