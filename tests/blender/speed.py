"""python speed.py [FRAMES [BONES]]: how long Find Keys takes on a long take, part by part."""

import sys
import time

import bpy
import numpy as np

import addon
import rigs

FRAMES = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
BONES = int(sys.argv[2]) if len(sys.argv) > 2 else 60

genga = addon.load()
from genga_addon import findings, sample, stepping, take  # noqa: E402
from genga_addon.run import Finding  # noqa: E402


def long_take():
    """A body with more bones in its hands, whose motion goes on and on."""
    thing = rigs.of_bvh(addon.DATA / "kick.bvh", 0.01)
    bpy.ops.object.mode_set(mode="EDIT")
    bones = thing.data.edit_bones
    for at in range(BONES - len(bones)):
        parent = bones["LeftHand" if at % 2 else "RightHand"]
        bone = bones.new(f"finger {at}")
        bone.head, bone.tail, bone.parent = parent.tail, parent.tail + parent.vector * 0.3, parent
    bpy.ops.object.mode_set(mode="OBJECT")
    action = thing.animation_data.action
    frames = np.arange(FRAMES, dtype=np.float64)
    for curve in stepping.curves(action, getattr(thing.animation_data, "action_slot", None)):
        # To and fro, a little faster every time.
        there = 1.0 + (91.0 - np.abs((frames * (1.0 + frames / FRAMES)) % 182.0 - 91.0))
        values = np.array([curve.evaluate(place) for place in there])
        curve.keyframe_points.clear()
        curve.keyframe_points.add(FRAMES)
        curve.keyframe_points.foreach_set("co", np.stack([frames + 1.0, values], 1).ravel())
        curve.update()
    return thing


def timed(what, work):
    began, busy = time.perf_counter(), time.process_time()
    made = work()
    took[what] = time.perf_counter() - began, time.process_time() - busy
    return made


took = {}


def main():
    thing = long_take()
    genga.register()
    sampling = sample.Sampling(bpy.context, thing)
    timed("Blender evaluates and is sampled", lambda: [None for _ in sampling.steps()])
    sampled = timed("matrices become a clip", sampling.sampled)
    own = Finding(sampled)
    findings.ask(bpy.context.scene, thing, sampling.take, own)
    findings.keep(thing, own)
    timed("genga finds the keys", own.find)
    timed("keys are put onto the rig", lambda: findings.put(bpy.context.scene, thing, take.Take(thing), own))
    timed("a knob is turned (on threes), all of it", lambda: setattr(thing.genga, "on", "3"))
    timed("keys with curves are fitted", bpy.ops.genga.curves)
    print(f"{FRAMES} frames, {len(sampled.clip.names)} bones, Blender {bpy.app.version_string}")
    print("   clock, processor")
    for what, (seconds, busy) in took.items():
        print(f"{seconds:6.2f} s {busy:6.2f} s  {what}")
    share = took["genga finds the keys"][1] / took["Blender evaluates and is sampled"][1]
    print(f"genga takes {share:.3f} of the processor's time that Blender's own evaluation takes")


addon.run(main)
