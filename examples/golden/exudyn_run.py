#!/usr/bin/env python3
"""Simulates a mechanism of the set of truths in Exudyn: python exudyn_run.py golden/crank_rocker STEP RESULT.csv [SETTING]

The result is at the instants of the truth; the step is shortened so that it divides their interval. It has the motion of
all links and points, the forces and moments of all joints, and the driving moments. `check.py` of the set compares it with
the truth. The peer of `linkproof bench` builds the model, from NAME.json of the set. The settings are those of the peer;
the default is the trapezoidal rule with constraints on velocities. Needs exudyn and numpy."""
import csv
import json
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "peers"))
import exudyn_peer
from linkproof_peer import Case, columns


def main(directory, step, result, setting="Newmark, index 2"):
    place = Path(directory)
    case = Case(json.loads((place / f"{place.name}.json").read_text()))
    every = exudyn_peer.check(case)
    model = exudyn_peer.Model(case)
    model.run({"name": setting, "parts": math.ceil(every / float(step) - 1e-6)}, every)
    found = columns(case, exudyn_peer.motion_of(case, model))
    with open(result, "w", newline="") as file:
        csv.writer(file).writerows([list(found), *zip(*(values.tolist() for values in found.values()))])


main(*sys.argv[1:])
