#!/usr/bin/env python3
"""The crank-rocker in MuJoCo, drawn in MuJoCo's x-z plane and driven by a velocity servo.

    python mujoco_crank_rocker.py STEP FILE      writes the values of the sensors, every 4 ms of one turn

Hinges turn about +y, which points into the drawing: positive is clockwise. Their coordinates are relative to the parent
body and zero in the pose in which the model is drawn.
"""

import math
import sys

import mujoco
import numpy as np

from crank_rocker import COUPLER, CRANK, GROUND, INERTIA, MASS, RESISTANCE, ROCKER, SPEED, start_angles, start_speeds

# Forces of the first steps are wrong, because a constraint does not include the centripetal accelerations.
# Their effect appears only some steps later, when a gap has opened between the two points of the constraint.
EVERY, SETTLED, END = 4e-3, 20e-3, 0.48
# A loop as stiff as the step allows: MuJoCo raises the time constant to two steps.
HARD = 'solref="1e-9 0.5" solimp="0.9999 0.9999 1"'
SENSORS = ("F_O", "T_O", "F_A", "F_C", "B", "vB", "aB")


def friction_of(loop):
    """The same stiffness for dry friction, which is a separate constraint in MuJoCo."""
    return loop.replace("solref", "solreffriction").replace("solimp", "solimpfriction")


def inertial(name, at):
    return f'<inertial pos="{at} 0 0" mass="{MASS[name]}" diaginertia="{INERTIA[name]} {INERTIA[name]} {INERTIA[name]}"/>'


def model(step, loop=HARD, gain=1e6, integrator="discrete", rotor=0.0):
    """`gain` of the servo (N m s/rad). With gain 0 there is no servo; the inertia `rotor` (kg m2) keeps the speed of the crank."""
    coupler, rocker = (math.degrees(angle) for angle in start_angles())
    servo = f'<actuator><velocity name="motor" joint="crank" kv="{gain}"/></actuator>' if gain else ""
    return f"""
<mujoco model="crank-rocker">
  <option timestep="{step}" integrator="{integrator}" iterations="50" tolerance="0"/>
  <default><equality {loop}/><joint axis="0 1 0" {friction_of(loop)}/></default>
  <worldbody>
    <body name="crank">
      <joint name="crank" armature="{rotor}"/> {inertial("crank", CRANK / 2)} <site name="O"/>
      <body name="coupler" pos="{CRANK} 0 0" euler="0 {-coupler} 0">
        <joint name="coupler"/> {inertial("coupler", COUPLER / 2)} <site name="A"/> <site name="B" pos="{COUPLER} 0 0"/>
      </body>
    </body>
    <body name="rocker" pos="{GROUND[0]} 0 {GROUND[1]}" euler="0 {-rocker} 0">
      <joint name="rocker" frictionloss="{RESISTANCE}"/> {inertial("rocker", ROCKER)}
      <site name="C"/> <site name="end" pos="{ROCKER} 0 0"/>
    </body>
  </worldbody>
  <equality><connect name="B" site1="B" site2="end"/></equality>
  {servo}
  <sensor>
    <force name="F_O" site="O"/> <torque name="T_O" site="O"/> <force name="F_A" site="A"/> <force name="F_C" site="C"/>
    <framepos name="B" objtype="site" objname="B"/> <framelinvel name="vB" objtype="site" objname="B"/>
    <framelinacc name="aB" objtype="site" objname="B"/>
  </sensor>
</mujoco>"""


def start(step, **choices):
    m = mujoco.MjModel.from_xml_string(model(step, **choices))
    d = mujoco.MjData(m)
    coupler, rocker = start_speeds(SPEED)
    d.qvel[:] = -SPEED, -(coupler - SPEED), -rocker
    if m.nu:
        d.ctrl[0] = -SPEED
    return m, d


def read(m, d):
    """One row: coordinates, sensors, force in the loop, and force of the servo."""
    row = {"time": d.time}
    for what, values in (("q", d.qpos), ("qd", d.qvel), ("qdd", d.qacc)):
        row |= {f"{what}_{m.joint(j).name}": values[j] for j in range(m.njnt)}
    for name in SENSORS:
        x, y, z = d.sensor(name).data
        row |= {f"{name}.y": y} if name == "T_O" else {f"{name}.x": x, f"{name}.z": z}
    loop = d.efc_force[: d.nefc][d.efc_type[: d.nefc] == mujoco.mjtConstraint.mjCNSTR_EQUALITY]
    row |= {"efc_B.x": loop[0], "efc_B.z": loop[2]}
    if m.nu:
        row["motor"] = d.actuator_force[0]
    return row


def simulate(step, late=False, since=SETTLED, **choices):
    """Rows every 4 ms. If `late`, values are read right after mj_step, when the sensors are one step old."""
    m, d = start(step, **choices)
    rows = []
    for instant in range(round(END / EVERY) + 1):
        if instant:
            mujoco.mj_step(m, d, nstep=round(EVERY / step))
        if not late:
            mujoco.mj_forward(m, d)  # sensors and forces of the present state
        if instant >= round(since / EVERY):
            rows.append(read(m, d))
    return rows


def write(path, rows):
    np.savetxt(path, [list(row.values()) for row in rows], fmt="%.10g", delimiter=",", header=",".join(rows[0]), comments="")


if __name__ == "__main__":
    write(sys.argv[2], simulate(float(sys.argv[1])))
