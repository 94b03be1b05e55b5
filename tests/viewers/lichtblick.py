"""Opens a recording with its layout in Lichtblick.

usage: lichtblick.py WEB RECORDING.mcap OUT.png    (with RECORDING.foxglove.json beside it)

WEB is the directory with Lichtblick's web page, ready made.
"""

import json
import sys
from pathlib import Path

from studio import shown

# What Lichtblick's own container puts a layout in place of.
PLACE = "/*LICHTBLICK_SUITE_DEFAULT_LAYOUT_PLACEHOLDER*/"


def main(web, recording, out):
    """Shows the recording."""

    def make(root, layout):
        for file in Path(web).resolve().iterdir():
            if file.name != "index.html":
                (root / file.name).symlink_to(file)
        page = (Path(web) / "index.html").read_text()
        if PLACE not in page:
            sys.exit(f"{web}/index.html is no page of Lichtblick: it has no place for a layout")
        (root / "index.html").write_text(page.replace(PLACE, json.dumps(layout)))
        return "index.html?ds=remote-file&ds.url={origin}/own.mcap"

    shown(recording, out, make)


main(*sys.argv[1:])
