"""Each koma of a decoded film shows the picture that the table names: check.py REMAP.csv FILM.rgb [PICTURES_PER_FRAME]."""

import csv
import sys
from pathlib import Path

rows = list(csv.DictReader(Path(sys.argv[1]).open(newline="")))
film = Path(sys.argv[2]).read_bytes()
per_frame = float(sys.argv[3]) if len(sys.argv) > 3 else 1.0
picture = 16 * 16 * 3
shown = [film[at] + 256 * film[at + 1] for at in range(0, len(film), picture)]
wanted = [float(row["source_frame"]) * per_frame for row in rows]
assert len(shown) == len(wanted), len(shown) - len(wanted)
far = [(koma, *pair) for koma, pair in enumerate(zip(shown, wanted)) if abs(pair[0] - pair[1]) > 0.5 + 1e-9]
assert not far, far[:9]
assert len(set(shown)) > 10
print(f"{len(shown)} koma of {len(set(shown))} pictures: ffmpeg shows the nearest to the frames of {sys.argv[1]}")
