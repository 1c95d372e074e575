# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs genga on a sampled take, on a separate thread, and reruns changed stages. Independent of Blender."""

import json
import threading

from . import feet, fit
from .files import Sheet
from .refused import Refused, engine

# Begin of genga's sentence about a take that is no cycle.
NO_CYCLE = "loop: "


class Finding:
    """The sampled take of an armature, what was asked of it (a recipe and targets), and its last result."""

    def __init__(self, sampled):
        self.sampled = sampled
        self.asked, self.result = None, None

    def find(self):
        """Returns the result. Reuses the stages of an earlier one."""
        recipe, targets = self.asked
        try:
            if self.result is None:
                self.result = engine().run(self.sampled.clip, recipe, targets=targets)
            else:
                self.result = self.result.again(recipe, targets=targets)
        except engine().Error as error:
            raise Refused(self.in_blender(str(error))) from error
        return self.result

    def in_blender(self, message):
        """Returns an error of genga with the way out in Blender."""
        start = self.sampled.start
        if not message.startswith(NO_CYCLE):
            return f"{message} (frames count from the take's start, which is frame {start} here)"
        rounds = self.sampled.clip.cycles()
        message = message[len(NO_CYCLE) :].partition(";")[0]
        if not len(rounds["first"]):
            return f"a loop needs a round: {message}, and no part of the take is one"
        first, last, pose = (rounds[name][0] for name in ("first", "last", "pose"))
        return (
            f"a loop needs a round: {message}. Frames {first + start} to {last + start} are one ({pose:.1f} %): make "
            "them the preview range, and set Frames to Scene"
        )

    def sheet(self):
        return Sheet(json.loads(self.result.to_json()["sheet.json"]))

    def turns(self, sheet):
        """Returns the leg rotations that hold the sheet's feet: see `feet`."""
        if not fit.can_hold(sheet):
            return {}
        free = self.result.again(feet="free")
        return feet.turns(self.result.limited, free.limited, self.sampled.rest)

    def told(self):
        """Describes the result, one sentence per item."""
        report = self.result.report
        found = f"{report['genga']} genga, {report['drawings']} drawings on {report['koma']} koma"
        missed = [outcome["words"] for outcome in self.result.outcomes if outcome["why"]]
        return [found, *missed]


class Work(threading.Thread):
    """Work on a separate thread. To cancel it, discard its result."""

    def __init__(self, work):
        super().__init__(daemon=True)
        self.work, self.made, self.error = work, None, None
        self.start()

    def run(self):
        try:
            self.made = self.work()
        # Raised again in `result`.
        except Exception as error:  # noqa: BLE001
            self.error = error

    def result(self):
        self.join()
        if self.error is not None:
            raise self.error
        return self.made
