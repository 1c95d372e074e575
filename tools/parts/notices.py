"""The licences of all that is linked into a package for a system, on stdout: notices.py PACKAGE TARGET [OPTION OF CARGO…]."""

import json
import subprocess
import sys
from pathlib import Path

PACKAGE, TARGET, *OPTIONS = sys.argv[1:]
ROOT = Path(__file__).resolve().parents[2]

# What comes without a text of its licence, and may not be taken by Apache's: by which it is, and whose it is.
TAKEN = {
    "ufbx": ("MIT", "Copyright (c) 2022 Samuli Raivio"),
    **dict.fromkeys(("block2", "objc2", "objc2-encode"), ("MIT", "Copyright Mads Marquart")),
}
# What no package of Cargo is and is linked all the same, where a target's name has the word.
BESIDE = [
    ("", "the standard library of Rust, MIT OR Apache-2.0", ("APACHE", "")),
    ("musl", "musl, MIT", ("MIT", "Copyright (c) 2005-2020 Rich Felker, et al.")),
]


def told(*command):
    return subprocess.run(["cargo", *command], check=True, capture_output=True, text=True, cwd=ROOT).stdout


def linked():
    """Name and version of each package that is linked in: neither what builds, nor what tests, nor what writes code."""
    options = ["--package", PACKAGE, "--target", TARGET, *OPTIONS, "--edges", "normal,no-proc-macro"]
    lines = told("tree", "--locked", *options, "--prefix", "none", "--format", "{p}").splitlines()
    return {tuple(line.split()[:2]) for line in lines if line.strip()}


def by_name(licence, whose):
    """A licence that this folder has too, with another name in it."""
    text = (ROOT / f"LICENSE-{licence}").read_text(encoding="utf-8").strip()
    own = next(line for line in text.splitlines() if line.startswith("Copyright (c)")) if whose else None
    return text.replace(own, whose) if whose else text


def texts_of(package):
    """The texts that a package has, else the one that it is taken by."""
    beginnings = ("LICENSE", "LICENCE", "COPYING", "NOTICE")
    folder = Path(package["manifest_path"]).parent
    found = [path for path in sorted(folder.iterdir()) if path.is_file() and path.name.upper().startswith(beginnings)]
    if found:
        return [path.read_text(encoding="utf-8", errors="replace").strip() for path in found]
    name, licence = package["name"], package["license"]
    taken = TAKEN.get(name) or (("APACHE", "") if "Apache-2.0" in licence else None)
    return [by_name(*taken)] if taken else sys.exit(f"{name}, {licence}, has no text of it: give it a row in {__file__}")


everything = json.loads(told("metadata", "--locked", "--all-features", "--format-version", "1"))["packages"]
is_in, texts = linked(), {}
unknown = is_in - {(one["name"], f"v{one['version']}") for one in everything}
if unknown:
    sys.exit(f"cargo metadata does not know {sorted(unknown)}")


def add(title, text):
    """The same words with other line ends are the same text."""
    texts.setdefault(" ".join(text.split()), (text, []))[1].append(title)


for one in sorted(everything, key=lambda one: one["name"]):
    if one["source"] is not None and (one["name"], f"v{one['version']}") in is_in:
        for text in texts_of(one):
            add(f"{one['name']} {one['version']}, {one['license']}", text)
for word, title, taken in BESIDE:
    if word in TARGET:
        add(title, by_name(*taken))

print("genga is built of these packages, each under its own licence.")
for text, titles in texts.values():
    print("\n" + "=" * 80, *titles, "-" * 80, text, sep="\n")
