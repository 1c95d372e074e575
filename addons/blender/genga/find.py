# SPDX-License-Identifier: GPL-3.0-or-later
"""Find Keys: samples the rig, runs genga, and writes the keys into a separate action."""

from bpy.types import Operator

from . import findings, knobs, preferences
from .modal import Progress, Stepwise
from .refused import Refused
from .run import Finding, Work
from .sample import Sampling
from .subject import armature_of, editable
from .take import Take


class GENGA_OT_find_keys(Stepwise, Operator):
    """Find the key drawings of the armature's take, and write them as constant keys into a separate action. Esc cancels"""

    bl_idname = "genga.find_keys"
    bl_label = "Find Keys"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if armature_of(context) is None:
            cls.poll_message_set("Select the armature that plays the take, or its mesh")
            return False
        return True

    def steps(self, context):
        """Samples the take, lets genga work on another thread, and applies its result."""
        thing = editable(context)
        sampling = Sampling(context, thing)
        yield from sampling.steps()
        finding, uid = Finding(sampling.sampled()), thing.session_uid
        with knobs.begun(thing, preferences.of(context).preset):
            findings.ask(context.scene, thing, Take(thing), finding)
            work = Work(finding.find)
            while work.is_alive():
                yield Progress("finding keys")
            work.result()
        self.finish(context, uid, finding)

    def finish(self, context, uid, finding):
        # An undo in the meantime has made all objects anew.
        thing = next((thing for thing in context.scene.objects if thing.session_uid == uid), None)
        if thing is None:
            raise Refused("the armature no longer exists")
        findings.keep(thing, finding)
        told, left_out = findings.put(context.scene, thing, Take(thing), finding)
        for sentence in left_out:
            self.report({"WARNING"}, sentence)
        self.report({"INFO"}, ". ".join(told))
