#!/usr/bin/env python3
"""Simulates a mechanism of the set of truths in MuJoCo: python mujoco_run.py golden/crank_rocker STEP RESULT.csv

The result is at the instants of the truth; the step is shortened so that it divides their interval. It has the angle, the
angular velocity, and the place and velocity of the mass centre of every link, and the forces of the joints that close
loops. `check.py` of the set compares it with the truth. Needs mujoco and numpy."""
import csv
import math
import sys
import tomllib
from pathlib import Path

import mujoco
import numpy as np


def state(model, data, links, loops):
    """A row of the result."""
    row, velocity = [data.time], np.zeros(6)
    for link in links:
        body, turn = data.body(link), data.body(link).xmat
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body.id, velocity, 0)
        row += [np.arctan2(turn[3], turn[0]), velocity[2], *body.xipos[:2], *velocity[3:5]]
    for loop in loops:
        rows = data.efc_id[: data.nefc] == model.equality(loop).id
        rows &= data.efc_type[: data.nefc] == mujoco.mjtConstraint.mjCNSTR_EQUALITY
        # The rows of a `connect` are the force on the first of its sites.
        row += list(-data.efc_force[: data.nefc][rows][:2])
    return row


def main(directory, step, result):
    place = Path(directory)
    links = list(tomllib.loads((place / f"{place.name}.toml").read_text())["links"])
    with open(place / "truth.csv", newline="") as file:
        times = [float(row["t_s"]) for row in csv.DictReader(file)]
    model = mujoco.MjModel.from_xml_path(str(place / f"{place.name}.xml"))
    loops = [model.equality(k).name for k in range(model.neq) if model.eq_type[k] == mujoco.mjtEq.mjEQ_CONNECT]
    # Number of MuJoCo's steps between two instants of truth.csv.
    parts = math.ceil((times[1] - times[0]) / float(step) - 1e-6)
    model.opt.timestep = (times[1] - times[0]) / parts
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    rows = []
    for _ in times:
        mujoco.mj_forward(model, data)
        rows.append(state(model, data, links, loops))
        mujoco.mj_step(model, data, parts)
    names = ["angle_rad", "omega_rad_s", "x_m", "y_m", "vx_m_s", "vy_m_s"]
    head = ["t_s", *[f"link.{link}.{name}" for link in links for name in names],
            *[f"joint.{loop}.{name}" for loop in loops for name in ("fx_N", "fy_N")]]
    with open(result, "w", newline="") as file:
        csv.writer(file).writerows([head, *rows])


main(*sys.argv[1:])
