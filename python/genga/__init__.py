"""Motion capture to Japanese limited animation (リミテッドアニメーション).

>>> import genga
>>> clip = genga.read("data/kick.bvh")
>>> result = genga.run(clip, keys={"min_price": 15}, pins=[30])
>>> result.keys["frame"]

Shapes are told by F frames, J joints and K koma (コマ). Angles are in degrees in settings and in radians a second
in `Result.speeds`; lengths are in the unit of the file. Frames carry their number in the file, from 0; rows of
arrays begin at the clip's first frame, so that row r is frame `clip.first + r`. Koma count from 0.
"""

from collections.abc import MutableMapping as _MutableMapping

from ._genga import (
    Clip,
    Error,
    Recipe,
    Result,
    Sheet,
    __version__,
    compare,
    evaluate,
    formats,
    knobs,
    read,
    run,
    study,
)

_MutableMapping.register(Recipe)

__all__ = [
    "Clip",
    "Error",
    "Recipe",
    "Result",
    "Sheet",
    "__version__",
    "compare",
    "evaluate",
    "formats",
    "knobs",
    "read",
    "run",
    "study",
]
