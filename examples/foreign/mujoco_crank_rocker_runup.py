#!/usr/bin/env python3
"""Run-up of the crank-rocker in MuJoCo from rest by its motor; drawn in the x-y plane, seen from above.

    python mujoco_crank_rocker_runup.py STEP FILE      writes a table in ms, degrees, rpm and N, every 2 ms of half a second

The linear motor law is a constant moment and a damping of the hinge; rotor, reducer and flywheel are its armature.
"""

import math
import sys

import mujoco
import numpy as np

from crank_rocker import COUPLER, CRANK, GROUND, RESISTANCE, ROCKER, start_angles
from mujoco_crank_rocker import HARD, friction_of, inertial, write

EVERY, END = 2e-3, 0.5
RATIO = 21.115384615384617
STALL, SLOPE = 22.51 * RATIO, 0.0716 * RATIO**2  # on the crank: N m, N m s/rad
ARMATURE = 9e-4 * RATIO**2 + 1.6


def model(step, integrator="RK4", stiffness=4, impedance=0.9999):
    """`stiffness` is the time constant of loop and friction in steps. RK4 needs four steps to resolve it; 0 means one step."""
    loop = f'solref="{stiffness * step} 1" solimp="{impedance} {impedance} 1"' if stiffness else HARD
    coupler, rocker = (math.degrees(angle) for angle in start_angles())
    return f"""
<mujoco model="crank-rocker, run-up">
  <option timestep="{step}" integrator="{integrator}" gravity="0 -9.81 0" iterations="50" tolerance="0"/>
  <default><equality {loop}/><joint axis="0 0 1" {friction_of(loop)}/></default>
  <worldbody>
    <body name="crank">
      <joint name="crank" armature="{ARMATURE}" damping="{SLOPE}"/> {inertial("crank", CRANK / 2)} <site name="O"/>
      <body name="coupler" pos="{CRANK} 0 0" euler="0 0 {coupler}">
        <joint name="coupler"/> {inertial("coupler", COUPLER / 2)} <site name="A"/> <site name="B" pos="{COUPLER} 0 0"/>
      </body>
    </body>
    <body name="rocker" pos="{GROUND[0]} {GROUND[1]} 0" euler="0 0 {rocker}">
      <joint name="rocker" frictionloss="{RESISTANCE}"/> {inertial("rocker", ROCKER)}
      <site name="C"/> <site name="end" pos="{ROCKER} 0 0"/>
    </body>
  </worldbody>
  <equality><connect site1="B" site2="end"/></equality>
  <actuator><motor name="stall" joint="crank"/></actuator>
  <sensor>
    <force name="F_O" site="O"/> <torque name="T_O" site="O"/> <force name="F_A" site="A"/> <force name="F_C" site="C"/>
  </sensor>
</mujoco>"""


def read(m, d):
    """One row in the units of a report; forces are in the drawing's axes."""
    crank, coupler, rocker = np.degrees(d.qpos)
    row = {"t [ms]": 1e3 * d.time, "crank [deg]": crank, "coupler to crank [deg]": coupler, "rocker [deg]": rocker}
    row |= {"speed [rpm]": d.qvel[0] * 30 / math.pi, "rocker speed [deg/s]": math.degrees(d.qvel[2])}
    row["rocker acc. [deg/s2]"] = math.degrees(d.qacc[2])
    for joint in "OAC":
        x, y, _ = d.site(joint).xmat.reshape(3, 3) @ d.sensor(f"F_{joint}").data
        row |= {f"{joint}x [N]": x, f"{joint}y [N]": y}
    row["shaft [N m]"] = d.sensor("T_O").data[2]
    return row


def simulate(step, **choices):
    m = mujoco.MjModel.from_xml_string(model(step, **choices))
    d = mujoco.MjData(m)
    d.ctrl[0] = STALL
    rows = []
    for instant in range(round(END / EVERY) + 1):
        if instant:
            mujoco.mj_step(m, d, nstep=round(EVERY / step))
        mujoco.mj_forward(m, d)
        rows.append(read(m, d))
    return rows


if __name__ == "__main__":
    write(sys.argv[2], simulate(float(sys.argv[1])))
