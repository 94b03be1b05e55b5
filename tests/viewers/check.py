"""Opens recordings with foreign readers, and checks what they read.

usage: check.py FILE...
"""

import json
import math
import shutil
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

# Text messages of robotics programs: four bytes of encoding, the length, the text, a zero byte.
TEXT = {"/robot_description": "std_msgs/msg/String"}
OWN = {"grid": "Grid", "link": "Link", "point": "Point", "joint": "Joint", "transmission": "Transmission", "frame": "Frame", "drive": "Drive"}
FOXGLOVE = {
    "/tf": "FrameTransforms",
    "/mechanism/links": "SceneUpdate",
    "/mechanism/forces": "SceneUpdate",
    "/log": "Log",
}
# Pictures are written in single precision.
DRAWING = 1e-6

results = []


def check(what, passed, found=""):
    """Prints and counts one check."""
    results.append(bool(passed))
    print(f"  {'ok    ' if passed else 'FAILED'} {what}{f': {found}' if found else ''}")


class Texts:
    """Decoder of text messages."""

    def decoder_for(self, encoding, schema):
        """A function that reads the text of a message; None for other messages."""
        if encoding == "cdr" and schema.name == "std_msgs/msg/String":
            return lambda data: data[8:-1].decode()
        return None


def values(message):
    """Numbers of a flat message that are present."""
    return {field.name: value for field, value in message.ListFields()}


def expected_schema(topic):
    """Name of the schema that a topic must have; None for an unexpected topic."""
    if topic in TEXT:
        return TEXT[topic]
    if topic in FOXGLOVE:
        return f"foxglove.{FOXGLOVE[topic]}"
    parts = topic.split("/")
    if len(parts) < 3 or parts[2] not in OWN:
        return None
    return f"linkproof.{OWN[parts[2]]}{'Error' if parts[1] == 'error' else ''}"


def load(path):
    """Schemas and messages (log time, sequence, decoded) by topic, attachments and metadata."""
    schemas, messages = {}, defaultdict(list)
    with open(path, "rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory(), Texts()])
        for schema, channel, raw, message in reader.iter_decoded_messages():
            schemas[channel.topic] = schema.name
            messages[channel.topic].append((raw.log_time, raw.sequence, message))
        attachments = {a.name: a.data for a in reader.iter_attachments()}
        metadata = {m.name: m.metadata for m in reader.iter_metadata()}
    return schemas, messages, attachments, metadata


def check_numbers(schemas, messages, slow):
    """Checks the topics with samples; log times are `slow` times the simulated times."""
    # Prismatic joints and joints with friction have more fields, and a drive of a slide has a force.
    plain = lambda schema: schema.replace("Slider", "Joint").replace("Rubbing", "").replace("Thrust", "")
    wrong = [f"{t} is {s}" for t, s in schemas.items() if plain(s) != expected_schema(t)]
    check("every topic has the schema of its name", not wrong, ", ".join(wrong) or f"{len(schemas)} topics")
    disorder = [t for t, ms in messages.items() if any(b[0] < a[0] for a, b in zip(ms, ms[1:]))]
    check("log times ascend in every topic", not disorder, ", ".join(disorder))

    sides = [t.split("/")[1] for t in messages if t.endswith("/grid") and t.count("/") == 2]
    check("the recording has a side", sides, ", ".join(sides))
    for side in sides:
        counts = {t: len(ms) for t, ms in messages.items() if t.startswith(f"/{side}/")}
        check(f"{side}: all topics have the same number of messages", len(set(counts.values())) == 1, sorted(set(counts.values())))
        grid = [values(m) for _, _, m in messages[f"/{side}/grid"]]
        inputs = ({"t_s", own, "row"} for own in ("crank_rad", "joint_rad", "slide_m"))
        check(f"{side}: the grid has time, input and row", any(all(set(g) == own for g in grid) for own in inputs))
        times = np.array([g.get("t_s", math.nan) for g in grid])
        check(f"{side}: times ascend", np.all(np.diff(times) >= 0.0))
        stamps = np.array([m[0] for m in messages[f"/{side}/grid"]]) * 1e-9 / slow
        apart = np.ptp(stamps - times)
        check(f"{side}: log times are {slow:g} times the times", apart < 2e-9, f"within {apart:.1e} s")
        check(f"{side}: every row occurs once", sorted(g.get("row") for g in grid) == list(range(len(grid))))
        ragged = [t for t in counts if len({tuple(values(m)) for _, _, m in messages[t]}) != 1]
        check(f"{side}: every message of a topic has the same fields", not ragged, ", ".join(ragged))
    own = [t for t, s in schemas.items() if s.startswith("linkproof.")]
    bad = [t for t in own for _, _, m in messages[t] if not all(math.isfinite(v) for v in values(m).values())]
    check("all numbers are finite", not bad, ", ".join(sorted(set(bad))))
    return sides


def placed(transform, point):
    """World coordinates of a point of a frame."""
    angle = 2.0 * math.atan2(transform.rotation.z, transform.rotation.w)
    c, s = math.cos(angle), math.sin(angle)
    return np.array([transform.translation.x + c * point.x - s * point.y, transform.translation.y + s * point.x + c * point.y])


def check_scene(path, schemas, messages, sides):
    """Checks frames, links, and the messages for other viewers."""
    if "/tf" not in messages:
        positions = [t for t in messages if "/link/" in t and "x_m" in values(messages[t][0][2])]
        check("the scene is missing only if positions are missing", not positions)
        return
    links = [e for _, _, m in messages["/mechanism/links"] for e in m.entities]
    check("links are drawn once", len(messages["/mechanism/links"]) == 1, f"{len(links)} entities")
    framed = [e for e in links if e.frame_id != "world"]
    check("links are fixed to frames and do not expire", all(e.frame_locked and not e.HasField("lifetime") for e in links))
    wanted = {e.frame_id for e in framed}
    sets = [{t.child_frame_id for t in m.transforms} for _, _, m in messages["/tf"]]
    check("every link has its frame at every time", all(s == wanted for s in sets), ", ".join(sorted(wanted)))
    check("the parent of every frame is the world", all(t.parent_frame_id == "world" for _, _, m in messages["/tf"] for t in m.transforms))
    norms = [math.hypot(t.rotation.z, t.rotation.w) for _, _, m in messages["/tf"] for t in m.transforms]
    check("rotations are unit quaternions", max(abs(n - 1.0) for n in norms) < DRAWING)

    size = max([abs(p.x) + abs(p.y) for e in framed for line in e.lines for p in line.points], default=1.0)
    letters = [(e.frame_id, text.text, text.pose.position) for e in framed for text in e.texts]
    worst, compared = 0.0, 0
    for frame, name, local in letters:
        topic = f"/{frame.split('/')[0]}/point/{name}"
        track = {time: values(m) for time, _, m in messages.get(topic, [])}
        for time, _, message in messages["/tf"]:
            transform = next(t for t in message.transforms if t.child_frame_id == frame)
            if "x_m" in track.get(time, {}):
                gap = placed(transform, local) - np.array([track[time]["x_m"], track[time]["y_m"]])
                worst, compared = max(worst, float(np.abs(gap).max())), compared + 1
    check("named points are drawn at their recorded positions", worst < 4 * DRAWING * max(size, 1.0), f"{compared} compared, {worst:.1e} m")

    sliding = sorted({t.split("/", 3)[3] for t, s in schemas.items() if s in ("linkproof.Slider", "linkproof.RubbingSlider")})
    if sliding:
        blocks = [line for e in framed for line in e.lines if line.type == 1 and len(line.points) == 4]
        check("every sliding joint has its block", len(blocks) >= len(sliding) * len(sides), f"{', '.join(sliding)}: {len(blocks)} blocks")
        slides = [values(m) for s in sides for j in sliding for _, _, m in messages[f"/{s}/joint/{j}"]]
        check("every sliding joint has force, slide and moment", all({"fx_N", "slide_m", "moment_N_m"} <= set(v) for v in slides))

    ((_, _, text),) = messages["/robot_description"]
    robot = ElementTree.fromstring(text)
    parts = {link.get("name"): len(link.findall("visual")) for link in robot.iter("link")}
    check("the robot's description has every link, with parts", parts.keys() == wanted | {"world"} and all(parts.values()), parts)
    boxes = [[float(n) for n in box.get("size").split()] for box in robot.iter("box")]
    check("the parts of the robot's description have sizes", boxes and all(math.isfinite(n) and n > 0.0 for size in boxes for n in size), f"{len(boxes)} boxes")
    check_layout(path, schemas, messages, wanted)


def check_layout(path, schemas, messages, frames):
    """Checks that the layout beside a recording refers to recorded topics, and shows all links."""
    beside = Path(path).with_suffix(".foxglove.json")
    if not beside.exists():
        print(f"  --     no layout: {beside.name} is not kept")
        return
    layout = json.loads(beside.read_text())
    panels = layout["configById"]
    paths = [own["value"].replace('"', "").rsplit(".", 1) for name, panel in panels.items() if name.startswith("Plot") for own in panel["paths"]]
    lost = [f"{topic}.{field}" for topic, field in paths if field not in (values(messages[topic][0][2]) if topic in messages else {})]
    check("every plotted number is recorded", paths and not lost, ", ".join(lost) or f"{len(paths)} lines")
    scene = panels["3D!mechanism"]
    check("the topics of the layout are recorded", all(topic in schemas for topic in scene["topics"]))
    hidden = {name.removeprefix("frame:") for name, own in scene["transforms"].items() if not own["visible"]}
    check("frames' axes are hidden", hidden == frames | {"world"})
    camera = scene["cameraState"]
    centre, half = np.array(camera["targetOffset"][:2]), camera["distance"] / 2
    places = [[t.translation.x, t.translation.y] for _, _, m in messages["/tf"] for t in m.transforms]
    far = np.abs(np.array(places) - centre).max(axis=0) / half
    check("all links are in view", far[1] < 1.0 and far[0] < 1.3, f"{far[0]:.2f}, {far[1]:.2f} of the half height")


def check_forces(messages, metadata):
    """Checks the arrows of forces and moments."""
    if "/mechanism/forces" not in messages:
        return
    updates = [m for _, _, m in messages["/mechanism/forces"]]
    check("every update has every arrow", len({tuple(e.id for e in m.entities) for m in updates}) == 1, f"{len(updates[0].entities)} arrows")
    arrows = [a for m in updates for e in m.entities for a in e.arrows]
    numbers = [n for a in arrows for n in (a.shaft_length, a.head_length, a.pose.position.x, a.pose.position.y, a.pose.orientation.z)]
    check("arrows are finite and have length", all(map(math.isfinite, numbers)) and all(a.shaft_length > 0 and a.head_length > 0 for a in arrows))
    scale = float(metadata["linkproof"].get("force_scale_m_per_N", "nan"))
    check("the scale of forces is given", math.isfinite(scale), f"{scale:.3g} m/N")
    worst = 0.0
    shortest = min(a.shaft_length + a.head_length for a in arrows)
    for (time, _, update) in messages["/mechanism/forces"][:: max(1, len(updates) // 20)]:
        for entity in update.entities:
            side, joint = entity.id.split("/", 1)
            force = next((values(m) for t, _, m in messages.get(f"/{side}/joint/{joint}", []) if t == time), None)
            if force:
                (arrow,) = entity.arrows
                length = max(scale * math.hypot(force["fx_N"], force["fy_N"]), shortest)
                worst = max(worst, abs(arrow.shaft_length + arrow.head_length - length))
    check("arrows are as long as their forces", worst < 1e-5, f"{worst:.1e} m")


def run(what, *command):
    """Runs a check by a foreign program; skipped if this program is not installed."""
    if shutil.which(command[0]) is None:
        print(f"  --     {what}: {command[0]} is not installed")
        return
    done = subprocess.run(command, capture_output=True, text=True)
    last = (done.stdout + done.stderr).strip().splitlines()
    check(what, done.returncode == 0, "" if done.returncode == 0 else " / ".join(last[-5:]))


def check_file(path):
    """All checks of one recording."""
    print(path)
    try:
        schemas, messages, attachments, metadata = load(path)
    except Exception as error:  # any error of a foreign reader is a finding
        check("the Python reader opens the file", False, repr(error))
        return
    check("the Python reader opens the file", messages, f"{sum(map(len, messages.values()))} messages")
    check("the scenario is attached", attachments.get("scenario.toml"), f"{len(attachments.get('scenario.toml', b''))} bytes")
    check("the metadata name the scenario", metadata.get("linkproof", {}).get("scenario"), metadata.get("linkproof"))
    sides = check_numbers(schemas, messages, float(metadata["linkproof"].get("slow", "nan")))
    check_scene(path, schemas, messages, sides)
    check_forces(messages, metadata)
    run("pymcap-cli doctor", "pymcap-cli", "doctor", path)
    with tempfile.TemporaryDirectory() as directory:
        rrd = str(Path(directory) / "converted.rrd")
        run("rerun mcap convert", "rerun", "mcap", "convert", path, "-o", rrd)
        run("rerun rrd verify", "rerun", "rrd", "verify", rrd)


def main(paths):
    """Checks all recordings; the exit code tells whether all passed."""
    if not paths:
        sys.exit(__doc__)
    for path in paths:
        check_file(path)
    failed = results.count(False)
    print(f"{results.count(True)} passed, {failed} failed")
    sys.exit(1 if failed else 0)


main(sys.argv[1:])
