"""genga's work on what was sampled: on a thread of its own, and again from where a knob changes it. Knows nothing of Blender."""

import json
import threading

from . import feet, fit
from .files import Sheet
from .refused import Refused, engine


class Finding:
    """What was sampled of an object, and the last result of it."""

    def __init__(self, sampled):
        self.sampled = sampled
        self.result = None

    def find(self, recipe, targets):
        """The result; an earlier one lends what it has made."""
        try:
            if self.result is None:
                self.result = engine().run(self.sampled.clip, recipe, targets=targets)
            else:
                self.result = self.result.again(recipe, targets=targets)
        except engine().Error as error:
            raise Refused(f"{error} (frames are those of the take: its frame 0 is {self.sampled.start} here)") from error
        return self.result

    def sheet(self):
        return Sheet(json.loads(self.result.to_json()["sheet.json"]))

    def turns(self, sheet):
        """How the legs turn so that the feet of a sheet are held: see `feet`."""
        if not fit.can_hold(sheet):
            return {}
        free = self.result.again(feet="free")
        return feet.turns(self.result.limited, free.limited, self.sampled.rest)

    def told(self):
        """What was found, in a sentence each."""
        report = self.result.report
        found = f"{report['genga']} genga, {report['drawings']} drawings on {report['koma']} koma"
        missed = [outcome["words"] for outcome in self.result.outcomes if outcome["why"]]
        return [found, *missed]


class Work(threading.Thread):
    """Work beside Blender's own. Who does not want its result any more forgets it."""

    def __init__(self, work):
        super().__init__(daemon=True)
        self.work, self.made, self.error = work, None, None
        self.start()

    def run(self):
        try:
            self.made = self.work()
        # Told where the result is asked for.
        except Exception as error:  # noqa: BLE001
            self.error = error

    def result(self):
        if self.error is not None:
            raise self.error
        return self.made
