"""Opens a recording with its layout in Lichtblick, as foxglove.py does in Foxglove Studio.

usage: lichtblick.py WEB RECORDING.mcap OUT.png    (with RECORDING.foxglove.json beside it)

WEB is the directory of Lichtblick's built web page.
"""

import functools
import json
import sys
from pathlib import Path

from foxglove import shown

# Placeholder that Lichtblick's container replaces by a layout.
PLACE = "/*LICHTBLICK_SUITE_DEFAULT_LAYOUT_PLACEHOLDER*/"


def page(web, layout):
    """A function that writes Lichtblick with a layout into a directory, and returns the name of the page."""

    def put(root):
        for file in Path(web).resolve().iterdir():
            if file.name != "index.html":
                (root / file.name).symlink_to(file)
        text = (Path(web) / "index.html").read_text()
        if PLACE not in text:
            sys.exit(f"{web}/index.html is not a page of Lichtblick: the placeholder for a layout is missing")
        (root / "index.html").write_text(text.replace(PLACE, json.dumps(layout)))
        return "index.html"

    return put


def main(web, recording, out):
    """Shows the recording."""
    shown(functools.partial(page, web), "?ds=remote-file&ds.url={origin}/own.mcap", recording, out)


main(*sys.argv[1:])
