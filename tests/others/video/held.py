"""A video shows each drawing for as long as the sheet holds it: held.py SHEET.json FILM.gray WIDTH HEIGHT.

The right half is the result. Its figure changes between two koma where another drawing stands, and only there.
"""

import json
import sys
from pathlib import Path

sheet, film = Path(sys.argv[1]), Path(sys.argv[2]).read_bytes()
width, height = map(int, sys.argv[3:])
(layer,) = json.loads(sheet.read_text(encoding="utf-8"))["layers"]
shown = [exposure["drawing"] for exposure in layer["exposures"] for _ in range(exposure["koma"])]
size = width * height
assert len(film) == size * len(shown), (len(film) / size, len(shown))


def figure(koma):
    """The middle of the right half: without the numbers above and the bars below."""
    rows = range(60, height - 70)
    return b"".join(film[koma * size + row * width + width // 2 : koma * size + (row + 1) * width] for row in rows)


def share_changed(koma):
    """Of the pixels those that are clearly another grey than before; packing changes all a little."""
    before, now = figure(koma - 1), figure(koma)
    return sum(abs(a - b) > 48 for a, b in zip(before, now)) / len(now)


still = [share_changed(koma) for koma in range(1, len(shown)) if shown[koma] == shown[koma - 1]]
moved = [share_changed(koma) for koma in range(1, len(shown)) if shown[koma] != shown[koma - 1]]
assert max(still) < min(moved), (max(still), min(moved))
print(f"{len(shown)} koma: held {len(still)} times, at most {max(still):.4f} of the figure changes; else at least {min(moved):.4f}")
