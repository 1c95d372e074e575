# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work in steps: the window responds meanwhile, shows how far it is, and Esc cancels."""

import time
from typing import NamedTuple

from .refused import Reported

# Longest time that Blender's window is blocked, and interval at which work on another thread is looked at, in seconds.
SLICE, LOOK = 0.05, 0.02


class Progress(NamedTuple):
    """How far the work is. Without a `count` another thread works, and there is nothing to do but wait."""

    what: str
    at: int = 0
    count: int = 0


class Stepwise(Reported):
    """An operator whose `steps` yields a `Progress` after each part of its work, and says the result before it ends."""

    def run(self, context):
        """Runs everything at once, for scripts."""
        for progress in self.steps(context):
            if not progress.count:
                time.sleep(LOOK)
        return {"FINISHED"}

    def invoke(self, context, _event):
        return self.reported(lambda: self.begin(context))

    def begin(self, context):
        self.going = self.steps(context)
        manager = context.window_manager
        self.timer = manager.event_timer_add(LOOK, window=context.window)
        manager.progress_begin(0, 100)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.end(context)
            self.report({"INFO"}, "Nothing was changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        done = self.reported(lambda: self.go_on(context))
        if done != {"RUNNING_MODAL"}:
            self.end(context)
        return done

    def go_on(self, context):
        """Works for a slice of time, or until there is nothing to do but wait."""
        until = time.perf_counter() + SLICE
        for progress in self.going:
            if not progress.count or time.perf_counter() > until:
                self.tell(context, progress)
                return {"RUNNING_MODAL"}
        return {"FINISHED"}

    def tell(self, context, progress):
        if progress.count:
            context.window_manager.progress_update(100 * progress.at // progress.count)
        where = f" {progress.at} of {progress.count}" if progress.count else ""
        context.workspace.status_text_set(f"genga: {progress.what}{where}. Esc cancels")

    def cancel(self, context):
        """Ends the work when another file is opened meanwhile."""
        self.end(context)

    def end(self, context):
        """Restores Blender's state, except for the result."""
        self.going.close()
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
