#!/usr/bin/env python3
"""Errors and orders of the three programs against the analytic side, as the tables of docs/foreign.md.

    python orders.py [LINKPROOF]      default: target/release/linkproof

Every run is repeated in a temporary directory. Errors are computed from `linkproof solve` with numpy, independently of
`linkproof compare`.
"""

import math
import pathlib
import sys
import tempfile

import exudyn_crank_rocker
import exudyn_crankcase
import mujoco_crank_rocker as four_bar
import mujoco_crank_rocker_runup as runup
import pylinkage_crank_rocker
import pylinkage_six_bar
from tables import KINDS, errors

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
STEPS = (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4)
# Steps that show whether the error of a modelling choice falls with a power of the step, or not at all.
PAIR, FINE = (1e-3, 2.5e-4), (1e-3, 2.5e-4, 3.125e-5)
TURN = exudyn_crankcase.END


def mujoco(module, **choices):
    return lambda step, path: four_bar.write(path, module.simulate(step, **choices))


def exudyn(module, **settings):
    return lambda step, path: module.simulate(step, path, **settings)


NAMES = [name for name, _ in KINDS]
ROTOR = dict(gain=0, rotor=1e10, integrator="implicitfast")
CIRCLE = [TURN / parts for parts in (180, 360, 720, 1440, 2880)]
# Name, scenario, mapping, function that makes a run, and steps; closed formulas have no step.
CASES = (
    ("MuJoCo, loop of one step, servo of 1e6 N m s/rad", "crank_rocker", "mujoco_crank_rocker", mujoco(four_bar), STEPS),
    ("MuJoCo, RK4, loop of four steps", "crank_rocker_runup", "mujoco_crank_rocker_runup", mujoco(runup), STEPS[1:]),
    ("Exudyn, spectral radius 0.6", "crank_rocker", "exudyn_crank_rocker", exudyn(exudyn_crank_rocker), STEPS),
    ("Exudyn, spectral radius 0.9", "crank_rocker", "exudyn_crank_rocker", exudyn(exudyn_crank_rocker, radius=0.9), STEPS),
    ("Exudyn, spectral radius 0.6", "crankcase", "exudyn_crankcase", exudyn(exudyn_crankcase), CIRCLE),
    ("pylinkage", "crank_rocker", "pylinkage_crank_rocker", lambda _, path: pylinkage_crank_rocker.simulate(path), [None]),
    ("pylinkage", "six_bar_slider", "pylinkage_six_bar", lambda _, path: pylinkage_six_bar.simulate(path), [None]),
)
# Runs with other modelling choices; the mappings are the same.
CHOICES = (
    (*CASES[0][:4], PAIR),
    ("servo of 1e4", *CASES[0][1:3], mujoco(four_bar, gain=1e4), PAIR),
    ("heavy rotor in place of the servo, `implicitfast`", *CASES[0][1:3], mujoco(four_bar, **ROTOR), FINE),
    ("loop and friction as soft as MuJoCo's own: 20 ms", *CASES[0][1:3], mujoco(four_bar, loop=""), PAIR),
    ("the same with 5 ms", *CASES[0][1:3], mujoco(four_bar, loop='solref="0.005 1"'), PAIR),
    ("the same with 2.5 ms", *CASES[0][1:3], mujoco(four_bar, loop='solref="0.0025 1"'), PAIR),
    ("read right after `mj_step`", *CASES[0][1:3], mujoco(four_bar, late=True), PAIR),
    ("run-up, RK4, loop of four steps", *CASES[1][1:4], (5e-4, 2.5e-4)),
    ("run-up, RK4, loop of one step", *CASES[1][1:3], mujoco(runup, stiffness=0), (5e-4, 2.5e-4)),
    ("run-up, `implicitfast`, loop of one step", *CASES[1][1:3],
     mujoco(runup, integrator="implicitfast", stiffness=0), (5e-4, 2.5e-4)),
)


def runs(linkproof, case, folder):
    """For every step of a case: the step, and the errors by kind."""
    _, scenario, mapping, make, steps = case
    for step in steps:
        path = pathlib.Path(folder) / "table.csv"
        make(step, path)
        yield step, errors(linkproof, str(ROOT / "scenarios" / f"{scenario}.toml"), path, HERE / f"{mapping}.map.toml")


def short(number):
    return f"{number:.1e}".replace("e-0", "e-") if number < 1 else f"{number:.2g}"


def cells(found, pick):
    """Errors at decreasing steps, each with the order from the previous step; errors of printed digits have no order."""
    last = None
    for step, by in found:
        now = pick(by)
        order = f" ({math.log(last[1] / now) / math.log(last[0] / step):.2f})" if last and min(now, last[1]) > 1e-8 else ""
        yield short(now) + order
        last = (step, now)


def row(words):
    print("| " + " | ".join(words) + " |")


def tables(linkproof, folder):
    for case in CASES:
        found = list(runs(linkproof, case, folder))
        steps = ["of scale" if step is None else f"{step:.3g} s" for step, _ in found]
        print(f"\n{case[0]}, `{case[1]}`:\n")
        row(["kind", *steps, "largest error of the last run"])
        row(["---"] * (len(steps) + 2))
        for name in NAMES:
            if name not in found[0][1]:
                continue
            worst = found[-1][1][name]
            row([name, *cells(found, lambda by: by[name].share), f"{short(worst.error)} in `{worst.channel}`"])
            late = list(cells(found, lambda by: by[name].later))
            # If the errors are largest at the start, the errors of the second half are listed too.
            if any(1e-8 < 4 * by[name].later < by[name].share for _, by in found):
                row([f"{name}, second half", *late, ""])


def choices(linkproof, folder):
    wanted = NAMES[1:]
    print()
    row(["choice", "step", *wanted])
    row(["---"] * (len(wanted) + 2))
    for case in CHOICES:
        for step, found in runs(linkproof, case, folder):
            row([case[0], f"{step:.3g} s", *(short(found[name].share) for name in wanted)])


if __name__ == "__main__":
    binary = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "target/release/linkproof")
    with tempfile.TemporaryDirectory() as folder:
        tables(binary, folder)
        choices(binary, folder)
