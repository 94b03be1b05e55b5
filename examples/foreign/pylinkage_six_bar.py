#!/usr/bin/env python3
"""The six-bar with a slider in pylinkage, with the crank as the unit of length and no unit of time.

    python pylinkage_six_bar.py FILE      writes positions, and their first and second derivatives with respect to the crank angle
"""

import math
import sys

import numpy as np
from pylinkage import Crank, Ground, Linkage, PointTracker, RRPDyad, RRRDyad

STEPS = 240


def stepped(linkage):
    """The same table by step_with_derivatives(); NaN for missing derivatives."""
    rows = [[[pair or (math.nan, math.nan) for pair in what] for what in step] for step in linkage.step_with_derivatives(STEPS)]
    return np.array(rows).transpose(1, 0, 2, 3)


def simulate(path, compiled=True):
    o1, o2, above = Ground(-5.2, 2.4), Ground(0, 0), Ground(0, 1)
    a = Crank(anchor=o1, radius=1, angular_velocity=math.tau / STEPS)
    b = RRRDyad(a.output, o2, distance1=5, distance2=3, x=0.8, y=2.9)
    c = PointTracker(o2, b, distance=6, angle=0)
    d = RRPDyad(c, o2, above, distance=8, x=0, y=13)
    linkage = Linkage([o1, o2, above, a, b, c, d])
    linkage.set_input_velocity(a, omega=1.0)  # derivatives with respect to the crank angle
    # The compiled path is used, because step_with_derivatives() gives no velocity for a PointTracker, and gives 0 for
    # the joints attached to the tracker.
    every = linkage.step_fast_with_kinematics(STEPS) if compiled else stepped(linkage)
    phi = np.arange(1, STEPS + 1) * math.tau / STEPS
    columns, names = [phi], ["phi"]
    for part, name in ((a, "A"), (b, "B"), (c, "C"), (d, "D")):
        at = linkage.components.index(part)
        for values, mark in zip(every, ("", "'", "''")):
            names += [f"{axis}_{name}{mark}" for axis in "xy"]
            columns += [values[:, at, 0], values[:, at, 1]]
    np.savetxt(path, np.column_stack(columns), fmt="%.12g", delimiter=",", header=",".join(names), comments="")


if __name__ == "__main__":
    simulate(sys.argv[1])
