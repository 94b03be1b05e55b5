#!/usr/bin/env python3
"""A slider-crank with counterweight in Exudyn, one turn at 600 rpm.

    python exudyn_crankcase.py STEPS FILE      writes Exudyn's solution file: comments, no names, all coordinates

Columns: time; displacements (from the reference pose), velocities and accelerations of crank, rod and piston, each
x, y, rotation; the multipliers of the joints O, A, B, of the bore and of the motor, in the order in which they were added.
"""

import math
import sys

import exudyn as exu
from exudyn.utilities import (
    CoordinateConstraint,
    LoadMassProportional,
    MarkerBodyMass,
    MarkerBodyPosition,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    NodePointGround,
    NodeRigidBody2D,
    ObjectGround,
    ObjectJointPrismatic2D,
    ObjectRigidBody2D,
    RevoluteJoint2D,
)

from exudyn_crank_rocker import RADIUS, run

CRANK, ROD = 0.040, 0.130
SPEED = 600 * 2 * math.pi / 60
END = 0.1


def model(gravity=9.81):
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(ObjectGround())
    still = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=mbs.AddNode(NodePointGround()), coordinate=0))
    # With the crank along +x, crank pin and piston have the same velocity, so the rod does not rotate at this instant.
    height, up = math.sqrt(ROD**2 - CRANK**2), SPEED * CRANK
    c, s = -CRANK / ROD, height / ROD
    bodies = []
    for mass, inertia, x, y, angle, velocity in (
        (1.2, 0.0011, -0.014, 0.0, 0.0, [0.0, -0.014 * SPEED, SPEED]),
        (0.35, 0.0008, CRANK + 0.045 * c, 0.045 * s, math.atan2(s, c), [0.0, up, 0.0]),
        (0.3, 0.0002, 0.0, height + 0.008, 0.0, [0.0, up, 0.0]),
    ):
        node = mbs.AddNode(NodeRigidBody2D(referenceCoordinates=[x, y, angle], initialVelocities=velocity))
        bodies.append((mbs.AddObject(ObjectRigidBody2D(mass=mass, inertia=inertia, nodeNumber=node)), node))
        mass_marker = mbs.AddMarker(MarkerBodyMass(bodyNumber=bodies[-1][0]))
        mbs.AddLoad(LoadMassProportional(markerNumber=mass_marker, loadVector=[0, -gravity, 0]))
    (crank, crank_node), (rod, _), (piston, _) = bodies
    point = lambda body, x, y=0.0: mbs.AddMarker(MarkerBodyPosition(bodyNumber=body, localPosition=[x, y, 0]))
    frame = lambda body, x, y=0.0: mbs.AddMarker(MarkerBodyRigid(bodyNumber=body, localPosition=[x, y, 0]))
    mbs.AddObject(RevoluteJoint2D(markerNumbers=[point(ground, 0), point(crank, 0.014)]))
    mbs.AddObject(RevoluteJoint2D(markerNumbers=[point(crank, 0.054), point(rod, -0.045)]))
    mbs.AddObject(RevoluteJoint2D(markerNumbers=[point(rod, 0.085), point(piston, 0, -0.008)]))
    mbs.AddObject(ObjectJointPrismatic2D(
        markerNumbers=[frame(ground, 0), frame(piston, 0, -0.008)], axisMarker0=[0, 1, 0], normalMarker1=[1, 0, 0]))
    angle = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=crank_node, coordinate=2))
    mbs.AddObject(CoordinateConstraint(
        markerNumbers=[still, angle], offsetUserFunction=lambda mbs, t, item, offset: SPEED * t,
        offsetUserFunction_t=lambda mbs, t, item, offset: SPEED))
    mbs.Assemble()
    return mbs


def simulate(step, path, radius=RADIUS, gravity=9.81):
    run(model(gravity), step, END, END / 180, radius, str(path))


if __name__ == "__main__":
    simulate(END / float(sys.argv[1]), sys.argv[2])
