#!/usr/bin/env python3
"""The crank-rocker in pylinkage, in millimetres, at steps of two degrees of the crank.

    python pylinkage_crank_rocker.py FILE      writes positions, velocities and accelerations of its joints

A step turns the crank before it yields, so the first row is at 2 deg. A joint is a point; `rocker` is the pin
between coupler and rocker.
"""

import csv
import math
import sys

from pylinkage import Crank, FixedDyad, Ground, Linkage, RRRDyad


def build(coupler_above=True):
    o, c = Ground(0, 0, name="O"), Ground(150, 15, name="C")
    crank = Crank(anchor=o, radius=25.995627740337, angular_velocity=math.tau / 180, name="crank")
    # pylinkage chooses the configuration nearer to this position.
    hint = (300, 220) if coupler_above else (270, -210)
    pin = RRRDyad(crank.output, c, distance1=347.07193189181, distance2=250, x=hint[0], y=hint[1], name="rocker")
    tip = FixedDyad(c, pin, distance=1000 / 3, angle=0, name="tip")
    linkage = Linkage([o, c, crank, pin, tip], name="crank-rocker")
    linkage.set_input_velocity(crank, omega=130 * math.tau / 60)
    return linkage, (crank, pin, tip)


def simulate(path, first=1, **choices):
    """The table; `first` is the number of its first row."""
    linkage, joints = build(**choices)
    names = [f"{joint.name}.{what}" for joint in joints for what in ("x", "y", "vx", "vy", "ax", "ay")]
    with open(path, "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["step", *names])
        for step, _ in enumerate(linkage.step_with_derivatives(180), start=first):
            out.writerow([step, *(f"{value:.12g}" for joint in joints
                                  for pair in (joint.position, joint.velocity, joint.acceleration) for value in pair)])


if __name__ == "__main__":
    simulate(sys.argv[1])
