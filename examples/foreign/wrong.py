#!/usr/bin/env python3
"""Writes tables with one typical mistake each to data/wrong_*; README.md lists the mistakes."""

import contextlib
import pathlib
import tempfile

import exudyn_crank_rocker
import exudyn_crankcase
import mujoco_crank_rocker
import pylinkage_crank_rocker
import pylinkage_six_bar
from crank_rocker import COUPLER, INERTIA, MASS

DATA = pathlib.Path(__file__).resolve().parent / "data"


def four_bar(name, step, **choices):
    mujoco_crank_rocker.write(DATA / name, mujoco_crank_rocker.simulate(step, **choices))


def write():
    four_bar("wrong_mujoco_soft.csv", 1e-3, loop="")
    four_bar("wrong_mujoco_late.csv", 1e-3, late=True)
    four_bar("wrong_mujoco_start.csv", 1e-3, since=0.0)
    four_bar("wrong_mujoco_lag.csv", 1e-3, gain=1e4)
    four_bar("wrong_mujoco_reset.csv", 2e-3, gain=1e4, integrator="implicitfast", since=0.0)
    about_end = INERTIA | {"coupler": INERTIA["coupler"] + MASS["coupler"] * (COUPLER / 2) ** 2}
    exudyn_crank_rocker.simulate(2.5e-4, DATA / "wrong_exudyn_inertia.csv", inertia=about_end)
    exudyn_crank_rocker.simulate(1e-3, DATA / "wrong_exudyn_ringing.csv", radius=0.9)
    exudyn_crankcase.simulate(exudyn_crankcase.END / 1440, DATA / "wrong_exudyn_no_gravity.txt", gravity=0.0)
    pylinkage_crank_rocker.simulate(DATA / "wrong_pylinkage_early.csv", first=0)
    pylinkage_crank_rocker.simulate(DATA / "wrong_pylinkage_branch.csv", coupler_above=False)
    pylinkage_six_bar.simulate(DATA / "wrong_pylinkage_tracker.csv", compiled=False)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):  # MuJoCo writes its log into the working directory
        write()
