"""Opens a recording with its layout in the open-source Foxglove Studio 1.48.

usage: foxglove.py PACKAGES RECORDING.mcap OUT.png    (with RECORDING.foxglove.json beside it)

PACKAGES is a directory in which `npm install @foxglove/studio-base@1.48.0 react@17.0.2 react-dom@17.0.2` was run.
"""

import json
import shutil
import sys
from pathlib import Path

from studio import shown


def main(packages, recording, out):
    """Shows the recording."""

    def make(root, layout):
        (root / "node_modules").symlink_to((Path(packages) / "node_modules").resolve())
        shutil.copy(Path(__file__).parent / "foxglove.html", root)
        (root / "layout.json").write_text(json.dumps(layout))
        return "foxglove.html?recording=own.mcap&layout=layout.json"

    shown(recording, out, make)


main(*sys.argv[1:])
