"""Sheets against their schemas: check.py SHEET_SCHEMA.json XDTS_SCHEMA.json SHEET.json|TIMESHEET.xdts …"""

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

    yield but("another version", lambda s: s.update(schema="genga-sheet-1"))
    yield but("no version", lambda s: s.pop("schema"))
    yield but("a field nobody knows", lambda s: s.update(note="mine"))
    yield but("frames from 1", lambda s: s.update(frame_base=1))
    yield but("drawings from 0", lambda s: layer(s)["drawings"][0].update(drawing=0))
    yield but("drawings from 0 on screen", lambda s: layer(s)["exposures"][0].update(drawing=0))
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
    yield but("a cut that begins on koma 0", lambda s: s.update(at=0))
    yield but("half a koma of a cut", lambda s: s.update(length=130.5))
    yield but("a slate with a field nobody knows", lambda s: s.update(slate={"shot": "45"}))
    if "lines" in sheet:
        yield but("koma from 0", lambda s: s["lines"][0].update(begin=0))
    if "exaggerate" in sheet:
        yield but("more ease than all", lambda s: s["exaggerate"].update(ease=1.5))


def spoilt_timesheets(timesheet):
    """Copies of an XDTS, each with one thing wrong, by what is wrong."""
    for what, spoil in [
        ("another version", lambda s: s.update(version=4)),
        ("no table", lambda s: s.update(timeTables=[])),
        ("no duration", lambda s: s["timeTables"][0].pop("duration")),
        ("a field nobody knows", lambda s: s["timeTables"][0]["fields"][0].update(fieldId=7)),
    ]:
        copied = copy.deepcopy(timesheet)
        spoil(copied)
        yield what, copied


SIGNATURE = "exchangeDigitalTimeSheet Save Data\n"


def read(path):
    """What a file holds, and whether it is an XDTS."""
    with open(path, encoding="utf-8", newline="") as file:
        text = file.read()
    return json.loads(text.removeprefix(SIGNATURE)), text.startswith(SIGNATURE)


def validator_of(kind, path):
    schema, _ = read(path)
    kind.check_schema(schema)
    return kind(schema)


def main(sheet_schema, xdts_schema, *paths):
    sheets = validator_of(jsonschema.Draft202012Validator, sheet_schema)
    timesheets = validator_of(jsonschema.Draft7Validator, xdts_schema)
    blends = exaggerated = count = 0
    for path in paths:
        held, is_xdts = read(path)
        validator, wrongs = (timesheets, spoilt_timesheets) if is_xdts else (sheets, spoilt)
        for error in validator.iter_errors(held):
            sys.exit(f"{path}: {error.json_path}: {error.message}")
        for what, wrong in wrongs(held):
            if validator.is_valid(wrong):
                sys.exit(f"{path}: the schema takes {what}")
        count += is_xdts
        if not is_xdts:
            blends += sum("between" in d for layer in held["layers"] for d in layer["drawings"])
            exaggerated += "exaggerate" in held
    if not (blends and exaggerated and count):
        sys.exit("no sheet has a blend, none is exaggerated, or there is no XDTS: the check looks at too little")
    print(f"{len(paths) - count} sheets and {count} XDTS satisfy their schemas, {blends} blends among the drawings")


main(*sys.argv[1:])
