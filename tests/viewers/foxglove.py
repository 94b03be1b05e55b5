"""Opens a recording with its layout in the open-source Foxglove Studio 1.48, in headless Chromium, and checks the picture.

usage: foxglove.py PACKAGES RECORDING.mcap OUT.png    (with RECORDING.foxglove.json beside it)

PACKAGES is a directory in which `npm install @foxglove/studio-base@1.48.0 react@17.0.2 react-dom@17.0.2` was run.
The layout shows the mechanism from above, so the recording gives the pixel and the colour of every point of a link.
"""

import asyncio
import base64
import contextlib
import functools
import http.server
import io
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request
from pathlib import Path

import numpy as np
import websockets
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from PIL import Image

SIZE = (1500, 900)
LIMIT = 240.0
# Time in the recording that the player shows after it has opened the file (ns).
START = 99_000_000
# Software rendering, for machines without a graphics card.
FLAGS = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--remote-debugging-port=0"]


class Files(http.server.SimpleHTTPRequestHandler):
    """Serves files of a directory, also ranges of their bytes, which the player requests."""

    def log_message(self, *_):
        pass

    def do_GET(self):
        asked = re.fullmatch(r"bytes=(\d+)-(\d*)", self.headers.get("Range", ""))
        path = Path(self.translate_path(self.path))
        if not asked or not path.is_file():
            return super().do_GET()
        data = path.read_bytes()
        first, last = int(asked[1]), min(int(asked[2] or len(data) - 1), len(data) - 1)
        self.send_response(206)
        self.send_header("Content-Range", f"bytes {first}-{last}/{len(data)}")
        self.send_header("Content-Length", str(last - first + 1))
        self.end_headers()
        self.wfile.write(data[first : last + 1])

    def end_headers(self):
        self.send_header("Accept-Ranges", "bytes")
        super().end_headers()


async def call(socket, method, **parameters):
    """One command of the browser's debugging protocol."""
    call.number += 1
    await socket.send(json.dumps({"id": call.number, "method": method, "params": parameters}))
    while True:
        answer = json.loads(await socket.recv())
        if answer.get("id") == call.number:
            return answer.get("result", {})


call.number = 0
CANVAS = """(() => {
  const all = [...document.querySelectorAll('canvas')].map((c) => c.getBoundingClientRect());
  const largest = all.sort((a, b) => b.width * b.height - a.width * a.height)[0];
  return JSON.stringify(largest ? [largest.left, largest.top, largest.width, largest.height] : null);
})()"""


async def show(port, address, judge):
    """Opens a page, if an address is given, and takes screenshots until `judge` accepts one. Returns canvas and picture."""
    with urllib.request.urlopen(f"http://127.0.0.1:{port}/json") as answer:
        page = next(own for own in json.load(answer) if own["type"] == "page")
    async with websockets.connect(page["webSocketDebuggerUrl"], max_size=None) as socket:
        if address:
            await call(socket, "Page.navigate", url=address)
        until = time.monotonic() + LIMIT
        while True:
            await asyncio.sleep(3.0)
            canvas = json.loads((await call(socket, "Runtime.evaluate", expression=CANVAS))["result"].get("value", "null"))
            png = base64.b64decode((await call(socket, "Page.captureScreenshot", format="png"))["data"])
            if (canvas and judge(canvas, png)) or time.monotonic() > until:
                return canvas, png


def poses(recording):
    """Shapes of the links, and all messages of their frames with their times (ns)."""
    with open(recording, "rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        found = {"/mechanism/links": [], "/tf": []}
        for _, channel, raw, message in reader.iter_decoded_messages(topics=list(found)):
            found[channel.topic].append((raw.log_time, message))
    return found["/mechanism/links"][0][1], found["/tf"]


def places(drawing, transforms):
    """World positions of points on the links of the last side, with their colours."""
    frames = {own.child_frame_id: own for own in transforms.transforms}
    links = [own for own in drawing.entities if own.frame_id in frames]
    last = links[-1].frame_id.split("/")[0]
    for link in (own for own in links if own.frame_id.startswith(f"{last}/")):
        frame = frames[link.frame_id]
        angle = 2.0 * math.atan2(frame.rotation.z, frame.rotation.w)
        turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        line = max(link.lines, key=lambda own: own.thickness, default=None)
        if line is None or len(line.points) < 2:
            continue
        a, b = (np.array([point.x, point.y]) for point in line.points[:2])
        color = np.array([line.color.r, line.color.g, line.color.b]) * 255
        for share in (0.35, 0.65):
            yield link.frame_id, turn @ (a + share * (b - a)) + [frame.translation.x, frame.translation.y], color


def pixels(png):
    """A picture as an array."""
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB")).astype(int)


def seen(canvas, picture, camera, wanted):
    """For every point: its frame, and whether its colour is at the computed pixel."""
    left, top, width, height = canvas
    scale = height / camera["distance"]
    good = []
    for name, at, color in wanted:
        x, y = (at - np.array(camera["targetOffset"][:2])) * scale
        column, row = round(left + width / 2 + x), round(top + height / 2 - y)
        near = picture[max(row - 2, 0) : row + 3, max(column - 2, 0) : column + 3].reshape(-1, 3)
        # The hue is compared, because lighting may change the brightness.
        hues = near / np.maximum(np.linalg.norm(near, axis=1, keepdims=True), 30.0)
        good.append((name, len(near) and float(np.min(np.linalg.norm(hues - color / np.linalg.norm(color), axis=1))) < 0.15))
    return good


def page(packages, layout):
    """A function that writes Studio with a layout into a directory, and returns the name of the page."""

    def put(root):
        (root / "node_modules").symlink_to((Path(packages) / "node_modules").resolve())
        shutil.copy(Path(__file__).parent / "foxglove.html", root)
        (root / "layout.json").write_text(json.dumps(layout))
        return "foxglove.html?layout=layout.json"

    return put


@contextlib.contextmanager
def studio(put, files):
    """Runs a viewer in a browser: debugging port of the browser, and address of the page beside the served files."""
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    with tempfile.TemporaryDirectory() as own:
        root = Path(own) / "root"
        root.mkdir()
        start = put(root)
        for name, file in files.items():
            shutil.copy(file, root / name)
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Files, directory=root))
        # A browser that is ending does not read its answers.
        server.handle_error = lambda *_: None
        threading.Thread(target=server.serve_forever, daemon=True).start()
        profile = Path(own) / "profile"
        browser = subprocess.Popen(
            [chromium, *FLAGS, f"--window-size={SIZE[0]},{SIZE[1]}", f"--user-data-dir={profile}", "about:blank"],
            stderr=subprocess.DEVNULL,
        )
        try:
            ready = profile / "DevToolsActivePort"
            until = time.monotonic() + 60.0
            while not ready.exists() and time.monotonic() < until:
                time.sleep(0.2)
            port = ready.read_text().split()[0]
            yield port, f"http://127.0.0.1:{server.server_port}/{start}"
        finally:
            browser.terminate()
            browser.wait()
            server.shutdown()


def shown(viewer, source, recording, out):
    """Shows a recording with its layout, and checks the picture. `source` is the end of the page's address; `{origin}` is the file server."""
    recording = Path(recording)
    layout = json.loads(recording.with_suffix(".foxglove.json").read_text())
    camera = layout["configById"]["3D!mechanism"]["cameraState"]
    drawing, frames = poses(recording)
    wanted = list(places(drawing, [message for at, message in frames if at <= START][-1]))
    with studio(viewer(layout), {"own.mcap": recording}) as (port, address):
        enough = lambda canvas, png: all(good for _, good in seen(canvas, pixels(png), camera, wanted))
        canvas, png = asyncio.run(show(port, address + source.format(origin=address.rsplit("/", 1)[0]), enough))
    Path(out).write_bytes(png)
    good = seen(canvas, pixels(png), camera, wanted) if canvas else []
    missed = [name for name, own in good if not own]
    print(f"{out}: {len(good) - len(missed)} of {len(wanted)} points on links have the colour of their link at the computed pixel")
    sys.exit(0 if good and not missed else 1)


def main(packages, recording, out):
    """Shows the recording in Studio."""
    shown(functools.partial(page, packages), "&recording=own.mcap", recording, out)


if __name__ == "__main__":
    main(*sys.argv[1:])
