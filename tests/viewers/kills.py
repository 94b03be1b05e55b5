"""Kills `linkproof run` at random moments, and opens the recordings that remain.

usage: kills.py LINKPROOF [COUNT]

Half of the killed runs start without a recording, half beside an older one. Every file called `.mcap` must then open with
the Python reader, which checks the checksums, and with linkproof. The moments cover the whole run; most are near its end,
when the recording is written.
"""

import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from mcap.reader import make_reader

TOP = Path(__file__).resolve().parents[2]
SCENARIO = TOP / "scenarios" / "crank_rocker.toml"
# So many instants that writing takes a considerable part of the run.
GRID = ["--crank-deg", "0:360:0.5"]


def opens(linkproof, path):
    """Whether both readers open a recording."""
    with open(path, "rb") as stream:
        count = sum(1 for _ in make_reader(stream, validate_crcs=True).iter_messages())
    own = subprocess.run([linkproof, "compare", path, path, "--side", "reference"], capture_output=True, text=True)
    return count > 0 and own.returncode == 0


def main(linkproof, count="300"):
    """Runs, kills, opens; the exit code tells whether all opened."""
    linkproof, count, dice = str(Path(linkproof).resolve()), int(count), random.Random(1)
    with tempfile.TemporaryDirectory() as own:
        out = Path(own) / "out"
        command = [linkproof, "run", str(SCENARIO), *GRID, "--quiet", "--record", str(out)]
        since = time.monotonic()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        lasts = time.monotonic() - since
        kept = Path(own) / "kept.mcap"
        shutil.copy(next(out.glob("*.mcap")), kept)
        killed = writing = whole = broken = 0
        for number in range(count):
            shutil.rmtree(out)
            out.mkdir()
            if number % 2:
                shutil.copy(kept, out / "crank_rocker.mcap")
            child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            # About two thirds of the kills come after half of the run's time.
            began = time.monotonic()
            try:
                child.wait(lasts * (1.1 - 1.1 * dice.random() ** 1.5))
                # The run ended before the kill: the timed run may have been slower because of other work on the machine.
                lasts = min(lasts, time.monotonic() - began)
            except subprocess.TimeoutExpired:
                child.send_signal(signal.SIGKILL)
                killed += child.wait() == -signal.SIGKILL
            writing += any(not path.name.endswith((".mcap", ".json")) for path in out.iterdir())
            for path in out.glob("*.mcap"):
                whole += 1
                try:
                    good = opens(linkproof, path)
                except Exception as error:  # any error of a foreign reader is a finding
                    print(f"{path.name} after kill {number}: {error!r}")
                    good = False
                broken += not good
        print(f"{count} runs, {killed} killed, {writing} of them while writing; {whole} recordings left, {broken} broken")
    sys.exit(1 if broken or killed < count // 2 else 0)


main(*sys.argv[1:])
