#!/usr/bin/env python3
"""Peers of `linkproof bench` on motions under forces: tests/viewers/peers_check.py LINKPROOF

MuJoCo gets motors, loads, springs and dampers from the exported model; the peer of Exudyn builds its model itself. Both must
converge to our solution. A peer that is not installed is skipped with a message.
"""

import importlib.util
import json
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent.parent
# Two limits for a quick measurement: measured values with a margin. The first limit is for the largest position
# error at the finest step, divided by the scale. The second is for the ratio of the errors at coarsest and finest step.
# With a prescribed drive, Exudyn solves for the pose at every step, so its error does not fall with the step, and the
# ratio is not tested.
EXPECTED = {
    "scenarios/pendulum.toml": {"mujoco": (1e-11, 1e3), "exudyn": (3e-4, 10)},
    "scenarios/double_pendulum.toml": {"mujoco": (1e-11, 1e3), "exudyn": (1e-4, 10)},
    "scenarios/crank_rocker_runup.toml": {"mujoco": (1e-6, 10), "exudyn": (1e-6, 10)},
    "scenarios/five_bar_on_a_spring.toml": {"mujoco": (1e-7, 10)},
    "tests/viewers/scenarios/all_loads.toml": {"mujoco": (1e-6, 10)},
    "scenarios/crank_rocker.toml": {"mujoco": (1e-5, 10), "exudyn": (1e-10, 0)},
}
# Limit for reactions that a peer computes to rounding error.
REACTIONS = {"scenarios/pendulum.toml": 1e-10, "scenarios/double_pendulum.toml": 1e-10}


def main(linkproof):
    installed = [name for name in ("mujoco", "exudyn") if importlib.util.find_spec(name)]
    for name in {"mujoco", "exudyn"} - set(installed):
        print(f"  SKIPPED: {name} is not installed, so its peer is not tested")
    failed = 0
    for scenario, expected in EXPECTED.items():
        peers = [name for name in installed if name in expected]
        asked = [f"--peer={name}={sys.executable} {TOP}/examples/peers/{name}_peer.py" for name in peers]
        with tempfile.TemporaryDirectory() as directory:
            command = [linkproof, "bench", TOP / scenario, "--out", directory, "--quick", "--engine", "rapier", "--budget", "1", *asked]
            subprocess.run(command, check=True, capture_output=True)
            points = json.loads(Path(directory, "bench.json").read_text())["scenarios"][0]["points"]
        for peer in peers:
            own = [point for point in points if point["program"] == peer]
            errors = [point["errors"]["positions"].get("max", float("inf")) for point in own]
            most, gain = expected[peer]
            passed = len(errors) >= 3 and min(errors) <= most and errors[0] >= gain * min(errors)
            # A wrong sign or a wrong point of application gives an error of about the scale at any step.
            stages = {stage for point in own for stage in point["errors"]}
            best = {stage: min((point["errors"][stage] or {}).get("max", float("inf")) for point in own) for stage in stages}
            passed &= all(error <= 0.05 for stage, error in best.items() if any(point["errors"][stage] for point in own))
            if peer == "mujoco" and scenario in REACTIONS:
                passed &= min(point["errors"]["reactions"]["max"] for point in own) <= REACTIONS[scenario]
            failed += not passed
            print(f"  {'ok    ' if passed else 'FAILED'} {peer} converges to the analytic motion of {scenario}: {min(errors, default=float('inf')):.1e}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main(sys.argv[1])
