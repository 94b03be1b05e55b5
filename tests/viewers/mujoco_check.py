"""Exports scenarios to MJCF, simulates them in MuJoCo and compares with the analytic solution.

usage: mujoco_check.py LINKPROOF [--singular] SCENARIO...

Each is simulated over one turn of its crank (or to the end of its grid) at four time steps, each half of the one before. A channel passes if
the two finest runs differ from each other as much as its order says, and from the analytic solution by no more than they differ from each
other: MuJoCo's own error, estimated without the solution it is compared with. Then the same model is falsified a little: that must be found.

--singular: for mechanisms that come near a singular pose, where accelerations peak and steps as large as these are not in the range of any order yet.
Their errors are judged by MuJoCo's own, but nothing is promised of their size, and a mass has to be farther off to be found.
"""

import contextlib
import csv
import io
import math
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import mujoco
import numpy as np

# Steps in the interval; and instants that are compared, which all of them hit.
STEPS = (720, 1440, 2880, 5760)
ROWS = 36
# Orders: positions are of second order, forces of first (MuJoCo's velocities belong to the middle of the step before, and enter inertia
# forces as if they did not); forces extrapolated from two runs are of second order.
POSITION, FORCE = 2, 1
# An observed order of positions must be the formal one within this.
ORDER = 0.1
# Safety factors on the estimated error: 1.25 where the order is as it should be, 3 for forces, whose order is not watched. Both after Roache.
CLEAR, DOUBTFUL = 1.25, 3.0
# Errors, over half the range, that are none of the step's: the rotor that drives is held to 1e-9 of its speed and turns by 2 pi, and forces
# carry the rounding of a constraint problem with inertias twelve orders apart.
REST = {POSITION: 2e-8, FORCE: 1e-6}
# What is promised of the finest run, over half the range of the channel.
PROMISED = {"positions": 1e-5, "forces": 1e-2, "positions extrapolated": 1e-6, "forces extrapolated": 1e-3}
# Half the range counts for at least this share of the largest of its unit: a coordinate that hardly changes takes its errors from its neighbours.
LEAST = 0.1
# Falsifications: a place on a link by this share of the mechanism's size, and the heaviest link's mass by this share of it.
WRONG_LENGTH, WRONG_MASS = 1e-4, 1e-3

results = []
warnings = []
# Else MuJoCo writes them to a file beside whoever calls.
mujoco.set_mju_user_warning(warnings.append)


def check(what, passed, found=""):
    """Prints and counts one check."""
    results.append(bool(passed))
    print(f"  {'ok    ' if passed else 'FAILED'} {what}{f': {found}' if found else ''}")


def told(*command):
    """What a command writes to standard output."""
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def columns(table):
    """Columns of a CSV table as arrays by name."""
    rows = list(csv.DictReader(io.StringIO(table)))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


class Scenario:
    """A scenario, its analytic solution and its model."""

    def __init__(self, linkproof, path):
        self.toml = tomllib.loads(Path(path).read_text())
        self.name = self.toml["name"]
        drive = self.toml["drive"]
        self.drives = [table["joint"] for table in (drive if isinstance(drive, list) else [drive])]
        self.points = {p for link in self.toml["links"].values() for p in link["points"]} - set(self.toml["ground"]["points"])
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory) / f"{self.name}.xml"
            told(linkproof, "export", path, "--mjcf", str(file))
            self.text = file.read_text()
            self.model = mujoco.MjModel.from_xml_path(str(file))
        joint = self.model.joint(self.drives[0])
        self.speed = float(self.model.key("start").qvel[joint.dofadr[0]])
        turn = 2.0 * math.pi / abs(self.speed)
        last = columns(told(linkproof, "solve", path, "--with", "assur"))["t_s"].max()
        self.interval = min(turn, float(last))
        times = f"0:{self.interval!r}:{self.interval / ROWS!r}"
        self.solution = columns(told(linkproof, "solve", path, "--with", "assur", "--times", times))

    def drift(self, model, solution):
        """Largest angle (rad) by which its torque may turn the rotor that drives."""
        armature = model.dof_armature[model.joint(self.drives[0]).dofadr[0]]
        return float(np.abs(solution["drive.torque_N_m"]).max()) * self.interval**2 / (2.0 * armature)

    def size(self):
        """Extent of the mechanism (m)."""
        return float(self.model.stat.extent)


def loads_beyond(scenario, model, data, name):
    """Force (N) and moment (N m) about the joint's place, in world axes, of loads on the body that a joint of the tree carries and on those farther out.

    Sensors work backwards from motion, forces in loops and gravity: they know of no other load. An actuator on a joint turns the two bodies of
    this joint against each other: no other joint of the tree carries it. A transmission does the same with all its joints.
    """
    force, moment = np.zeros(2), 0.0
    joint = model.joint(name)
    carried, place = joint.bodyid[0], data.xanchor[joint.id][:2]
    for number, load in enumerate(scenario.toml.get("loads", []), start=1):
        if load["type"] in ("resistance", "force"):
            body = model.body(load["link"]).id
            while body not in (0, carried):
                body = model.body_parentid[body]
            if body != carried:
                continue
            if load["type"] == "resistance":
                moment -= math.copysign(load["moment_N_m"], data.body(load["link"]).cvel[2])
            else:
                actuator = model.actuator(f"load.{number}")
                at, axes = actuator.trnid
                axes = at if axes < 0 else axes
                own = float(data.actuator(actuator.id).force[0]) * data.site_xmat[axes].reshape(3, 3)[:2, :2] @ actuator.gear[:2]
                arm = data.site_xpos[at][:2] - place
                force += own
                moment += arm[0] * own[1] - arm[1] * own[0]
        elif load["type"] == "moment" or load["type"].startswith("torsion_"):
            if model.actuator(f"load.{number}").trnid[0] == joint.id:
                moment += float(data.actuator(f"load.{number}").force[0])
        else:
            sys.exit(f"{scenario.name}: this check does not know a load of type \"{load['type']}\" yet: add it to loads_beyond")
    rows = data.efc_type[: data.nefc] == mujoco.mjtConstraint.mjCNSTR_EQUALITY
    rows &= model.eq_type[data.efc_id[: data.nefc] * rows] == mujoco.mjtEq.mjEQ_TENDON
    if rows.any():
        moment += float(data.efc_J.reshape(data.nefc, -1)[rows, joint.dofadr[0]] @ data.efc_force[: data.nefc][rows])
    return force, moment


def moment_of(scenario, model, data, name):
    """Moment on the body that a joint of the tree carries, about the joint's place on it, in world axes."""
    return data.sensor(f"{name}.moment").data[2] - loads_beyond(scenario, model, data, name)[1]


def reaction(scenario, model, data, name):
    """Force and moment of a joint's first link on its second, about its place there, in world axes."""
    sensor = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SENSOR, f"{name}.force")
    if sensor < 0:
        # A loop: rows of its connect. They pull the first site to the second.
        loop = model.equality(name).id
        rows = (data.efc_id[: data.nefc] == loop) & (data.efc_type[: data.nefc] == mujoco.mjtConstraint.mjCNSTR_EQUALITY)
        return -data.efc_force[: data.nefc][rows][:2], None
    site = model.sensor_objid[sensor]
    # Sensors read what acts on the body that is carried.
    sense = 1.0 if model.site(site).name == f"{name}.second" else -1.0
    force = (data.site_xmat[site].reshape(3, 3) @ data.sensor(f"{name}.force").data)[:2]
    force = (force - loads_beyond(scenario, model, data, name)[0]) * sense
    moment = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SENSOR, f"{name}.moment")
    return force, None if moment < 0 else moment_of(scenario, model, data, name) * sense


def sample(scenario, model, data):
    """All channels of the present state, by the names of the analytic solution."""
    found = {}
    for link in scenario.toml["links"]:
        turn = data.body(link).xmat
        found[f"link.{link}.angle_rad"] = math.atan2(turn[3], turn[0])
    for point in scenario.points:
        found[f"point.{point}.x_m"], found[f"point.{point}.y_m"], _ = data.site(point).xpos
    for table in scenario.toml["joints"]:
        name = table["name"]
        force, moment = reaction(scenario, model, data, name)
        # MuJoCo couples joints by moments alone: its axles carry no tooth and strand forces.
        if "transmissions" not in scenario.toml:
            found[f"joint.{name}.fx_N"], found[f"joint.{name}.fy_N"] = force
        if table["type"] == "prismatic" and moment is not None:
            found[f"joint.{name}.slide_m"] = data.joint(name).qpos[0]
            # The sensor's moment is about the joint's place on the body that is carried; the channel's about that on the second.
            if model.site(f"{name}.second").bodyid[0] != model.jnt_bodyid[model.joint(name).id]:
                first, second = (data.site(f"{name}.{side}").xpos for side in ("first", "second"))
                moment += np.cross(first - second, [*force, 0.0])[2]
            found[f"joint.{name}.moment_N_m"] = moment
    for index, name in enumerate(scenario.drives):
        channel = "drive.torque_N_m" if index == 0 else f"drive.{name}.torque_N_m"
        # What drives the link, whichever link the joint names first.
        found[channel] = moment_of(scenario, model, data, name)
    return found


def simulate(scenario, model, steps):
    """Columns of all channels at the instants that are compared, and the crank's way."""
    model.opt.timestep = scenario.interval / steps
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    rows = []
    for step in range(steps + 1):
        if step % (steps // ROWS) == 0:
            mujoco.mj_forward(model, data)
            rows.append(sample(scenario, model, data))
        mujoco.mj_step(model, data)
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def order_of(channel):
    """Formal order of a channel."""
    return FORCE if channel.endswith(("_N", "_N_m")) else POSITION


def gap(channel, a, b):
    """Differences of two columns; of angles the shorter way round."""
    if channel.endswith("angle_rad"):
        return (a - b + math.pi) % (2.0 * math.pi) - math.pi
    return a - b


def distance(channel, a, b, first):
    """Largest difference of two columns from the row `first` on."""
    return float(np.abs(gap(channel, a, b)[first:]).max())


def scales(solution, channels):
    """Half the range of every channel, but at least the least share of the largest of its unit."""
    half = {channel: float(np.ptp(solution[channel])) / 2.0 for channel in channels}
    unit = lambda channel: channel.rsplit("_", 1)[1] if not channel.endswith("_N_m") else "N_m"
    largest = {}
    for channel in channels:
        largest[unit(channel)] = max(largest.get(unit(channel), 0.0), half[channel])
    # A mechanism whose links do not turn or slide at all has angles of zero, right to the rest that is allowed.
    return {channel: max(half[channel], LEAST * largest[unit(channel)]) or 1.0 for channel in channels}


class Judgement:
    """Errors of one model against the solution and against its own, over the scales."""

    def __init__(self, scenario, model):
        self.runs = [simulate(scenario, model, steps) for steps in STEPS]
        solution = scenario.solution
        self.channels = list(self.runs[0])
        scale = scales(solution, self.channels)
        self.errors = {c: [] for c in self.channels}
        self.orders, self.estimates, self.extrapolated, self.within = {}, {}, {}, {}
        for channel in self.channels:
            # The first steps of forces carry a transient: the keyframe's velocities belong to its instant, not half a step before.
            first = 1 if order_of(channel) == FORCE else 0
            apart = lambda a, b: distance(channel, a, b, first) / scale[channel]
            runs = [run[channel] for run in self.runs]
            self.errors[channel] = [apart(run, solution[channel]) for run in runs]
            rest = REST[order_of(channel)] + (scenario.drift(model, solution) if order_of(channel) == POSITION else 0.0)
            if order_of(channel) == POSITION:
                coarse, fine = apart(runs[1], runs[2]), apart(runs[2], runs[3])
                # Below the rest there is no order to be seen.
                self.orders[channel] = math.log2(coarse / fine) if fine > 10.0 * rest else None
                self.estimates[channel] = CLEAR * fine / 3.0 + rest
                self.within[channel] = self.errors[channel][-1] <= self.estimates[channel]
                coarse, fine = (gap(channel, run, solution[channel]) for run in runs[2:])
                self.extrapolated[channel] = float(np.abs((4.0 * fine - coarse) / 3.0).max()) / scale[channel]
            else:
                wise = [2.0 * b - a for a, b in zip(runs, runs[1:])]
                self.extrapolated[channel] = apart(wise[-1], solution[channel])
                self.estimates[channel] = DOUBTFUL * apart(wise[-1], wise[-2]) / 3.0 + rest
                self.within[channel] = self.extrapolated[channel] <= self.estimates[channel]

    def of(self, order):
        """Channels of an order."""
        return [channel for channel in self.channels if order_of(channel) == order]

    def beyond(self, order):
        """Channels of an order that are off by more than MuJoCo's own error."""
        return [channel for channel in self.of(order) if not self.within[channel]]

    def worst(self, order, run=-1):
        """Largest error of an order's channels in a run, and where."""
        return max((self.errors[channel][run], channel) for channel in self.of(order))


def falsified(scenario, change):
    """What becomes of a model with a small fault."""
    with tempfile.TemporaryDirectory() as directory:
        file = Path(directory) / "model.mjb"
        mujoco.mj_saveModel(scenario.model, str(file), None)
        model = mujoco.MjModel.from_binary_path(str(file))
    change(model)
    return Judgement(scenario, model)


def check_file(scenario):
    """The file as it is loaded: start pose, speeds, view."""
    model, data = scenario.model, mujoco.MjData(scenario.model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco.mj_forward(model, data)
    gap = np.abs(data.efc_pos[: data.ne]).max(initial=0.0) / scenario.size()
    slip = np.abs(data.efc_vel[: data.ne]).max(initial=0.0) / (abs(scenario.speed) * scenario.size())
    check("loops are closed in the keyframe, and stay so at its speeds", gap < 1e-14 and slip < 1e-12, f"{gap:.1e}, {slip:.1e}")
    check("the start pose is the one that is shown before a keyframe is loaded", np.array_equal(model.qpos0, model.key("start").qpos))
    scene, camera, options = mujoco.MjvScene(model, 1000), mujoco.MjvCamera(), mujoco.MjvOption()
    mujoco.mjv_defaultFreeCamera(model, camera)
    mujoco.mjv_updateScene(model, data, options, None, camera, mujoco.mjtCatBit.mjCAT_ALL, scene)
    eye = scene.camera[0]
    check("the viewer looks from above, y up", np.allclose(eye.forward, [0, 0, -1], atol=1e-6) and np.allclose(eye.up, [0, 1, 0], atol=1e-6))
    drawn = {scenario.model.geom_bodyid[g.objid] for g in scene.geoms[: scene.ngeom] if g.objtype == mujoco.mjtObj.mjOBJ_GEOM}
    check("every link is drawn, and nothing touches", set(range(1, model.nbody)) <= drawn and data.ncon == 0, f"{len(drawn)} bodies")


def check_scenario(linkproof, path, singular):
    """All checks of one scenario."""
    print(path)
    del warnings[:]
    scenario = Scenario(linkproof, path)
    check_file(scenario)
    judgement = Judgement(scenario, scenario.model)
    check("MuJoCo warns of nothing", not warnings, "; ".join(warnings[:3]))
    if not singular:
        check_promises(judgement)
    for order, what in ((POSITION, "positions"), (FORCE, "forces extrapolated")):
        beyond = [f"{c} beyond {judgement.estimates[c]:.1e}" for c in judgement.beyond(order)]
        check(f"{what} are off by no more than MuJoCo's own error", not beyond, ", ".join(beyond) or f"{len(judgement.of(order))} channels")

    def longer(model):
        """Moves the place where a loop closes, along both axes: a slider does not feel one of them. Without a loop, moves the last body."""
        loops = model.eq_obj1id[model.eq_type == mujoco.mjtEq.mjEQ_CONNECT]
        if not loops.size:
            model.body_pos[-1][:2] += WRONG_LENGTH * scenario.size()
            return
        site = loops[0]
        model.site_pos[site][:2] += WRONG_LENGTH * scenario.size()
        # Else MuJoCo takes a short cut past the place of a site at its body's origin.
        model.site_sameframe[site] = mujoco.mjtSameFrame.mjSAMEFRAME_NONE

    def heavier(model):
        """Changes the heaviest mass; beside transmissions, where reactions are not compared, the loads too."""
        model.body_mass[int(model.body_mass.argmax())] *= 1.0 + WRONG_MASS
        if "transmissions" in scenario.toml:
            model.actuator_biasprm[:, 0] *= 1.0 + WRONG_MASS

    caught = falsified(scenario, longer).beyond(POSITION)
    check(f"a length off by {WRONG_LENGTH:g} of the size is found", caught, f"{len(caught)} channels")
    if not singular:
        caught = falsified(scenario, heavier).beyond(FORCE)
        check(f"a mass or load off by {WRONG_MASS:g} is found", caught, f"{len(caught)} channels")


def told_of(linkproof, singular, path):
    """What the checks of a scenario print, and their results: for a process of its own."""
    del results[:]
    with contextlib.redirect_stdout(io.StringIO()) as text:
        check_scenario(linkproof, path, singular)
    return text.getvalue(), list(results)


def check_promises(judgement):
    """Size and order of errors."""
    for order, what in ((POSITION, "positions"), (FORCE, "forces")):
        row = " ".join(f"{judgement.worst(order, run)[0]:.1e}" for run in range(len(STEPS)))
        error, channel = judgement.worst(order)
        check(f"{what} are as good as promised", error <= PROMISED[what], f"{row}, worst in {channel}")
    orders = {c: order for c, order in judgement.orders.items() if order is not None}
    off = [f"{channel} {order:.2f}" for channel, order in orders.items() if not abs(order - POSITION) <= ORDER]
    if orders:
        check("positions are of second order", not off, ", ".join(off) or f"{min(orders.values()):.3f} to {max(orders.values()):.3f}")
    else:
        # Wheels in a tree whose crank has a constant speed.
        check("positions are too exact for an order", judgement.worst(POSITION)[0] <= PROMISED["positions extrapolated"], f"{judgement.worst(POSITION)[0]:.1e}")
    for order, what in ((POSITION, "positions extrapolated"), (FORCE, "forces extrapolated")):
        error, channel = max((judgement.extrapolated[channel], channel) for channel in judgement.of(order))
        check(f"{what} are as good as promised", error <= PROMISED[what], f"{error:.1e}, worst in {channel}")


def main(arguments):
    """Checks all scenarios; the exit code tells whether all passed."""
    singular = "--singular" in arguments
    linkproof, *paths = [argument for argument in arguments if argument != "--singular"] or [None]
    if not paths:
        sys.exit(__doc__)
    print(f"MuJoCo {mujoco.__version__}")
    with ProcessPoolExecutor() as processes:
        for text, found in processes.map(partial(told_of, linkproof, singular), paths):
            print(text, end="", flush=True)
            results.extend(found)
    failed = results.count(False)
    print(f"{results.count(True)} passed, {failed} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
