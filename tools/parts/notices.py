"""The licences of all packages that a program for a system is built of, on stdout: notices.py TARGET."""

import json
import subprocess
import sys
from pathlib import Path

command = ["cargo", "metadata", "--locked", "--format-version", "1", "--filter-platform", sys.argv[1]]
told = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
nodes = {node["id"]: node for node in told["resolve"]["nodes"]}
packages = {package["id"]: package for package in told["packages"]}

# What is linked in: neither what builds nor what tests.
open_, linked = [told["resolve"]["root"]], set()
while open_:
    one = open_.pop()
    if one in linked:
        continue
    linked.add(one)
    normal = lambda dep: any(kind["kind"] is None for kind in dep["dep_kinds"])
    open_ += [dep["pkg"] for dep in nodes[one]["deps"] if normal(dep)]

by_text = {}
for package in sorted((packages[one] for one in linked), key=lambda package: package["name"]):
    if package["source"] is None:
        continue
    title = f"{package['name']} {package['version']}, {package['license']}"
    folder = Path(package["manifest_path"]).parent
    found = [path for path in sorted(folder.iterdir()) if path.name.upper().startswith(("LICENSE", "LICENCE", "COPYING", "NOTICE"))]
    texts = [path.read_text(encoding="utf-8", errors="replace").strip() for path in found if path.is_file()]
    by_text.setdefault("\n\n".join(texts), []).append(title)

print("genga is built of these packages, each under its own licence.")
for text, titles in by_text.items():
    print("\n" + "=" * 80, *titles, "-" * 80, text or "The package has no text of its licence; its expression stands above.", sep="\n")
