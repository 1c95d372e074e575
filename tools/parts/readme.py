"""Fits the pages of a package to it: the program is there, and nothing is to be built. Fails if a page links to a file
that the package does not have: `readme.py FOLDER VERSION`."""

import re
import sys
from pathlib import Path

folder, version = Path(sys.argv[1]), sys.argv[2]

# What README has from one line up to another, and what stands there in a package.
RUN = "./genga run data/kick.bvh --out kick-genga"
PARTS = {
    "README.md": (
        "## Get it",
        "The first prints:",
        f"""## Run it

Nothing is to be built. In this folder, `{RUN}` makes the first sheet; on Windows write `.\\genga`. Do the same
wherever `genga` stands below, or put this folder into PATH. The studio is `genga-{version}-browser.zip` of this
release: unpack it and open `index.html`. [Is it for me?](docs/for-me.md) The command prints:""",
    ),
    "README.ja.md": (
        "## 入手する",
        "最初のコマンドは次のように表示します。",
        f"""## 動かす

ビルドは不要です。このフォルダーで `{RUN}` を実行すると、最初のシートができます（Windows は `.\\genga`）。
以下の `genga` も同じように書くか、このフォルダーを PATH に入れてください。スタジオはこのリリースの
`genga-{version}-browser.zip` です。展開して `index.html` を開きます。[3分で試す方法](docs/for-me.ja.md)
コマンドは次のように表示します。""",
    ),
}


def fitted(name, text):
    begin, end, own = PARTS[name]
    head, found, rest = text.partition(begin + "\n")
    _, found_end, tail = rest.partition(end)
    if not (found and found_end):
        sys.exit(f"{name} has no part from {begin!r} to {end!r}: see tools/parts/readme.py")
    return head + own + tail


def dead_links(page):
    for link in re.findall(r"\]\(([^)#\s]+)", page.read_text()):
        if ":" not in link and not (page.parent / link).exists():
            yield f"{page.relative_to(folder)} -> {link}"


for name in PARTS:
    page = folder / name
    page.write_text(fitted(name, page.read_text()))
dead = [link for page in sorted(folder.rglob("*.md")) for link in dead_links(page)]
if dead:
    sys.exit("dead links in the package:\n" + "\n".join(dead))
