"""Opens a recording with its layout in the open-source Foxglove Studio 1.48.

usage: foxglove.py PACKAGES RECORDING.mcap OUT.png    (with RECORDING.foxglove.json beside it)

PACKAGES is a directory in which `npm install @foxglove/studio-base@1.48.0 react@17.0.2 react-dom@17.0.2` was run.
"""

import json
import shutil
import sys
from pathlib import Path

from studio import shown


def page(packages, source):
    """What puts Studio into a directory, with the layout and what it shows: `recording=NAME`, or `live=ADDRESS`."""

    def make(root, layout):
        (root / "node_modules").symlink_to((Path(packages) / "node_modules").resolve())
        shutil.copy(Path(__file__).parent / "foxglove.html", root)
        (root / "layout.json").write_text(json.dumps(layout))
        return f"foxglove.html?layout=layout.json&{source}"

    return make


if __name__ == "__main__":
    packages, recording, out = sys.argv[1:]
    shown(recording, out, page(packages, "recording=own.mcap"))
