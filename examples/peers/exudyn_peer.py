#!/usr/bin/env python3
"""Exudyn as a peer of `linkproof bench`: plane rigid bodies, revolute and prismatic joints, gears (pip install exudyn numpy).

    linkproof bench scenarios/crank_rocker.toml -o bench --peer exudyn='python3 examples/peers/exudyn_peer.py'

The measured time is the time of the solver alone, without building the model and without writing.
"""

import math
import sys
import time

sys.exudynFast = True  # Exudyn's build without range checks
import exudyn
import numpy as np
from exudyn import itemInterface as exu

from linkproof_peer import Motion, Refused, main

SETTINGS = {
    "alpha, radius 0.8, full Newton": dict(spectralRadius=0.8),
    "alpha, radius 0.5, full Newton": dict(spectralRadius=0.5),
    "Newmark, index 2": dict(useNewmark=True, useIndex2Constraints=True),
}
# Types of load that this peer has besides constant forces and moments.
LOADS = ("resistance", "spring", "damper", "torsion_spring", "torsion_damper")
# Numbers of steps in an interval of the grid.
PARTS = (1, 2, 4, 8, 16)
REPEATS = 3
# A resistance is proportional to the speed below ZONE (rad/s); from rest, links start with START (rad/s).
ZONE, START = 1e-8, 1e-7
KINDS = exudyn.OutputVariableType


def check(case):
    """Refuses cases that this peer cannot model."""
    for transmission in case.data["transmissions"]:
        if transmission["ratio"] is None or transmission["type"] != "gears" or transmission["efficiency"] != [1.0, 1.0]:
            raise Refused(f"transmission {transmission['name']}: this peer has gears without losses only")
    for load in case.loads:
        if load["type"] not in LOADS and not constant(load):
            raise Refused(f"this peer has no load of type {load['type']}")
    for drive in case.drives:
        motor = drive["motion"].get("motor")
        if drive["motion"]["law"] not in ("constant", "ramp", "cycloidal", "free"):
            raise Refused(f"this peer has no law {drive['motion']['law']}")
        if motor and "start_m" in drive:
            raise Refused("this peer has motors of turning links only")
        if motor and (motor["torque"]["law"] not in ("constant", "linear") or motor["efficiency"] < 1.0):
            raise Refused("this peer has motors without losses whose law is a straight line")
    return case.uniform()


def constant(load):
    """Whether a load is a constant moment, or a force that is constant in the world."""
    if load["type"] == "moment":
        return load["acts"] == "always" and isinstance(load["moment_N_m"], float)
    return load["type"] == "force" and not load["follows"] and all(isinstance(part, float) for part in load["force_N"])


def ways(request, case):
    every = check(case)
    parts = PARTS[1:4] if request["quick"] else PARTS
    names = list(SETTINGS)[:1] if request["quick"] else SETTINGS
    return [{"name": name, "resolution": f"step {every / part:.3e} s", "parts": part} for name in names for part in parts]


def law(motion, t):
    """Rotation or slide from the start, and speed, of a prescribed drive at a time."""
    named = lambda name: next(value for key, value in motion.items() if key.startswith(name))
    if motion["law"] == "constant":
        return named("speed") * t, named("speed")
    time, s = motion["time_s"], t / motion["time_s"]
    if motion["law"] == "ramp":
        speed = named("speed")
        return (speed * t * s / 2, speed * s) if t < time else (speed * (t - time / 2), speed)
    rise = named("rise")
    return rise * (s - math.sin(2 * math.pi * s) / (2 * math.pi)), rise / time * (1 - math.cos(2 * math.pi * s))


class Model:
    """A system of Exudyn with its sensors."""

    def __init__(self, case):
        self.case, self.system = case, exudyn.SystemContainer().AddSystem()
        system = self.system
        self.bodies, self.nodes, self.reference = {"ground": system.AddObject(exu.ObjectGround())}, {}, {}
        shafts = {drive["link"]: drive for drive in case.drives}
        lead = case.links[case.drives[0]["link"]]["start"]
        at_rest = case.data["free"] and not any(link["start"]["omega_rad_s"] for link in case.moving)
        share = START / abs(lead["alpha_rad_s2"]) if at_rest and lead["alpha_rad_s2"] else 0.0
        for link in case.moving:
            name, begun = link["name"], link["start"]
            arm = self.turned(begun["angle_rad"], link["mass_centre_m"])
            at = [*(np.array(begun["origin_m"]) + arm), begun["angle_rad"]]
            across, omega = np.array([-arm[1], arm[0]]), begun["omega_rad_s"]
            speed = np.array([*(np.array(begun["velocity_m_s"]) + across * omega), omega])
            if share:
                ahead = np.array(begun["acceleration_m_s2"]) + across * begun["alpha_rad_s2"]
                speed = share * np.array([*ahead, begun["alpha_rad_s2"]])
            motor = shafts[name]["motion"].get("motor") if name in shafts else None
            inertia = link["inertia_kg_m2"] + (motor["inertia_on_crank_kg_m2"] if motor else 0.0)
            self.reference[name] = np.array(at)
            self.nodes[name] = system.AddNode(exu.NodeRigidBody2D(referenceCoordinates=at, initialVelocities=list(speed)))
            self.bodies[name] = system.AddObject(
                exu.ObjectRigidBody2D(mass=link["mass_kg"], inertia=inertia, nodeNumber=self.nodes[name]))
            centre = system.AddMarker(exu.MarkerBodyPosition(bodyNumber=self.bodies[name]))
            system.AddLoad(exu.Force(markerNumber=centre, loadVector=[*(case.gravity * link["mass_kg"]), 0]))
        still = system.AddNode(exu.NodePointGround())
        self.still = system.AddMarker(exu.MarkerNodeCoordinate(nodeNumber=still, coordinate=0))
        self.nothing = system.AddMarker(exu.MarkerNodeCoordinates(nodeNumber=still))
        self.joints = {joint["name"]: self.joint(joint) for joint in case.joints}
        self.constraints = [self.drive(drive) for drive in case.drives]
        for transmission in case.data["transmissions"]:
            self.gears(transmission)
        for load in case.loads:
            self.load(load)
        sensor = lambda **of: system.AddSensor(exu.SensorNode(storeInternal=True, **of))
        kinds = (KINDS.Coordinates, KINDS.Coordinates_t, KINDS.Coordinates_tt)
        self.motion = {name: [sensor(nodeNumber=node, outputVariableType=kind) for kind in kinds]
                       for name, node in self.nodes.items()}
        force = lambda number, kind=KINDS.Force: system.AddSensor(
            exu.SensorObject(objectNumber=number, storeInternal=True, outputVariableType=kind))
        slides = {joint["name"] for joint in case.joints if joint["axes"]}
        self.forces = {name: force(number, KINDS.ForceLocal if name in slides else KINDS.Force)
                       for name, number in self.joints.items()}
        self.moments = {name: force(self.joints[name], KINDS.TorqueLocal) for name in slides}
        self.torques = [None if number is None else force(number) for number in self.constraints]
        system.Assemble()

    @staticmethod
    def turned(angle, local):
        c, s = math.cos(angle), math.sin(angle)
        return np.array([c * local[0] - s * local[1], s * local[0] + c * local[1]])

    def place(self, side, axis=None):
        """A point of a link, or a frame with x along an axis of the link."""
        link = self.case.links[side["link"]]
        local = np.array(side["at_m"]) - (0 if side["link"] == "ground" else np.array(link["mass_centre_m"]))
        of = dict(bodyNumber=self.bodies[side["link"]])
        if axis is None:
            return self.system.AddMarker(exu.MarkerBodyPosition(localPosition=[*local, 0], **of))
        (x, y), at = axis, [*local, 0]
        frame = exudyn.HT(rotation=[[x, -y, 0], [y, x, 0], [0, 0, 1]], translation=at)
        return self.system.AddMarker(exu.MarkerBodyRigid(localHT=frame, **of))

    def joint(self, joint):
        sides, axes = (joint["first"], joint["second"]), joint["axes"]
        pair = [self.place(side, axes and axes[k]) for k, side in enumerate(sides)]
        if not axes:
            return self.system.AddObject(exu.RevoluteJoint2D(markerNumbers=pair))
        # The generic joint, unlike the plane one, has a sensor of its moment, and its slide can be prescribed.
        driven = (drive for drive in self.case.drives if drive["joint"] == joint["name"] and drive["motion"]["law"] != "free")
        drive = next(driven, None)
        if not drive:
            return self.system.AddObject(exu.GenericJoint(markerNumbers=pair, constrainedAxes=[0, 1, 0, 0, 0, 1]))
        offset = lambda part, begun: lambda mbs, t, item, given: [begun + law(drive["motion"], t)[part], 0, 0, 0, 0, 0]
        return self.system.AddObject(exu.GenericJoint(
            markerNumbers=pair, constrainedAxes=[1, 1, 0, 0, 0, 1],
            offsetUserFunction=offset(0, drive["start_m"]), offsetUserFunction_t=offset(1, 0.0)))

    def gears(self, transmission):
        """Relative to the carrier, the second link turns `ratio` times as far as the first."""
        (first, second), ratio = transmission["links"], transmission["ratio"]
        factors = {first: ratio, second: -1.0}
        factors[transmission["carrier"]] = factors.get(transmission["carrier"], 0.0) + 1.0 - ratio
        factors.pop("ground", None)
        # An object without mass bundles the coordinates of the links.
        size = 3 * len(factors)
        bundle = self.system.AddObject(exu.ObjectGenericODE2(
            nodeNumbers=[self.nodes[link] for link in factors], massMatrix=np.zeros((size, size))))
        row = np.array([[0.0, 0.0, factor] for factor in factors.values()]).reshape(1, size)
        begun = sum(factor * self.reference[link][2] for link, factor in factors.items())
        self.system.AddObject(exu.CoordinateVectorConstraint(
            markerNumbers=[self.nothing, self.system.AddMarker(exu.MarkerObjectODE2Coordinates(objectNumber=bundle))],
            scalingMarker1=row, offset=[begun]))

    def angle(self, link):
        if link == "ground":
            return self.still
        return self.system.AddMarker(exu.MarkerNodeCoordinate(nodeNumber=self.nodes[link], coordinate=2))

    def drive(self, drive):
        """The constraint of a prescribed angle; None for a motor, and for a slide, which its joint prescribes."""
        pair, motion = [self.still, self.angle(drive["link"])], drive["motion"]
        if "start_m" in drive:
            return None
        if motion["law"] != "free":
            return self.system.AddObject(exu.CoordinateConstraint(
                markerNumbers=pair, offsetUserFunction=lambda mbs, t, item, offset: law(motion, t)[0],
                offsetUserFunction_t=lambda mbs, t, item, offset: law(motion, t)[1]))
        if motion["motor"]:
            constant, damping = self.line(motion)
            self.system.AddLoad(exu.LoadCoordinate(markerNumber=pair[1], load=constant))
            self.system.AddObject(exu.CoordinateSpringDamper(markerNumbers=pair, damping=damping))
        return None

    @staticmethod
    def line(motion):
        """The motor's moment on the crank: a constant minus a damping times the crank's speed."""
        motor = motion["motor"]
        torque, ratio = motor["torque"], motor["ratio"]
        if torque["law"] == "constant":
            return motion["sense"] * ratio * torque["torque_N_m"], 0.0
        return motion["sense"] * ratio * torque["torque_at_rest_N_m"], -ratio**2 * torque["slope_N_m_s"]

    def load(self, load):
        system = self.system
        if load["type"] == "resistance":
            system.AddObject(exu.CoordinateSpringDamperExt(
                markerNumbers=[self.still, self.angle(load["link"])], dynamicFrictionForce=load["moment_N_m"],
                frictionProportionalZone=ZONE))
        elif load["type"] == "force":
            system.AddLoad(exu.Force(markerNumber=self.place(load["at"]), loadVector=[*load["force_N"], 0]))
        elif load["type"] == "moment":
            system.AddLoad(exu.LoadCoordinate(markerNumber=self.angle(load["link"]), load=load["moment_N_m"]))
        elif load["type"].startswith("torsion"):
            # The coordinates are rotations from the start.
            one, two = (self.reference.get(link, np.zeros(3))[2] for link in load["links"])
            system.AddObject(exu.CoordinateSpringDamper(
                markerNumbers=[self.angle(link) for link in load["links"]], stiffness=load.get("stiffness_N_m_rad", 0.0),
                damping=load.get("damping_N_m_s_rad", 0.0), offset=load.get("free_angle_rad", 0.0) - (two - one)))
        else:
            spring = dict(stiffness=load["stiffness_N_m"], referenceLength=load["free_length_m"]) if (
                load["type"] == "spring") else dict(stiffness=0.0, damping=load["damping_N_s_m"], referenceLength=1.0)
            system.AddObject(exu.SpringDamper(markerNumbers=[self.place(end) for end in load["ends"]], **spring))

    def run(self, way, every):
        """Simulates over the grid; returns seconds and steps."""
        end = float(self.case.times[-1])
        asked = exudyn.SimulationSettings()
        own = asked.timeIntegration
        steps = way["parts"] * (len(self.case.times) - 1)
        own.numberOfSteps, own.endTime, own.adaptiveStep = steps, end, False
        own.verboseMode = 0
        asked.solution.file.write, asked.solution.sensors.writePeriod = False, every
        asked.linearSolver.solverType = exudyn.LinearSolverType.EXUdense
        for name, value in SETTINGS[way["name"]].items():
            setattr(own.generalizedAlpha, name, value)
        if "Newmark" in way["name"]:
            own.newton.absoluteTolerance, own.newton.relativeTolerance = 1e-14, 1e-12
        else:
            own.newton.useModifiedNewton = False
        since = time.process_time()
        self.system.SolveDynamic(asked)
        return time.process_time() - since, steps

    def read(self, sensor):
        """Columns of a sensor at the instants."""
        data, times = self.system.GetSensorStoredData(sensor), self.case.times
        rows = np.searchsorted(data[:, 0], times - 1e-3 * times[1])
        if rows.max() >= len(data):
            raise Refused(f"it stopped at {data[-1, 0]:.6g} s")
        return data[rows, 1:]


def solve(request, case, way):
    every = check(case)
    seconds = []
    for _ in range(REPEATS):
        model = Model(case)
        try:
            taken, steps = model.run(way, every)
        except Exception as error:
            raise Refused(f"it did not converge: {str(error).strip().splitlines()[0] if str(error).strip() else error!r}")
        seconds.append(taken)
        if sum(seconds) > 0.5:
            break
    return motion_of(case, model), seconds, {"steps": steps}


def motion_of(case, model):
    """The motion and the forces at the instants of the case, after a run."""
    motion = Motion({}, {}, {}, {}, {}, {})
    for link in case.moving:
        name = link["name"]
        at, speed, rate = (model.read(sensor)[:, :3] for sensor in model.motion[name])
        at = at + model.reference[name]
        motion.angle[name], motion.omega[name], motion.alpha[name] = at[:, 2], speed[:, 2], rate[:, 2]
        c, s = np.cos(at[:, 2]), np.sin(at[:, 2])
        local = link["mass_centre_m"]
        arm = np.stack([c * local[0] - s * local[1], s * local[0] + c * local[1]], axis=-1)
        across = np.stack([-arm[:, 1], arm[:, 0]], axis=-1)
        motion.origin[name] = at[:, :2] - arm
        motion.velocity[name] = speed[:, :2] - across * speed[:, 2:]
        motion.acceleration[name] = rate[:, :2] - across * rate[:, 2:] + arm * speed[:, 2:] ** 2
    if "reactions" in case.stages:
        reactions(case, model, motion)
    return motion


def reactions(case, model, motion):
    """Adds the force of the first link on the second; Exudyn gives that of the second marker on the first."""
    # This model of gears exerts only moments, so the reactions of the axles lack the tooth forces.
    geared = {link for own in case.data["transmissions"] for link in (*own["links"], own["carrier"], "ground")}
    for joint in case.joints:
        name = joint["name"]
        if {joint["first"]["link"], joint["second"]["link"]} <= geared:
            continue
        motion.force[name] = -model.read(model.forces[name])[:, :2]
        if joint["axes"]:
            across = motion.force[name][:, 1]
            angle = motion.angle.get(joint["first"]["link"], 0.0) + math.atan2(*joint["axes"][0][::-1])
            c, s = np.cos(angle), np.sin(angle)
            motion.force[name] = np.stack([-s * across, c * across], axis=-1)
            motion.moment[name] = model.read(model.moments[name])[:, 2]
    motion.torque = [torque(case, model, motion, drive, sensor) for drive, sensor in zip(case.drives, model.torques)]


def torque(case, model, motion, drive, sensor):
    if "start_m" in drive:
        return -model.read(model.forces[drive["joint"]])[:, 0]
    if sensor is not None:
        # The force of the constraint acts on its first marker.
        return -model.read(sensor)[:, 0]
    if not drive["motion"]["motor"]:
        return np.zeros(len(case.times))
    # The moment that the shaft transmits: without the part that accelerates rotor and reducer.
    constant, damping = model.line(drive["motion"])
    inertia = drive["motion"]["motor"]["inertia_on_crank_kg_m2"]
    return constant - damping * motion.omega[drive["link"]] - inertia * motion.alpha[drive["link"]]


if __name__ == "__main__":
    main(ways, solve, f"Exudyn {exudyn.__version__}")
