"""Sheets against their schema: check.py SCHEMA.json SHEET.json …"""

import copy
import json
import sys

import jsonschema


def spoilt(sheet):
    """Copies of a sheet, each with one thing wrong, by what is wrong."""

    def but(what, spoil):
        copied = copy.deepcopy(sheet)
        spoil(copied)
        return what, copied

    def layer(sheet):
        return sheet["layers"][0]

    yield but("another version", lambda s: s.update(schema="genga-sheet-2"))
    yield but("no version", lambda s: s.pop("schema"))
    yield but("a field nobody knows", lambda s: s.update(note="mine"))
    yield but("koma from 1", lambda s: s.update(frame_base=1))
    yield but("no clip", lambda s: s.pop("clip"))
    yield but("half a frame to begin with", lambda s: s["clip"].update(first_frame=0.5))
    yield but("a setting that is no word", lambda s: s["made_with"]["recipe"].update(rate=24))
    yield but("no frame at all", lambda s: layer(s)["drawings"][0].update(frame=None))
    yield but("no koma", lambda s: layer(s)["exposures"][0].update(koma=0))
    yield but("half a koma", lambda s: layer(s)["exposures"][0].update(koma=1.5))
    yield but("a nameless drawing", lambda s: layer(s)["drawings"][0].pop("drawing"))
    yield but("another role", lambda s: layer(s)["drawings"][0].update(role="key"))
    yield but("no source", lambda s: layer(s)["drawings"][0].pop("frame"))
    yield but("two sources", lambda s: layer(s)["drawings"][0].update(between=[0, 1], share=0.5))
    yield but("half a blend", lambda s: layer(s)["drawings"][0].update(share=0.5))
    yield but("a reason nobody knows", lambda s: layer(s)["drawings"][0].update(why={"because": 1}))


def main(schema_path, *sheet_paths):
    with open(schema_path, encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    blends = 0
    for path in sheet_paths:
        with open(path, encoding="utf-8") as file:
            sheet = json.load(file)
        for error in validator.iter_errors(sheet):
            sys.exit(f"{path}: {error.json_path}: {error.message}")
        blends += sum("between" in d for layer in sheet["layers"] for d in layer["drawings"])
        for what, wrong in spoilt(sheet):
            if validator.is_valid(wrong):
                sys.exit(f"{path}: the schema takes {what}")
    if not blends:
        sys.exit("no sheet has a blend: the check looks at too little")
    print(f"{len(sheet_paths)} sheets satisfy the schema, {blends} blends among their drawings")


main(*sys.argv[1:])
