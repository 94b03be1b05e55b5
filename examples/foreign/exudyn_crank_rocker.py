#!/usr/bin/env python3
"""The crank-rocker in Exudyn: plane rigid bodies, revolute joints, a prescribed crank angle.

    python exudyn_crank_rocker.py STEP FILE      joins the tables of the sensors, every 4 ms of one turn

Sensors of joints give the force of the second marker's body on the first. The rotation of a plane body is measured from
its reference pose; its position is not.
"""

import math
import pathlib
import sys
import tempfile

import exudyn as exu
import numpy as np
from exudyn.utilities import (
    CoordinateConstraint,
    CoordinateSpringDamperExt,
    LoadMassProportional,
    MarkerBodyMass,
    MarkerBodyPosition,
    MarkerNodeCoordinate,
    NodePointGround,
    NodeRigidBody2D,
    ObjectGround,
    ObjectRigidBody2D,
    RevoluteJoint2D,
    SensorBody,
    SensorObject,
)

from crank_rocker import COUPLER, CRANK, GROUND, INERTIA, MASS, RESISTANCE, ROCKER, SPEED, start_angles, start_speeds

EVERY, END = 4e-3, 0.46
# Spectral radius. With Exudyn's default of 0.9, forces oscillate for a quarter of a turn after the start.
RADIUS = 0.6
KINDS = exu.OutputVariableType
BODY = {"Rot": KINDS.Rotation, "Omega": KINDS.AngularVelocity, "Alpha": KINDS.AngularAcceleration}
POINT = {"Pos": KINDS.Position, "Vel": KINDS.Velocity, "Acc": KINDS.Acceleration}


def turned(length, angle):
    return np.array([length * math.cos(angle), length * math.sin(angle)])


def model(folder, inertia=None):
    """The system, and the sensor files with the names of their columns."""
    inertia = inertia or INERTIA
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(ObjectGround())
    still = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=mbs.AddNode(NodePointGround()), coordinate=0))
    coupler, rocker = start_angles()
    places = {  # start of a body, distance of its mass centre, angle
        "crank": (np.zeros(2), CRANK / 2, 0.0), "coupler": (turned(CRANK, 0.0), COUPLER / 2, coupler),
        "rocker": (np.array(GROUND), ROCKER, rocker)}
    speeds = dict(zip(places, (SPEED, *start_speeds(SPEED))))
    bodies, angle, markers = {}, {}, {"O0": (ground, (0, 0)), "C0": (ground, GROUND)}
    for name, (begin, arm, turn) in places.items():
        base = SPEED * turned(CRANK, math.pi / 2) if name == "coupler" else np.zeros(2)
        velocity = base + speeds[name] * turned(arm, turn + math.pi / 2)
        node = mbs.AddNode(NodeRigidBody2D(referenceCoordinates=[*(begin + turned(arm, turn)), turn],
                                           initialVelocities=[*velocity, speeds[name]]))
        bodies[name] = mbs.AddObject(ObjectRigidBody2D(mass=MASS[name], inertia=inertia[name], nodeNumber=node))
        angle[name] = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=2))
        mbs.AddLoad(LoadMassProportional(
            markerNumber=mbs.AddMarker(MarkerBodyMass(bodyNumber=bodies[name])), loadVector=[0, -9.81, 0]))
    markers |= {"O1": (bodies["crank"], (-CRANK / 2, 0)), "A0": (bodies["crank"], (CRANK / 2, 0))}
    markers |= {"A1": (bodies["coupler"], (-COUPLER / 2, 0)), "B0": (bodies["coupler"], (COUPLER / 2, 0))}
    markers |= {"B1": (bodies["rocker"], (0, 0)), "C1": (bodies["rocker"], (-ROCKER, 0))}
    number = {name: mbs.AddMarker(MarkerBodyPosition(bodyNumber=body, localPosition=[*at, 0]))
              for name, (body, at) in markers.items()}
    joints = {j: mbs.AddObject(RevoluteJoint2D(markerNumbers=[number[j + "0"], number[j + "1"]])) for j in "OABC"}
    motor = mbs.AddObject(CoordinateConstraint(
        markerNumbers=[still, angle["crank"]], offsetUserFunction=lambda mbs, t, item, offset: SPEED * t,
        offsetUserFunction_t=lambda mbs, t, item, offset: SPEED))
    mbs.AddObject(CoordinateSpringDamperExt(
        markerNumbers=[still, angle["rocker"]], dynamicFrictionForce=RESISTANCE, frictionProportionalZone=1e-8))

    files = []

    def sensor(kind, name, columns, **of):
        path = folder / f"{name}.txt"
        mbs.AddSensor(kind(fileName=str(path), **of))
        files.append((path, columns))

    for name, body in bodies.items():
        for what, kind in BODY.items():
            # The rotation of a plane body is one number; its angular velocity and acceleration are vectors.
            columns = [f"{name}{what}"] if what == "Rot" else [None, None, f"{name}{what}"]
            sensor(SensorBody, name + what, columns, bodyNumber=body, outputVariableType=kind)
    for what, kind in POINT.items():
        sensor(SensorBody, "B" + what, [f"B{what}X", f"B{what}Y", None],
               bodyNumber=bodies["rocker"], outputVariableType=kind)
    for name, joint in joints.items():
        sensor(SensorObject, "force" + name, [f"force{name}X", f"force{name}Y", None],
               objectNumber=joint, outputVariableType=KINDS.Force)
    sensor(SensorObject, "motor", ["motor"], objectNumber=motor, outputVariableType=KINDS.Force)
    mbs.Assemble()
    return mbs, files


def run(mbs, step, end, every, radius=RADIUS, solution=""):
    """Runs the simulation; all coordinates go to the file `solution`."""
    asked = exu.SimulationSettings()
    asked.timeIntegration.numberOfSteps, asked.timeIntegration.endTime = round(end / step), end
    asked.timeIntegration.generalizedAlpha.spectralRadius = radius
    asked.timeIntegration.newton.useModifiedNewton = False
    asked.timeIntegration.verboseMode = 0
    asked.solution.sensors.writePeriod = asked.solution.file.writePeriod = every
    asked.solution.file.name, asked.solution.file.write = solution, bool(solution)
    mbs.SolveDynamic(asked)


def simulate(step, path, radius=RADIUS, inertia=None):
    """Writes the comments of the first sensor, a line of names, and a row for each instant."""
    with tempfile.TemporaryDirectory() as folder:
        mbs, files = model(pathlib.Path(folder), inertia)
        run(mbs, step, END, EVERY, radius)
        comments = [line for line in files[0][0].read_text().splitlines(True) if line.startswith("#")]
        names, columns = ["time"], [np.loadtxt(files[0][0], delimiter=",", comments="#")[:, 0]]
        for file, wanted in files:
            data = np.loadtxt(file, delimiter=",", comments="#")[:, 1:]
            names += [name for name in wanted if name]
            columns += [data[:, at] for at, name in enumerate(wanted) if name]
    with open(path, "w") as out:
        out.writelines([*comments, ",".join(names) + "\n"])
        np.savetxt(out, np.column_stack(columns), fmt="%.10g", delimiter=",")


if __name__ == "__main__":
    simulate(float(sys.argv[1]), sys.argv[2])
