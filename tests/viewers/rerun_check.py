"""Checks the files that `linkproof view` writes for Rerun, and takes a picture of Rerun's viewer.

usage: rerun_check.py LINKPROOF PICTURES FILE.mcap...

The poses in the `.rrd` must be those of the recording, on a timeline of simulated seconds. The picture must show both
sides in their colours. Without a virtual display (`xvfb-run`) the picture is skipped with a message.
"""

import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import rerun as rr
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from PIL import Image

LAVAPIPE = sorted(Path("/usr/share/vulkan/icd.d").glob("lvp_icd*.json"))
# The reference's colour and the engine's.
COLOURS = {"reference": (86, 180, 233), "engine": (230, 120, 0)}
failed = []


def check(what, passed, found=""):
    """Prints and counts one check."""
    print(f"  {'ok    ' if passed else 'FAILED'} {what}{f': {found}' if found else ''}")
    if not passed:
        failed.append(what)


def recorded(path):
    """Times (simulated s) and poses (x, y, angle) of all frames of a recording."""
    with open(path, "rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        metadata = {own.name: own.metadata for own in reader.iter_metadata()}["linkproof"]
        start, slow = float(metadata["log_time_zero_s"]), float(metadata.get("slow", 1.0))
        times, poses = [], {}
        for _, _, raw, message in reader.iter_decoded_messages(topics=["/tf"]):
            times.append(start + raw.log_time * 1e-9 / slow)
            for own in message.transforms:
                turn = 2.0 * math.atan2(own.rotation.z, own.rotation.w)
                poses.setdefault(own.child_frame_id, []).append([own.translation.x, own.translation.y, turn])
    return np.array(times), {name: np.array(rows) for name, rows in poses.items()}


def shown(path):
    """Times (simulated s) and poses (x, y, angle) of all frames of an `.rrd`."""
    poses, times = {}, {}
    for chunk in rr.chunk.RrdReader(str(path)).stream():
        batch = chunk.to_record_batch()
        if "Transform3D:translation" not in batch.schema.names or not chunk.num_rows:
            continue
        name = "/".join(str(chunk.entity_path).strip("/").split("/")[1:]).replace("\\", "")
        column = lambda own: batch.column(batch.schema.names.index(own))
        places = np.array(column("Transform3D:translation").to_pylist(), dtype=float)[:, 0]
        turns = np.array(column("Transform3D:quaternion").to_pylist(), dtype=float)[:, 0]
        rows = np.column_stack([places[:, :2], 2.0 * np.arctan2(turns[:, 2], turns[:, 3])])
        moments = np.array([own.value for own in column("simulated_time")]) * 1e-9
        poses.setdefault(name, []).append(rows)
        times.setdefault(name, []).append(moments)
    order = {name: np.argsort(np.concatenate(own), kind="stable") for name, own in times.items()}
    return (
        {name: np.sort(np.concatenate(own)) for name, own in times.items()},
        {name: np.concatenate(own)[order[name]] for name, own in poses.items()},
    )


def photograph(rrd, picture):
    """The viewer's window, with the blueprint of the file."""
    if not shutil.which("xvfb-run") or not LAVAPIPE:
        print("  --     no picture: xvfb-run and mesa-vulkan-drivers are not installed")
        return
    picture.unlink(missing_ok=True)
    command = ["xvfb-run", "-a", "-s", "-screen 0 1600x1000x24", "rerun", "--window-size", "1600x1000", "--port", "auto"]
    done = subprocess.run(
        [*command, "--screenshot-to", str(picture), str(rrd)],
        env={**os.environ, "VK_ICD_FILENAMES": str(LAVAPIPE[0]), "WGPU_BACKEND": "vulkan"},
        capture_output=True,
        text=True,
        timeout=300,
    )
    if not picture.exists():
        check("the viewer draws a picture", False, " / ".join(done.stderr.splitlines()[-3:]))
        return
    pixels = np.asarray(Image.open(picture).convert("RGB")).astype(int)
    left = pixels[:, : pixels.shape[1] * 3 // 5]
    for side, colour in COLOURS.items():
        seen = np.all(np.abs(left - np.array(colour)) < 30, axis=2)
        rows, columns = np.nonzero(seen)
        spans = (np.ptp(rows) / left.shape[0], np.ptp(columns) / left.shape[1]) if len(rows) else (0.0, 0.0)
        # In a clipped or distant picture, the extents would differ.
        what = f"{picture.name}: the {side} is seen, and is neither a dot nor cut off"
        check(what, 0.3 < max(spans) < 0.98 and seen.sum() > 500, f"{seen.sum()} pixels over {spans[0]:.2f} by {spans[1]:.2f}")


def main(linkproof, pictures, *files):
    """Checks every recording; the exit code tells whether all passed."""
    pictures = Path(pictures)
    pictures.mkdir(parents=True, exist_ok=True)
    for file in map(Path, files):
        print(f"{file} in Rerun")
        rrd = pictures / f"{file.stem}.rrd"
        subprocess.run([linkproof, "view", file, "-o", rrd, "--python", sys.executable], check=True, stdout=subprocess.DEVNULL)
        verified = subprocess.run(["rerun", "rrd", "verify", rrd], capture_output=True)
        check("rerun rrd verify", verified.returncode == 0)
        (times, poses), (own_times, own_poses) = recorded(file), shown(rrd)
        check("every frame is in the .rrd", set(poses) == set(own_poses), ", ".join(sorted(own_poses)))
        late = max(np.abs(own - times).max() for own in own_times.values())
        check("times are simulated seconds", late < 2e-9, f"within {late:.1e} s")
        gap = lambda name: np.abs(np.angle(np.exp(1j * (poses[name] - own_poses[name])))).max()
        worst = max(gap(name) for name in poses)
        check("poses of links equal those of the recording", worst < 1e-6, f"{worst:.1e} m or rad")
        photograph(rrd, pictures / f"{file.stem}.rerun.png")
    sys.exit(1 if failed else 0)


main(*sys.argv[1:])
