"""python strips.py PICTURE.png: a kick on five rigs, each take above its sheet, to be looked at.

Black figures are drawings that begin, grey ones are held, a band is a genga with its number. Needs pillow.
"""

import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
from PIL import Image, ImageDraw, ImageFont

import addon
import rigs

PICTURE = Path(sys.argv[1])
FOLDER = Path(tempfile.mkdtemp())
KICK = addon.DATA / "kick.bvh"
KOMA = range(30, 52)
WIDE, HIGH, FOOT, ZOOM = 72, 130, 20, 2
TAKE, BEGINS, HELD = (90, 100, 120), (25, 25, 35), (155, 155, 160)
# Fingers and faces of Rigify would be dots.
SMALL = ("f_", "thumb", "palm", "lid", "brow", "lip", "nose", "cheek", "chin", "DEF-ear", "jaw", "tongue", "temple", "forehead", "breast")

genga = addon.load()
from genga_addon import take  # noqa: E402

FONT = ImageFont.load_default(size=11 * ZOOM)


def ends(thing, names, frame):
    """Head and tail of some bones in the world."""
    bpy.context.scene.frame_set(frame)
    drawn = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    bones = [drawn.pose.bones[name] for name in names]
    return np.array([(drawn.matrix_world @ bone.head, drawn.matrix_world @ bone.tail) for bone in bones])


def figure(draw, bones, x, floor, scale, ink):
    """A body from the side; what is further away is paler."""
    middle = bones[..., 1].mean()
    for head, tail in sorted(bones, key=lambda bone: bone[0][0]):
        flat = [((x + (middle - end[1]) * scale) * ZOOM, (floor - end[2] * scale) * ZOOM) for end in (head, tail)]
        depth = 0.45 + 0.55 * np.clip((head[0] + 0.35) / 0.7, 0.0, 1.0)
        colour = tuple(int(205 - (205 - one) * depth) for one in ink)
        width = max(2, int(np.linalg.norm(head - tail) * scale * 0.16 * ZOOM))
        draw.line(flat, fill=colour, width=width)
        for px, py in flat:
            draw.ellipse((px - width / 2, py - width / 2, px + width / 2, py + width / 2), fill=colour)


def strip(name, thing):
    action = thing.animation_data.action
    begins = list(action[take.BEGINS])
    numbers = {int(marker.frame): marker.name for marker in action.pose_markers}
    clip = genga.findings.of(thing).sampled.clip
    names = [bone for bone in clip.names if not any(word in bone for word in SMALL)]
    sheet = [ends(thing, names, koma) for koma in KOMA]
    bpy.ops.genga.toggle()
    played = [ends(thing, names, koma) for koma in KOMA]
    scale = (HIGH - 22) / max(bones[..., 2].max() for bones in played)
    image = Image.new("RGB", (WIDE * len(KOMA) * ZOOM, (2 * HIGH + FOOT) * ZOOM), "white")
    draw = ImageDraw.Draw(image)
    for at, koma in enumerate(KOMA):
        x = at * WIDE
        if koma in numbers:
            draw.rectangle((x * ZOOM, HIGH * ZOOM, (x + WIDE) * ZOOM, 2 * HIGH * ZOOM), fill=(255, 244, 214))
        figure(draw, played[at], x + WIDE / 2, HIGH - 8, scale, TAKE)
        figure(draw, sheet[at], x + WIDE / 2, 2 * HIGH - 8, scale, BEGINS if koma in begins else HELD)
        told = f"{koma}  genga {numbers[koma]}" if koma in numbers else str(koma)
        draw.text(((x + 4) * ZOOM, (2 * HIGH + 2) * ZOOM), told, fill=(190, 60, 0) if koma in numbers else (90, 90, 90), font=FONT)
    draw.text((4 * ZOOM, 2 * ZOOM), f"{name}: {len(clip.names)} of {len(thing.data.bones)} bones", fill="black", font=FONT)
    return image


def main():
    makers = {
        "BVH": lambda: rigs.of_bvh(KICK, 0.01),
        "FBX": lambda: rigs.of_fbx(KICK, FOLDER),
        "VRM, avatar and motion by its add-on": lambda: rigs.of_vrm(KICK, FOLDER),
        "Rigify, hips, hands and feet keyed, IK": lambda: rigs.of_rigify(KICK),
        "Bones of MMD, legs on IK": lambda: rigs.of_mmd(KICK),
    }
    strips = []
    for name, make in makers.items():
        thing = make()
        if not hasattr(bpy.types.Object, "genga"):
            genga.register()
        assert bpy.ops.genga.find_keys() == {"FINISHED"}
        strips.append(strip(name, thing))
    whole = Image.new("RGB", (strips[0].width, sum(one.height for one in strips)), "white")
    for at, one in enumerate(strips):
        whole.paste(one, (0, at * one.height))
    whole = whole.resize((whole.width // ZOOM, whole.height // ZOOM), Image.Resampling.LANCZOS)
    whole.quantize(64, dither=Image.Dither.NONE).save(PICTURE, optimize=True)


addon.run(main)
