#!/usr/bin/env python3
"""Cost of many four-bars: `linkproof sweep` with ten figures of forces and motion, and with two figures of positions;
`Ensemble.simulate` of pylinkage with positions only.

    python pylinkage_sweep.py LINKPROOF [CASES [ROUNDS]]

The programs run in turn, on the same cores. The shortest times of a pose and their ratios are printed.
"""

import csv
import io
import math
import os
import resource
import subprocess
import sys
import tempfile
import time

import numpy
from pylinkage import Crank, Ground, Linkage, RRRDyad
from pylinkage.population import Ensemble

VARIED = {"crank_mm": (20, 40), "coupler_mm": (110, 135), "rocker_mm": (80, 100)}
GROUND = 100
FIGURES = ["max:joint.O.f_N", "max:joint.A.f_N", "max:joint.B.f_N", "max:joint.C.f_N", "maxabs:drive.torque_N_m",
           "rms:joint.C.fx_N", "range:point.E.x_mm", "at_max:point.E.y_mm", "maxabs:link.rocker.alpha_rad_s2",
           "mean:link.coupler.omega_rad_s"]
OF_POSITIONS = ["range:point.E.x_mm", "at_max:point.E.y_mm"]
POSES = 360
# Number of four-bars in one call of `Ensemble.simulate`, which returns 2.3 GB.
# With 20 000 four-bars the time per pose is up to a seventh shorter, with far fewer half as long.
MEMBERS = 100_000


def pin(crank, coupler, rocker):
    """The pin between coupler and rocker at the crank angle 0."""
    base = GROUND - crank
    along = (base**2 + coupler**2 - rocker**2) / (2 * base)
    return crank + along, math.sqrt(coupler**2 - along**2)


def ensemble(numbers):
    """The four-bars with these lengths."""
    o, c = Ground(0, 0, name="O"), Ground(GROUND, 0, name="C")
    crank = Crank(anchor=o, radius=numbers[0][0], angular_velocity=math.tau / POSES, name="A")
    x, y = pin(*numbers[0])
    rocker = RRRDyad(crank.output, c, distance1=numbers[0][1], distance2=numbers[0][2], x=x, y=y, name="B")
    linkage = Linkage([o, c, crank, rocker], name="four-bar")
    places = [[(0, 0), (GROUND, 0), (lengths[0], 0), pin(*lengths)] for lengths in numbers]
    return Ensemble(linkage, numpy.array(numbers), numpy.array(places, dtype=float))


def spent(work):
    """Processor time, children included, and time by the clock (s)."""
    of = lambda who: sum(resource.getrusage(who)[:2])
    both = lambda: of(resource.RUSAGE_SELF) + of(resource.RUSAGE_CHILDREN)
    used, clock = both(), time.perf_counter()
    work()
    return numpy.array([both() - used, time.perf_counter() - clock])


def main(linkproof, cases="100000", rounds="5"):
    cases = int(cases)
    linkproof = os.path.abspath(linkproof)
    random = numpy.random.default_rng(1)
    numbers = random.uniform(*numpy.array(list(VARIED.values())).T, (MEMBERS, len(VARIED))).tolist()
    members = ensemble(numbers)
    with tempfile.TemporaryDirectory() as place:
        run = lambda *words: subprocess.run([linkproof, *words], cwd=place, check=True, capture_output=True, text=True).stdout
        run("new", "four-bar")
        # Both programs give the same positions.
        setting = [word for key, number in zip(VARIED, numbers[0]) for word in ("--set", f"{key}={number!r}")]
        table = csv.DictReader(io.StringIO(run("solve", "four_bar.toml", "--set", "grid.step_deg=1", *setting)))
        expected = [(float(row["point.B.x_m"]) * 1e3, float(row["point.B.y_m"]) * 1e3) for row in table]
        apart = numpy.abs(members.simulate(POSES)[0, :, 3] - expected[1:]).max()
        assert apart < 1e-6, f"{apart} mm apart"
        vary = [word for key, (low, high) in VARIED.items() for word in ("--vary", f"{key}={low}:{high}")]
        sweep = ["sweep", "four_bar.toml", "--set", "grid.step_deg=1", "--sobol", str(cases), *vary]
        asked = {"all forces, ten figures": FIGURES, "positions, two figures": OF_POSITIONS}
        ours, theirs = {name: [] for name in asked}, []
        for number in range(int(rounds)):
            for name, figures in asked.items():
                words = [word for figure in figures for word in ("--figure", figure)]
                done = spent(lambda: run(*sweep, *words, "-o", f"{len(figures)}_{number}"))
                ours[name].append(done / (cases * (POSES + 1)))
            theirs.append(spent(lambda: members.simulate(POSES)) / (MEMBERS * POSES))
    best = numpy.min(theirs, axis=0)
    print(f"Ensemble.simulate, positions only: {best[0] * 1e9:.1f} ns a pose of processor time, {best[1] * 1e9:.1f} by the clock")
    for name, found in ours.items():
        time, clock = numpy.min(found, axis=0)
        print(f"linkproof sweep, {name}: {time * 1e9:.1f} ns a pose of processor time, {clock * 1e9:.1f} by the clock")
        print(f"  ratio: {best[0] / time:.1f} of processor time, {best[1] / clock:.1f} by the clock on {os.cpu_count()} cores")


main(*sys.argv[1:])
