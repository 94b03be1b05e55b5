"""Opens a recording in PlotJuggler with the layout of `linkproof view`, on a virtual display, and checks the curves.

usage: plotjuggler.py PLOTJUGGLER LINKPROOF RECORDING.mcap OUT.png

The foremost curve of each plot must follow the numbers of the recording.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from PIL import ImageGrab

SIZE = (1500, 900)
LIMIT = 60.0


def curves(recording, layout):
    """Colour, times and values of the last curve of each plot."""
    found = []
    for plot in ElementTree.parse(layout).iter("plot"):
        curve = plot.findall("curve")[-1]
        topic, field = curve.get("name").rsplit("/", 1)
        with open(recording, "rb") as stream:
            messages = make_reader(stream, decoder_factories=[DecoderFactory()]).iter_decoded_messages(topics=[topic])
            rows = [(raw.log_time, getattr(message, field)) for _, _, raw, message in messages]
        color = curve.get("color").lstrip("#")
        found.append((curve.get("name"), tuple(bytes.fromhex(color)), np.array(rows, dtype=float)))
    return found


def bands(seen):
    """Ranges of pixel rows with visible curves, one range for each plot; a plot of another colour lies between two of one colour."""
    rows = np.nonzero(seen.any(axis=1))[0]
    parts = np.split(rows, np.nonzero(np.diff(rows) > 60)[0] + 1)
    return [(part[0], part[-1] + 1) for part in parts if len(part) > 5]


def without_blocks(seen):
    """The pixels without the coloured squares of the legend, which are thicker than any curve."""
    blocks = seen.copy()
    for axis in (0, 1):
        blocks = np.logical_and.reduce([np.roll(blocks, -step, axis) for step in range(6)])
    kept = seen.copy()
    for row, column in zip(*np.nonzero(blocks)):
        kept[max(row - 4, 0) : row + 12, max(column - 4, 0) : column + 12] = False
    return kept


def share(seen, rows):
    """Fraction of a curve that is visible within 4 pixels of its expected position."""
    at = np.nonzero(seen.any(axis=0))[0]
    up = np.nonzero(seen.any(axis=1))[0]
    (time, value), good = rows.T, []
    low, high = value.min(), value.max()
    for column in np.linspace(at[0], at[-1], 300).round().astype(int):
        moment = time[0] + (column - at[0]) / (at[-1] - at[0]) * (time[-1] - time[0])
        row = up[-1] - (np.interp(moment, time, value) - low) / (high - low) * (up[-1] - up[0])
        near = seen[max(round(row) - 4, 0) : round(row) + 5, max(column - 3, 0) : column + 4]
        good.append(near.any())
    return float(np.mean(good))


def judged(picture, wanted):
    """For every plot, the fraction of its curve at the expected position."""
    pixels = np.asarray(picture.convert("RGB")).astype(int)
    found, taken = [], {}
    for name, color, rows in wanted:
        seen = without_blocks(np.all(np.abs(pixels - np.array(color)) < 14, axis=2))
        number = taken.get(color, 0)
        taken[color] = number + 1
        spans = bands(seen)
        found.append((name, share(seen[slice(*spans[number])], rows) if number < len(spans) else 0.0))
    return found


def main(plotjuggler, linkproof, recording, out):
    """Shows the recording and checks the picture."""
    with tempfile.TemporaryDirectory() as own:
        copy = Path(own) / "own.mcap"
        shutil.copy(recording, copy)
        subprocess.run([linkproof, "view", copy, "--with", "plotjuggler"], check=True, stdout=subprocess.DEVNULL)
        layout = copy.with_suffix(".plotjuggler.xml")
        wanted = curves(copy, layout)
        reading, writing = os.pipe()
        server = ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{SIZE[0]}x{SIZE[1]}x24"]
        display = subprocess.Popen(server, pass_fds=[writing], stderr=subprocess.DEVNULL)
        name = ":" + os.read(reading, 20).decode().strip()
        viewer = subprocess.Popen(
            [plotjuggler, "--nosplash", "--disable_opengl", "--layout", layout, "-qwindowgeometry", f"{SIZE[0]}x{SIZE[1]}+0+0"],
            env={**os.environ, "HOME": own, "XDG_CONFIG_HOME": own, "DISPLAY": name, "QT_QPA_PLATFORM": "xcb"},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            until = time.monotonic() + LIMIT
            while True:
                time.sleep(2.0)
                picture = ImageGrab.grab(xdisplay=name)
                found = judged(picture, wanted)
                if all(part > 0.95 for _, part in found) or time.monotonic() > until:
                    break
        finally:
            viewer.terminate()
            viewer.wait()
            display.terminate()
            display.wait()
    picture.save(out)
    good = [part > 0.95 for _, part in found]
    print(f"{out}: {sum(good)} of {len(good)} curves are drawn at the recorded values")
    for name, part in found:
        print(f"  {name}: {part:.0%}")
    sys.exit(0 if good and all(good) else 1)


main(*sys.argv[1:])
