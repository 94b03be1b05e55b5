#!/usr/bin/env python3
"""Error against time of Rapier, Exudyn and MuJoCo on two run-ups of one four-bar: see README.md beside this file.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install -r benches/peers/requirements.txt
    /tmp/peers/bin/python benches/peers/peers.py

Every engine gives the crank angle and the reaction in B at the scenario's instants. The error is the largest difference
from `linkproof solve --with assur` over these instants, divided by the range of the channel.
Times are the shortest processor times of several runs in one process, without building the model and without writing.
"""

import argparse
import csv
import math
import os
import pathlib
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass

sys.exudynFast = True  # Exudyn's build without range checks
import exudyn
import mujoco
import numpy as np
from exudyn import itemInterface as exu

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SCENARIOS = [ROOT / "scenarios/crank_rocker_runup.toml", HERE / "crank_rocker_bare.toml"]
WANTED = 1e-6
LINKS = ("crank", "coupler", "rocker")
JOINTS = {"O": ("ground", "crank"), "A": ("crank", "coupler"), "B": ("coupler", "rocker"), "C": ("ground", "rocker")}
# The load opposes the rocker's rotation. For the peers, the load is a friction: proportional to the speed below ZONE
# (rad/s), constant above.
# The crank starts at START (rad/s) instead of 0, so that the load has the right sense from the first instant.
ZONE, START = 1e-8, 1e-7
STEPS = (500, 1000, 2000, 4000, 5000, 7000, 10000, 12000, 20000)


def place(point):
    """A point or vector of a scenario file (m)."""
    return np.array([point.get(c + "_m", point.get(c + "_mm", 0) * 1e-3) for c in "xy"], float)


@dataclass
class Case:
    """Data for the engines, and the exact solution."""

    name: str
    links: dict
    ground: dict
    inertia: dict
    torque: float
    damping: float
    load: float
    exact: np.ndarray

    def of(self, link, what):
        return self.exact[f"link{link}{what}"]

    def errors(self, crank, force):
        """Errors of crank angle and reaction as fractions of their ranges, and the instant of the largest reaction error. The reaction may have either sign."""
        exact = np.c_[self.exact["jointBfx_N"], self.exact["jointBfy_N"]]
        if np.abs(exact + force).max() < np.abs(exact - force).max():
            force = -force
        off = (np.abs(force - exact) / np.ptp(exact, axis=0)).max(axis=1)
        angle = self.exact["crank_rad"]
        return np.abs(crank - angle).max() / np.ptp(angle), off.max(), int(off.argmax())


def read(path, linkproof):
    doc = tomllib.loads(path.read_text())
    solved = subprocess.run([*linkproof, "solve", str(path), "--with", "assur"], check=True, capture_output=True, text=True)
    exact = np.genfromtxt(solved.stdout.splitlines(), delimiter=",", names=True)
    links, motor = doc["links"], doc["motor"]
    ratio = motor["ratio"]
    inertia = {name: links[name]["inertia_kg_m2"] for name in LINKS}
    inertia["crank"] += ratio**2 * motor.get("rotor_inertia_kg_m2", 0) + motor.get("output_inertia_kg_m2", 0)
    return Case(doc["name"], links, doc["ground"], inertia, ratio * motor["torque_at_rest_N_m"],
                -(ratio**2) * motor["slope_N_m_s"], doc["loads"][0]["moment_N_m"], exact)


def exudyn_model(case):
    """Plane rigid bodies and revolute joints; motor and load are elements of Exudyn, without Python callbacks."""
    system = exudyn.SystemContainer().AddSystem()
    ground = system.AddObject(exu.ObjectGround())
    bodies, nodes = {"ground": ground}, {}
    share = START / case.of("crank", "alpha_rad_s2")[0]
    for name in LINKS:
        at = [case.of(name, what)[0] for what in ("x_m", "y_m", "angle_rad")]
        speed = [share * case.of(name, what)[0] for what in ("ax_m_s2", "ay_m_s2", "alpha_rad_s2")]
        mass = case.links[name]["mass_kg"]
        nodes[name] = system.AddNode(exu.NodeRigidBody2D(referenceCoordinates=at, initialVelocities=speed))
        bodies[name] = system.AddObject(
            exu.ObjectRigidBody2D(mass=mass, inertia=case.inertia[name], nodeNumber=nodes[name]))
        centre = system.AddMarker(exu.MarkerBodyPosition(bodyNumber=bodies[name]))
        system.AddLoad(exu.Force(markerNumber=centre, loadVector=[0, -9.81 * mass, 0]))

    def marker(link, point):
        of = case.ground if link == "ground" else case.links[link]
        local = place(of["points"][point]) - (0 if link == "ground" else place(of["mass_centre"]))
        return system.AddMarker(exu.MarkerBodyPosition(bodyNumber=bodies[link], localPosition=[*local, 0]))

    joints = {name: system.AddObject(exu.RevoluteJoint2D(markerNumbers=[marker(link, name) for link in pair]))
              for name, pair in JOINTS.items()}
    still = system.AddMarker(exu.MarkerNodeCoordinate(nodeNumber=system.AddNode(exu.NodePointGround()), coordinate=0))
    crank, rocker = (system.AddMarker(exu.MarkerNodeCoordinate(nodeNumber=nodes[name], coordinate=2))
                     for name in ("crank", "rocker"))
    system.AddLoad(exu.LoadCoordinate(markerNumber=crank, load=case.torque))
    system.AddObject(exu.CoordinateSpringDamper(markerNumbers=[still, crank], damping=case.damping))
    system.AddObject(exu.CoordinateSpringDamperExt(
        markerNumbers=[still, rocker], dynamicFrictionForce=case.load, frictionProportionalZone=ZONE))
    kinds = exudyn.OutputVariableType
    angle = system.AddSensor(
        exu.SensorNode(nodeNumber=nodes["crank"], storeInternal=True, outputVariableType=kinds.Coordinates))
    force = system.AddSensor(
        exu.SensorObject(objectNumber=joints["B"], storeInternal=True, outputVariableType=kinds.Force))
    system.Assemble()
    return system, angle, force


EXUDYN = {
    "alpha, radius 0.8, full Newton": dict(spectralRadius=0.8),
    "alpha, radius 0.5, full Newton": dict(spectralRadius=0.5),
    "Newmark, index 2, tolerance 1e-14": dict(useNewmark=True, useIndex2Constraints=True),
}


def run_exudyn(case, settings, steps):
    system, angle, force = exudyn_model(case)
    end, every = case.exact["t_s"][-1], case.exact["t_s"][1]
    asked = exudyn.SimulationSettings()
    way = asked.timeIntegration
    way.numberOfSteps, way.endTime, way.adaptiveStep = steps, end, False
    asked.solution.file.write, asked.solution.sensors.writePeriod = False, every
    asked.linearSolver.solverType = exudyn.LinearSolverType.EXUdense
    for name, value in EXUDYN[settings].items():
        setattr(way.generalizedAlpha, name, value)
    if "tolerance" in settings:
        way.newton.absoluteTolerance, way.newton.relativeTolerance = 1e-14, 1e-12
    else:
        way.newton.useModifiedNewton = False
    since = time.process_time()
    system.SolveDynamic(asked)
    seconds = time.process_time() - since
    angles, forces = system.GetSensorStoredData(angle), system.GetSensorStoredData(force)
    rows = np.searchsorted(angles[:, 0], case.exact["t_s"] - 1e-3 * every)
    return seconds, angles[rows, 3], forces[rows, 1:3]


def mujoco_model(case, integrator, step, softness):
    """Two trees: crank with coupler, and rocker. Joint B closes the loop as a `connect`."""
    angle = {name: float(case.of(name, "angle_rad")[0]) for name in LINKS}
    text = lambda values: " ".join(repr(float(value)) for value in values)
    local = lambda link, point: text([*place(case.links[link]["points"][point]), 0])
    ground = lambda point: text([*place(case.ground["points"][point]), 0])
    mass = lambda name: (f'<inertial pos="{text([*place(case.links[name]["mass_centre"]), 0])}" '
                         f'mass="{case.links[name]["mass_kg"]}" diaginertia="{text([case.links[name]["inertia_kg_m2"]] * 3)}"/>')
    rotor = case.inertia["crank"] - case.links["crank"]["inertia_kg_m2"]
    # With a single equality constraint the problem is quadratic, so one iteration of Newton's method solves it.
    # 0.9999 is the hardest impedance that MuJoCo accepts.
    return mujoco.MjModel.from_xml_string(f"""<mujoco><compiler angle="radian"/>
<option timestep="{step!r}" gravity="0 -9.81 0" integrator="{integrator}" solver="Newton" iterations="1" tolerance="0"
 jacobian="dense"><flag contact="disable" refsafe="disable" warmstart="disable" sensor="disable" island="disable"/></option>
<worldbody><body pos="{ground("O")}" euler="0 0 {angle["crank"]!r}">
<joint name="O" axis="0 0 1" ref="{angle["crank"]!r}" armature="{rotor!r}"/>{mass("crank")}
<body pos="{local("crank", "A")}" euler="0 0 {angle["coupler"] - angle["crank"]!r}"><joint axis="0 0 1"/>{mass("coupler")}
<site name="B2" pos="{local("coupler", "B")}"/></body></body>
<body pos="{ground("C")}" euler="0 0 {angle["rocker"]!r}"><joint name="C" axis="0 0 1"/>{mass("rocker")}
<site name="B3" pos="{local("rocker", "B")}"/></body></worldbody>
<equality><connect site1="B2" site2="B3" solref="{softness * step!r} 1" solimp="0.9999 0.9999 0.001 0.5 2"/></equality>
<actuator><general joint="O" biastype="affine" gainprm="0" biasprm="{case.torque!r} 0 {-case.damping!r}"/>
<general joint="C" biastype="affine" gainprm="0" biasprm="0 0 {-case.load / ZONE!r}" forcelimited="true"
 forcerange="{-case.load} {case.load}"/></actuator></mujoco>""")


MUJOCO = {f"{integrator}, solref {softness} steps": (integrator, softness)
          for integrator in ("RK4", "implicitfast") for softness in (3, 4, 6)}


def run_mujoco(case, settings, steps):
    times = case.exact["t_s"]
    integrator, softness = MUJOCO[settings]
    model = mujoco_model(case, integrator, float(times[-1] / steps), softness)
    data = mujoco.MjData(model)
    speeds = [START / case.of("crank", "alpha_rad_s2")[0] * case.of(name, "alpha_rad_s2")[0] for name in LINKS]
    data.qvel[:] = [speeds[0], speeds[1] - speeds[0], speeds[2]]
    crank, force, every = np.empty(len(times)), np.empty((len(times), 2)), steps // (len(times) - 1)
    since = time.process_time()
    for row in range(len(times)):
        if row:
            mujoco.mj_step(model, data, every)
        # Forces belong to the state before the last step, so they are computed again.
        mujoco.mj_forward(model, data)
        crank[row], force[row] = data.qpos[0], data.efc_force[:2]
    return time.process_time() - since, crank, force


def measure(case, engine, settings, run, repeats):
    """One row for each number of steps."""
    for steps in STEPS:
        seconds = math.inf
        for _ in range(repeats):
            taken, crank, force = run(case, settings, steps)
            seconds = min(seconds, taken)
        angle, reaction, row = case.errors(crank, force)
        yield dict(scenario=case.name, engine=engine, settings=settings, step_s=case.exact["t_s"][-1] / steps, runs=1,
                   steps=steps, crank=angle, reaction=reaction, worst_row=row, ms=seconds * 1e3)


def rapier(repeats):
    """Rows of Rapier, measured by `cargo bench --bench peers_rapier`."""
    command = ["cargo", "bench", "--quiet", "--bench", "peers_rapier", "--", str(repeats), *map(str, SCENARIOS)]
    found = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    for row in csv.DictReader(found.stdout.splitlines()):
        told = dict(scenario=row["scenario"], engine="rapier", settings=f"{row['sweeps']} sweeps")
        numbers = {name: int(row[name]) for name in ("runs", "steps", "worst_row")}
        reals = {name: float(row[name]) for name in ("step_s", "crank", "reaction", "ms")}
        yield {**told, "step_s": reals["step_s"], "runs": numbers["runs"], "steps": numbers["steps"],
               "crank": reals["crank"], "reaction": reals["reaction"], "worst_row": numbers["worst_row"],
               "ms": reals["ms"]}


def front(rows):
    """The Pareto front of time and error of the reaction."""
    best = math.inf
    for row in sorted(rows, key=lambda row: row["ms"]):
        if row["reaction"] < best:
            best = row["reaction"]
            yield row


def show(rows):
    for scenario in dict.fromkeys(row["scenario"] for row in rows):
        print(f"\n{scenario}: settings that no other setting of the same engine surpasses in both time and error of the reaction")
        print(f"{'engine':8} {'settings':36} {'step s':>9} {'runs':>4} {'steps':>6} {'crank':>8} {'reaction B':>10} {'row':>4} {'ms':>8}")
        reached = {}
        for engine in ("rapier", "exudyn", "mujoco"):
            own = [row for row in rows if (row["scenario"], row["engine"]) == (scenario, engine)]
            for row in front(own):
                print(f"{engine:8} {row['settings']:36} {row['step_s']:9.2g} {row['runs']:4} {row['steps']:6} "
                      f"{row['crank']:8.1e} {row['reaction']:10.1e} {row['worst_row']:4} {row['ms']:8.1f}")
            enough = [row["ms"] for row in own if row["reaction"] <= WANTED]
            reached[engine] = min(enough, default=None)
        told = [f"{engine} {'never' if ms is None else f'{ms:.1f} ms'}" for engine, ms in reached.items()]
        print(f"time for an error of the reaction of at most {WANTED:g} of its range: " + ", ".join(told))


def main():
    asked = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    asked.add_argument("--csv", type=pathlib.Path, default="peers.csv", help="file for all rows [peers.csv]")
    asked.add_argument("--repeats", type=int, default=3, help="timings, of which the shortest counts [3]")
    asked = asked.parse_args()
    os.environ["CARGO_TERM_QUIET"] = "true"
    linkproof = ["cargo", "run", "--release", "--quiet", "--manifest-path", str(ROOT / "Cargo.toml"), "--"]
    rows = []
    for path in SCENARIOS:
        case = read(path, linkproof)
        for settings in EXUDYN:
            rows += measure(case, "exudyn", settings, run_exudyn, asked.repeats)
        for settings in MUJOCO:
            rows += measure(case, "mujoco", settings, run_mujoco, asked.repeats)
    rows += rapier(asked.repeats)
    with asked.csv.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    show(rows)


if __name__ == "__main__":
    main()
