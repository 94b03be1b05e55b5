"""Checks `linkproof run --live` with a test client, and with the open-source Foxglove Studio 1.48.

usage: live_check.py LINKPROOF PICTURES [PACKAGES]

The received messages must equal the recorded messages, and positions of links must equal the output of `linkproof solve`.
PACKAGES is as in foxglove.py; without it, Studio is skipped. Two pictures of Studio must show two different poses of the
recording.
"""

import asyncio
import base64
import contextlib
import csv
import io
import json
import math
import re
import signal
import struct
import subprocess
import sys
import tempfile
from pathlib import Path
from urllib.parse import quote

import websockets
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from mcap.reader import make_reader

import foxglove

TOP = Path(__file__).resolve().parents[2]
SCENARIO = TOP / "scenarios" / "crank_rocker.toml"
NAMES = ["foxglove.websocket.v1", "foxglove.sdk.v1"]
# Longest wait of the client (s).
LIMIT = 60.0


@contextlib.contextmanager
def serving(linkproof, out, *options):
    """Runs a live server; gives its address when the proof is finished."""
    command = [linkproof, "run", str(SCENARIO), "--record", str(out), "--live=127.0.0.1:0", *options]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        for line in child.stdout:
            if found := re.match(r"live +(ws://[\d.:]+)", line):
                yield found[1]
                break
        else:
            told = child.stderr.read()
            if "cargo feature" in told:
                print(f"run --live is skipped: {linkproof} is built without the feature `live`")
                sys.exit(0)
            sys.exit(f"no live server: {told}")
    finally:
        child.send_signal(signal.SIGINT)
        code = child.wait()
    if code != 0:
        sys.exit(f"Ctrl-C ends with the exit code {code}, not with that of the verdict")


def decoder(channel):
    """Decoder of the Protobuf messages of a channel."""
    pool = descriptor_pool.DescriptorPool()
    files = descriptor_pb2.FileDescriptorSet.FromString(base64.b64decode(channel["schema"]))
    for file in files.file:
        pool.Add(file)
    kind = message_factory.GetMessageClass(pool.FindMessageTypeByName(channel["schemaName"]))
    return kind.FromString


async def lap(address, name):
    """The channels, and all messages of one pass through the recording: topic, log time, bytes, and the clock at receipt."""
    async with websockets.connect(address, subprotocols=[name], max_size=None) as socket:
        assert socket.subprotocol == name
        info, channels = json.loads(await socket.recv()), {}
        assert info["op"] == "serverInfo" and "time" in info["capabilities"], info
        while not channels:
            text = await asyncio.wait_for(socket.recv(), LIMIT)
            if isinstance(text, str) and (told := json.loads(text))["op"] == "advertise":
                channels = {channel["id"]: channel for channel in told["channels"]}
        await socket.send(json.dumps({"op": "subscribe", "subscriptions": [{"id": own, "channelId": own} for own in channels]}))
        clock, laps, messages = -1, 0, []
        while laps < 2:
            data = await asyncio.wait_for(socket.recv(), LIMIT)
            if isinstance(data, str):
                continue
            if data[0] == 2:
                (now,) = struct.unpack("<Q", data[1:9])
                laps += now < clock
                clock = now
            elif data[0] == 1 and laps == 1:
                number, at = struct.unpack("<IQ", data[1:13])
                messages.append((channels[number]["topic"], at, data[13:], clock))
        return channels, messages


def recorded(path):
    """Schemas of topics, and messages, of a recording."""
    with open(path, "rb") as stream:
        found = list(make_reader(stream).iter_messages(log_time_order=True))
    kinds = {channel.topic: (schema.name, schema.encoding, channel.message_encoding, schema.data) for schema, channel, _ in found}
    return kinds, [(channel.topic, message.log_time, message.data) for _, channel, message in found]


def same_as_recorded(address, recording):
    """Checks that both protocols send exactly the recorded messages; returns channels and messages of the last protocol."""
    kinds, expected = recorded(recording)
    for name in NAMES:
        channels, messages = asyncio.run(lap(address, name))
        for channel in channels.values():
            schema, encoding, own, data = kinds[channel["topic"]]
            text = base64.b64encode(data).decode() if encoding == "protobuf" else data.decode()
            told = (channel["schemaName"], channel["schemaEncoding"], channel["encoding"], channel["schema"])
            assert told == (schema, encoding, own, text), channel["topic"]
        assert {channel["topic"] for channel in channels.values()} == set(kinds)
        assert all(clock == at for _, at, _, clock in messages), "viewers date messages by the clock"
        assert sorted(own[:3] for own in messages) == sorted(expected), f"{name}: {len(messages)} messages, not {len(expected)}"
        print(f"  ok     {name}: {len(messages)} messages of {len(channels)} topics, equal to those of the recording")
    return channels, messages


def where_solve_has_it(linkproof, channels, messages):
    """Compares positions of links, from samples and from frames, with the output of `solve`."""
    table = subprocess.run([linkproof, "solve", str(SCENARIO), "--with", "assur"], check=True, capture_output=True, text=True).stdout
    rows = {round(float(row["t_s"]) * 1e9): row for row in csv.DictReader(io.StringIO(table))}
    readers = {channel["topic"]: decoder(channel) for channel in channels.values() if channel["encoding"] == "protobuf"}
    most, count = {"reference": 0.0, "engine": 0.0, "frames": 0.0}, 0
    for topic, at, data, _ in messages:
        found = []
        if own := re.fullmatch(r"/(reference|engine)/link/(\w+)", topic):
            told = readers[topic](data)
            found = [(own[1], getattr(told, key) - float(rows[at][f"link.{own[2]}.{key}"])) for key in ("x_m", "y_m", "angle_rad")]
        elif topic == "/tf":
            for frame in readers[topic](data).transforms:
                link = frame.child_frame_id.split("/")[1]
                angle = 2.0 * math.atan2(frame.rotation.z, frame.rotation.w)
                found.append(("frames", math.remainder(angle - float(rows[at][f"link.{link}.angle_rad"]), math.tau)))
        for side, difference in found:
            most[side] = max(most[side], abs(difference))
        count += len(found)
    # Pictures are in single precision.
    allowed = {"reference": 1e-12, "engine": 1e-5, "frames": 1e-5}
    told = ", ".join(f"{what} to {own:.1e}" for what, own in most.items())
    assert count > 1000 and all(own <= allowed[what] for what, own in most.items()), f"{count} numbers: {told}"
    print(f"  ok     {count} numbers of links equal those of `solve`: {told}")


async def two_pictures(port, page, judge):
    """Two pictures, each with the poses that it shows. The second is taken as soon as it shows no pose of the first."""
    shown = []
    for address in (page, None):
        before = shown[0][1] if shown else set()
        enough = lambda canvas, png: (found := judge(canvas, png)) and not found & before
        canvas, png = await foxglove.show(port, address, enough)
        shown.append((png, judge(canvas, png) if canvas else set()))
    return shown


def in_studio(address, recording, packages, pictures):
    """Checks that Studio shows a pose of the recording, and later a different pose."""
    layout = json.loads(recording.with_suffix(".foxglove.json").read_text())
    camera = layout["configById"]["3D!mechanism"]["cameraState"]
    drawing, frames = foxglove.poses(recording)
    wanted = [(at, list(foxglove.places(drawing, message))) for at, message in frames]

    def poses(canvas, png):
        picture = foxglove.pixels(png)
        return {at for at, places in wanted if all(good for _, good in foxglove.seen(canvas, picture, camera, places))}

    with foxglove.studio(foxglove.page(packages, layout), {}) as (port, page):
        shown = asyncio.run(two_pictures(port, f"{page}&live={quote(address)}", poses))
    Path(pictures).mkdir(parents=True, exist_ok=True)
    for number, (png, found) in enumerate(shown, 1):
        out = Path(pictures) / f"live_{number}.foxglove.png"
        out.write_bytes(png)
        times = ", ".join(f"{at * 1e-9:.4f}" for at in sorted(found)) or "none"
        print(f"  {'ok    ' if found else 'FAILED'} {out}: times (s) of the shown poses in the recording: {times}")
    assert all(found for _, found in shown) and not shown[0][1] & shown[1][1], "Studio does not show the motion"


def main(linkproof, pictures, packages=None):
    """Starts the server, runs the checks, and ends the server."""
    linkproof = str(Path(linkproof).resolve())
    with tempfile.TemporaryDirectory() as own:
        recording = Path(own) / "crank_rocker.mcap"
        with serving(linkproof, own, "--record-forces") as address:
            print(f"{address}: {SCENARIO.name}")
            channels, messages = same_as_recorded(address, recording)
            where_solve_has_it(linkproof, channels, messages)
            if packages and (Path(packages) / "node_modules/@foxglove/studio-base").exists():
                in_studio(address, recording, packages, pictures)
            else:
                print("  Foxglove Studio is skipped: it is not installed")


main(*sys.argv[1:])
