"""Exports scenarios to MJCF, simulates them in MuJoCo and compares with the analytic solution.

usage: mujoco_check.py LINKPROOF [--singular] SCENARIO...

Each scenario is simulated over one turn of its crank, or to the end of its grid, at four time steps that are successively halved.
Positions must converge with order 2, and the error of every channel against the analytic solution must be within MuJoCo's error.
MuJoCo's error is estimated from the differences of its runs, without the analytic solution. Small faults planted in the model must be found.

--singular: for mechanisms near a singular pose, where accelerations peak and these steps are too large to show an order of convergence.
Errors are then compared only with MuJoCo's error, not with fixed limits, and no fault in a mass is planted.
"""

import contextlib
import csv
import io
import json
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

# Numbers of steps in the interval, and number of compared instants, which lie on steps of every run.
STEPS = (720, 1440, 2880, 5760)
ROWS = 36
# Formal orders: positions have order 2. Forces have order 1, because their inertia parts use velocities from half a step before.
# Forces extrapolated from two runs have order 2.
POSITION, FORCE = 2, 1
# Largest difference of the observed order of positions from the formal order.
ORDER = 0.1
# Safety factors on the estimated error (Roache): 1.25 if the observed order is checked, 3 for forces, whose order is not checked.
CLEAR, DOUBTFUL = 1.25, 3.0
# Errors that do not depend on the step, as fractions of half the range. For positions: the relative change of the rotor's speed over an angle of
# 2 pi is up to 1e-9. For forces: the rounding error of a constraint problem with inertias twelve decades apart.
REST = {POSITION: 2e-8, FORCE: 1e-6}
# Limits of the errors of the finest run, as fractions of half the range of the channel.
PROMISED = {"positions": 1e-5, "forces": 1e-2, "positions extrapolated": 1e-6, "forces extrapolated": 1e-3}
# The half range of a channel counts as at least this fraction of the largest half range with the same unit: a coordinate that hardly changes
# has the errors of its neighbours.
LEAST = 0.1
# Planted faults: a point of a link is displaced by this fraction of the mechanism's size; the heaviest mass is increased by this fraction.
WRONG_LENGTH, WRONG_MASS = 1e-4, 1e-3

results = []
warnings = []
# Without this handler, MuJoCo writes warnings to a file in the working directory.
mujoco.set_mju_user_warning(warnings.append)


def check(what, passed, found=""):
    """Prints and counts one check."""
    results.append(bool(passed))
    print(f"  {'ok    ' if passed else 'FAILED'} {what}{f': {found}' if found else ''}")


def told(*command):
    """Standard output of a command."""
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
        # The loads come from the export, in SI units, because a number in the file may be a formula.
        self.loads = json.loads(told(linkproof, "export", path, "-o", "-.json"))["loads"]
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
        """Largest angle (rad) by which the driving torque may displace the rotor."""
        armature = model.dof_armature[model.joint(self.drives[0]).dofadr[0]]
        return float(np.abs(solution["drive.torque_N_m"]).max()) * self.interval**2 / (2.0 * armature)

    def size(self):
        """Extent of the mechanism (m)."""
        return float(self.model.stat.extent)


def loads_beyond(scenario, model, data, name):
    """Force (N) and moment (N m) about the joint's point, in world axes, of loads on the body that a joint of the tree carries and on bodies beyond it.

    Sensors compute backwards from motion, loop forces and gravity, and ignore other loads. The moment of an actuator on a joint acts between the
    two bodies of this joint, so no other joint of the tree transmits it. The moments of a transmission act in the same way in its joints.
    """
    force, moment = np.zeros(2), 0.0
    joint = model.joint(name)
    carried, place = joint.bodyid[0], data.xanchor[joint.id][:2]
    for number, load in enumerate(scenario.loads, start=1):
        if load["type"] in ("resistance", "force"):
            link = load["link"] if load["type"] == "resistance" else load["at"]["link"]
            body = model.body(link).id
            while body not in (0, carried):
                body = model.body_parentid[body]
            if body != carried:
                continue
            if load["type"] == "resistance":
                moment -= math.copysign(load["moment_N_m"], data.body(link).cvel[2])
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
    """Moment on the body that a joint of the tree carries, about the joint's point on this body, in world axes."""
    return data.sensor(f"{name}.moment").data[2] - loads_beyond(scenario, model, data, name)[1]


def reaction(scenario, model, data, name):
    """Force and moment of a joint's first link on its second, about the joint's point on the second, in world axes."""
    sensor = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SENSOR, f"{name}.force")
    if sensor < 0:
        # This joint closes a loop; the rows of its `connect` are the force on the first of its two sites.
        loop = model.equality(name).id
        rows = (data.efc_id[: data.nefc] == loop) & (data.efc_type[: data.nefc] == mujoco.mjtConstraint.mjCNSTR_EQUALITY)
        return -data.efc_force[: data.nefc][rows][:2], None
    site = model.sensor_objid[sensor]
    # Sensors give the force on the carried body.
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
        # MuJoCo couples joints by moments alone, so its axles carry no tooth or strand forces.
        if "transmissions" not in scenario.toml:
            found[f"joint.{name}.fx_N"], found[f"joint.{name}.fy_N"] = force
        if table["type"] == "prismatic" and moment is not None:
            found[f"joint.{name}.slide_m"] = data.joint(name).qpos[0]
            # The sensor's moment is about the joint's point on the carried body. The channel's moment is about the joint's point on the second link.
            if model.site(f"{name}.second").bodyid[0] != model.jnt_bodyid[model.joint(name).id]:
                first, second = (data.site(f"{name}.{side}").xpos for side in ("first", "second"))
                moment += np.cross(first - second, [*force, 0.0])[2]
            found[f"joint.{name}.moment_N_m"] = moment
    for index, name in enumerate(scenario.drives):
        channel = "drive.torque_N_m" if index == 0 else f"drive.{name}.torque_N_m"
        # The moment on the driven link, whichever link the joint names first.
        found[channel] = moment_of(scenario, model, data, name)
    return found


def simulate(scenario, model, steps):
    """Columns of all channels at the compared instants."""
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
    """Differences of two columns; for angles within half a turn."""
    if channel.endswith("angle_rad"):
        return (a - b + math.pi) % (2.0 * math.pi) - math.pi
    return a - b


def distance(channel, a, b, first):
    """Largest difference of two columns from the row `first` on."""
    return float(np.abs(gap(channel, a, b)[first:]).max())


def scales(solution, channels):
    """Half the range of every channel, but at least `LEAST` times the largest half range with the same unit."""
    half = {channel: float(np.ptp(solution[channel])) / 2.0 for channel in channels}
    unit = lambda channel: channel.rsplit("_", 1)[1] if not channel.endswith("_N_m") else "N_m"
    largest = {}
    for channel in channels:
        largest[unit(channel)] = max(largest.get(unit(channel), 0.0), half[channel])
    # If no channel of a unit varies, the scale is 1.
    return {channel: max(half[channel], LEAST * largest[unit(channel)]) or 1.0 for channel in channels}


class Judgement:
    """Errors of one model against the analytic solution, and MuJoCo's error estimated from its runs, divided by the scales."""

    def __init__(self, scenario, model):
        self.runs = [simulate(scenario, model, steps) for steps in STEPS]
        solution = scenario.solution
        self.channels = list(self.runs[0])
        scale = scales(solution, self.channels)
        self.errors = {c: [] for c in self.channels}
        self.orders, self.estimates, self.extrapolated, self.within = {}, {}, {}, {}
        for channel in self.channels:
            # Forces have a transient at the start: the keyframe's velocities belong to its instant, not to half a step before it.
            first = 1 if order_of(channel) == FORCE else 0
            apart = lambda a, b: distance(channel, a, b, first) / scale[channel]
            runs = [run[channel] for run in self.runs]
            self.errors[channel] = [apart(run, solution[channel]) for run in runs]
            rest = REST[order_of(channel)] + (scenario.drift(model, solution) if order_of(channel) == POSITION else 0.0)
            if order_of(channel) == POSITION:
                coarse, fine = apart(runs[1], runs[2]), apart(runs[2], runs[3])
                # Errors near `rest` show no order.
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
        """Channels of an order whose error exceeds MuJoCo's estimated error."""
        return [channel for channel in self.of(order) if not self.within[channel]]

    def worst(self, order, run=-1):
        """Largest error of an order's channels in a run, and where."""
        return max((self.errors[channel][run], channel) for channel in self.of(order))


def falsified(scenario, change):
    """Judgement of a copy of the model after `change` has planted a fault in it."""
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
    check("loops are closed in the keyframe, and its speeds keep them closed", gap < 1e-14 and slip < 1e-12, f"{gap:.1e}, {slip:.1e}")
    check("the pose before a keyframe is loaded is the start pose", np.array_equal(model.qpos0, model.key("start").qpos))
    scene, camera, options = mujoco.MjvScene(model, 1000), mujoco.MjvCamera(), mujoco.MjvOption()
    mujoco.mjv_defaultFreeCamera(model, camera)
    mujoco.mjv_updateScene(model, data, options, None, camera, mujoco.mjtCatBit.mjCAT_ALL, scene)
    eye = scene.camera[0]
    check("the viewer looks from above, y up", np.allclose(eye.forward, [0, 0, -1], atol=1e-6) and np.allclose(eye.up, [0, 1, 0], atol=1e-6))
    drawn = {scenario.model.geom_bodyid[g.objid] for g in scene.geoms[: scene.ngeom] if g.objtype == mujoco.mjtObj.mjOBJ_GEOM}
    check("every link is drawn, and no bodies touch", set(range(1, model.nbody)) <= drawn and data.ncon == 0, f"{len(drawn)} bodies")


def check_scenario(linkproof, path, singular):
    """All checks of one scenario."""
    print(path)
    del warnings[:]
    scenario = Scenario(linkproof, path)
    check_file(scenario)
    judgement = Judgement(scenario, scenario.model)
    check("MuJoCo gives no warning", not warnings, "; ".join(warnings[:3]))
    if not singular:
        check_promises(judgement)
    for order, what in ((POSITION, "positions"), (FORCE, "forces extrapolated")):
        beyond = [f"{c} beyond {judgement.estimates[c]:.1e}" for c in judgement.beyond(order)]
        check(f"errors of {what} are at most MuJoCo's own error", not beyond, ", ".join(beyond) or f"{len(judgement.of(order))} channels")

    def longer(model):
        """Displaces a site of a loop joint along both axes, because a displacement along a guide has no effect. Without a loop, displaces the last body."""
        loops = model.eq_obj1id[model.eq_type == mujoco.mjtEq.mjEQ_CONNECT]
        if not loops.size:
            model.body_pos[-1][:2] += WRONG_LENGTH * scenario.size()
            return
        site = loops[0]
        model.site_pos[site][:2] += WRONG_LENGTH * scenario.size()
        # Without this flag, MuJoCo ignores the new position of a site that was at its body's origin.
        model.site_sameframe[site] = mujoco.mjtSameFrame.mjSAMEFRAME_NONE

    def heavier(model):
        """Increases the heaviest mass. With transmissions, reactions are not compared, so the loads are increased too."""
        model.body_mass[int(model.body_mass.argmax())] *= 1.0 + WRONG_MASS
        if "transmissions" in scenario.toml:
            model.actuator_biasprm[:, 0] *= 1.0 + WRONG_MASS

    caught = falsified(scenario, longer).beyond(POSITION)
    check(f"a length off by {WRONG_LENGTH:g} of the size is found", caught, f"{len(caught)} channels")
    if not singular:
        caught = falsified(scenario, heavier).beyond(FORCE)
        check(f"a mass or load off by {WRONG_MASS:g} is found", caught, f"{len(caught)} channels")


def told_of(linkproof, singular, path):
    """Printed lines and results of the checks of a scenario, which may run in a separate process."""
    del results[:]
    with contextlib.redirect_stdout(io.StringIO()) as text:
        check_scenario(linkproof, path, singular)
    return text.getvalue(), list(results)


def check_promises(judgement):
    """Size and order of errors."""
    for order, what in ((POSITION, "positions"), (FORCE, "forces")):
        row = " ".join(f"{judgement.worst(order, run)[0]:.1e}" for run in range(len(STEPS)))
        error, channel = judgement.worst(order)
        check(f"errors of {what} are within their limits", error <= PROMISED[what], f"{row}, worst in {channel}")
    orders = {c: order for c, order in judgement.orders.items() if order is not None}
    off = [f"{channel} {order:.2f}" for channel, order in orders.items() if not abs(order - POSITION) <= ORDER]
    if orders:
        check("positions are of second order", not off, ", ".join(off) or f"{min(orders.values()):.3f} to {max(orders.values()):.3f}")
    else:
        # In a train of wheels at constant speed, positions have no truncation error.
        check("errors of positions are too small to show an order", judgement.worst(POSITION)[0] <= PROMISED["positions extrapolated"], f"{judgement.worst(POSITION)[0]:.1e}")
    for order, what in ((POSITION, "positions extrapolated"), (FORCE, "forces extrapolated")):
        error, channel = max((judgement.extrapolated[channel], channel) for channel in judgement.of(order))
        check(f"errors of {what} are within their limits", error <= PROMISED[what], f"{error:.1e}, worst in {channel}")


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
