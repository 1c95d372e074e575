"""Holds a VMD, as PyPI's pypmxvmd reads it, against what was meant: all six sections, IK too."""

import json
import struct
import sys

import pypmxvmd


def single(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


for stem in sys.argv[1:]:
    with open(f"{stem}.json", encoding="utf-8") as file:
        meant = json.load(file)
    read = pypmxvmd.load_vmd(f"{stem}.vmd")
    assert read.header.version == 2 and read.header.model_name == meant["model"], stem
    assert len(read.bone_frames) == len(meant["keys"]), stem
    for at, (frame, key) in enumerate(zip(read.bone_frames, meant["keys"])):
        where = f"{stem}, record {at}"
        assert (frame.bone_name, frame.frame_number) == (key["bone"], key["frame"]), where
        assert list(frame.position) == [single(x) for x in key["translation"]], where
    for others in (read.morph_frames, read.camera_frames, read.light_frames, read.shadow_frames):
        assert not others, stem
    (ik,) = read.ik_frames
    assert ik.frame_number == 0 and ik.display, stem
    assert [bone.bone_name for bone in ik.ik_bones] == meant["ik_off"], stem
    assert not any(bone.ik_enabled for bone in ik.ik_bones), stem
    print(f"pypmxvmd: {stem.split('/')[-1]}: all six sections as meant")
