"""The table of a study."""

from typing import Any

import numpy.typing as npt

from ._genga import Recipe


class Study(dict[str, npt.NDArray[Any]]):
    """The columns of a study by name, one row per combination.

    `recipe` is the recipe that was used, where the axes do not vary it: if none was given, `Recipe.table_1()` or
    `Recipe()`, with the settings of the call. `notes` say what frames on an axis are in seconds, at each frame rate of
    the clips.
    """

    recipe: Recipe
    notes: list[str]
