# SPDX-License-Identifier: GPL-3.0-or-later
"""Find Keys: samples the rig, runs genga, and writes the keys into a separate action."""

import time

from bpy.types import Operator

from . import findings
from .refused import Reported, Refused
from .run import Finding, Work
from .sample import Sampling
from .take import Take

# Longest time that Blender's window is blocked, and interval at which genga's thread is polled, in seconds.
SLICE, LOOK = 0.05, 0.02


class GENGA_OT_find_keys(Reported, Operator):
    """Find the key drawings of the armature's take, and write them as constant keys into a separate action. Esc cancels"""

    bl_idname = "genga.find_keys"
    bl_label = "Find Keys"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        thing = context.active_object
        if thing is None or thing.type != "ARMATURE":
            cls.poll_message_set("Select the armature that plays the take")
            return False
        return True

    def run(self, context):
        """Runs everything at once, for scripts."""
        sampling = Sampling(context, context.active_object.genga)
        for _ in sampling.steps():
            pass
        self.begin_work(context, sampling)
        self.work.join()
        return self.finish(context)

    def invoke(self, context, _event):
        return self.reported(lambda: self.begin(context))

    def begin(self, context):
        """Runs step by step, so that the window responds and Esc cancels."""
        self.sampling = Sampling(context, context.active_object.genga)
        self.steps, self.work = self.sampling.steps(), None
        manager = context.window_manager
        self.timer = manager.event_timer_add(LOOK, window=context.window)
        manager.progress_begin(0, len(self.sampling))
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.end(context)
            self.report({"INFO"}, "Nothing was changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        done = self.reported(lambda: self.part(context))
        if done != {"RUNNING_MODAL"}:
            self.end(context)
        return done

    def part(self, context):
        """Samples more frames. After the last one starts genga, and finally applies its result."""
        if self.work is None:
            until = time.perf_counter() + SLICE
            for row in self.steps:
                if time.perf_counter() > until:
                    self.tell(context, row)
                    return {"RUNNING_MODAL"}
            self.begin_work(context, self.sampling)
        if self.work.is_alive():
            return {"RUNNING_MODAL"}
        return self.finish(context)

    def tell(self, context, row):
        context.window_manager.progress_update(row)
        context.workspace.status_text_set(f"genga: frame {row + 1} of {len(self.sampling)}. Esc cancels")

    def begin_work(self, context, sampling):
        sampled = sampling.sampled()
        self.owner = sampling.thing.name
        self.finding = Finding(sampled)
        asked = findings.asked(sampling.thing, sampling.take, sampled)
        self.work = Work(lambda: self.finding.find(*asked))

    def finish(self, context):
        self.work.result()
        thing = context.scene.objects.get(self.owner)
        if thing is None:
            raise Refused(f"{self.owner} no longer exists")
        findings.FINDINGS[self.owner] = self.finding
        told, left_out = findings.put(context.scene, thing, Take(thing), self.finding)
        for sentence in left_out:
            self.report({"WARNING"}, sentence)
        self.report({"INFO"}, ". ".join(told))
        return {"FINISHED"}

    def end(self, context):
        """Restores Blender's state, except for the result."""
        self.steps.close()
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
