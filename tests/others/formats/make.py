"""python make.py FOLDER CLIP.bvh…: each clip as Blender imports it and writes it again, an FBX and a GLB.

For assimp there is the clip under a root that stands still.

MMD has 30 frames a second. So Blender takes each curve at these instants too, and of that take a BVH and a VMD are made,
with Y up as in the clip.
"""

import sys
from pathlib import Path

import bpy

import mmd


def resample(scene, action):
    """Puts the curves of an action on frames from 0 on, 30 a second."""
    first, step = scene.frame_start, scene.render.fps / scene.render.fps_base / mmd.RATE
    frames = range(int((scene.frame_end - first) / step + 1e-6) + 1)
    for curve in action.fcurves:
        values = [curve.evaluate(first + step * frame) for frame in frames]
        curve.keyframe_points.clear()
        curve.keyframe_points.add(len(frames))
        curve.keyframe_points.foreach_set("co", [x for pair in zip(frames, values) for x in pair])
        curve.update()
    scene.render.fps, scene.render.fps_base = mmd.RATE, 1.0
    scene.frame_start, scene.frame_end = 0, len(frames) - 1


def opened(clip, **axes):
    """The scene of a clip alone, its length and its armature."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_anim.bvh(filepath=str(clip), global_scale=0.01, update_scene_fps=True, **axes)
    first, last = map(round, bpy.context.object.animation_data.action.frame_range)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = first, last
    return scene, bpy.context.object


def carried(clip):
    """The text of a clip under a root that stands still: assimp takes the root for its scene, which FBX leaves out."""
    head, motion = clip.read_text(encoding="utf-8").split("MOTION", 1)
    still = "ROOT carrier\n{\nOFFSET 0 0 0\nCHANNELS 0\nJOINT"
    return head.replace("ROOT", still, 1) + "}\nMOTION" + motion


folder = Path(sys.argv[1])
for clip in map(Path, sys.argv[2:]):
    (folder / f"{clip.stem}-carried.bvh").write_text(carried(clip), encoding="utf-8")
    opened(clip)
    bpy.ops.export_scene.fbx(
        filepath=str(folder / f"{clip.stem}.fbx"),
        bake_anim_simplify_factor=0.0,
        bake_anim_use_nla_strips=False,
        bake_anim_use_all_actions=False,
    )
    bpy.ops.export_scene.gltf(
        filepath=str(folder / f"{clip.stem}.glb"),
        export_force_sampling=True,
        export_optimize_animation_size=False,
        # Tips of bones, which its FBX has without being asked.
        export_leaf_bone=True,
    )
    scene, armature = opened(clip, axis_forward="Y", axis_up="Z")
    resample(scene, armature.animation_data.action)
    frames = {"frame_start": scene.frame_start, "frame_end": scene.frame_end}
    bpy.ops.export_anim.bvh(filepath=str(folder / f"{clip.stem}-30.bvh"), global_scale=100.0, **frames)
    mmd.write(folder, clip.stem, scene, armature)
