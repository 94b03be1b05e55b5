"""Cost of a recording: processor time of alternate runs with and without a recording, one turn at 1 kHz.

usage: cost.py LINKPROOF [ROUNDS]

The ratio of the shortest time with a recording to the shortest time without one is printed. The exit code is 1 if this
ratio exceeds 1.3.
"""

import resource
import subprocess
import sys
import tempfile
from pathlib import Path

SCENARIO = Path(__file__).resolve().parents[2] / "scenarios" / "crank_rocker.toml"
# One turn at 130 rpm.
GRID = ["--times", "0:0.4615:0.001"]
MOST = 1.3


def spent(command):
    """Processor time of a command (s)."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(linkproof, rounds="15"):
    """Measures and prints the ratio."""
    with tempfile.TemporaryDirectory() as own:
        run = [linkproof, "run", str(SCENARIO), *GRID, "--quiet", "--jobs", "1"]
        pairs = [(spent([*run, "--record", own]), spent([*run, "--no-record"])) for _ in range(int(rounds))]
    recorded, plain = (min(times) for times in zip(*pairs))
    print(f"{recorded:.3f} s with a recording, {plain:.3f} s without: {recorded / plain:.2f} times")
    sys.exit(1 if recorded > MOST * plain else 0)


main(*sys.argv[1:])
