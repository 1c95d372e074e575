"""Motion capture to Japanese limited animation (リミテッドアニメーション).

>>> import genga
>>> result = genga.run("data/kick.bvh", keys={"min_price": 15}, pins=[30])
>>> result.keys["frame"]

Array shapes use F frames, J joints and K koma (コマ). Settings are in degrees, `Result.speeds` in radians per second,
lengths in the unit of the file. A frame has its number in the file, from 0. Arrays begin at the clip's first frame, so
row r is frame `clip.first + r`. Koma count from 0.
"""

from collections.abc import MutableMapping as _MutableMapping

from ._genga import (
    Clip,
    Error,
    Omitted,
    Recipe,
    Result,
    Sheet,
    __version__,
    compare,
    evaluate,
    formats,
    knobs,
    omit,
    read,
    run,
    study,
    tangents,
)
from ._study import Study

_MutableMapping.register(Recipe)

__all__ = [
    "Clip",
    "Error",
    "Omitted",
    "Recipe",
    "Result",
    "Sheet",
    "Study",
    "__version__",
    "compare",
    "evaluate",
    "formats",
    "knobs",
    "omit",
    "read",
    "run",
    "study",
    "tangents",
]
