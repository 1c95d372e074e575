"""python make.py FOLDER CLIP.bvh…: each clip as Blender imports it and writes it again, an FBX and a GLB."""

import sys
from pathlib import Path

import bpy

folder = Path(sys.argv[1])
for clip in map(Path, sys.argv[2:]):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_anim.bvh(filepath=str(clip), global_scale=0.01, update_scene_fps=True)
    scene = bpy.context.scene
    first, last = bpy.context.object.animation_data.action.frame_range
    scene.frame_start, scene.frame_end = round(first), round(last)
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
