#!/usr/bin/env python3
"""MuJoCo as a peer of `linkproof bench`, on the model of `linkproof export` (pip install mujoco).

    linkproof bench scenarios/crank_rocker.toml -o bench --peer mujoco='python3 examples/peers/mujoco_peer.py'

The measured time covers the steps and one forward computation at every instant, but not the building of the model.
Velocities, accelerations and forces are read afterwards from stored states; this is not timed.
"""

import math
import time

import mujoco
import numpy as np

from linkproof_peer import Motion, Refused, main

# Rotation of the fastest drive in a step (deg), and numbers of steps of a motion under forces.
TURNS = (4.0, 2.0, 1.0, 0.5, 0.25, 0.1, 0.05, 0.02)
COUNTS = (250, 500, 1000, 2000, 4000, 8000, 16000)
# Time constant of the loops, in steps. With None, as in the file, constraints close a gap in one step.
LOOPS = {"implicitfast": None, "RK4": None, "RK4, loops of 3 steps": 3.0}
REPEATS = 3
# Start speed for a motion under forces from rest (rad/s), so that resistances have the right sense at t = 0.
START = 1e-7


def ways(request, case):
    if request["mjcf"] is None:
        raise Refused(request["mjcf_refused"])
    if (case.times < 0.0).any() or (np.diff(case.times) <= 0.0).any():
        raise Refused("its instants do not ascend from 0 s on")
    span = case.times[-1]
    if case.data["free"]:
        steps = [span / count for count in COUNTS]
    else:
        steps = [math.radians(turn) / abs(case.data["top_speed_rad_s"]) for turn in TURNS]
    steps = steps[1:6:2] if request["quick"] else steps
    names = list(LOOPS)[:2] if request["quick"] else LOOPS
    return [{"name": name, "resolution": f"step {step:.3e} s", "step_s": step} for name in names for step in steps]


def model_of(request, case, way):
    model = mujoco.MjModel.from_xml_path(request["mjcf"])
    model.opt.integrator = getattr(mujoco.mjtIntegrator, "mjINT_" + way["name"].split(",")[0].upper())
    return model


def harden(model, way):
    """Sets the time constant of the loops, as a multiple of the present step."""
    softness = LOOPS[way["name"]]
    if softness is not None:
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_REFSAFE
        model.eq_solref[:] = [softness * model.opt.timestep, 1.0]


def start(case, model):
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    drive = case.drives[0]
    if case.data["free"] and not np.any(data.qvel) and any(load["type"] == "resistance" for load in case.loads):
        mujoco.mj_forward(model, data)
        own = abs(case.links[drive["link"]]["start"]["alpha_rad_s2"])
        rate = {name: case.links[name]["start"]["alpha_rad_s2"] for name in case.links}
        for joint in range(model.njnt):
            body = model.jnt_bodyid[joint]
            parent = model.body(model.body_parentid[body]).name
            ahead = rate[model.body(body).name] - rate.get(parent, 0.0)
            if own > 0.0 and model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE:
                data.qvel[model.jnt_dofadr[joint]] = START / own * ahead
    return data


def run(case, model, way):
    """Simulates; returns states at the instants, time and steps."""
    data, kept, count = start(case, model), [], 0
    since, now = time.process_time(), 0.0
    for t in case.times:
        if t > now:
            steps = max(1, math.ceil((t - now) / way["step_s"] * (1.0 - 1e-9)))
            model.opt.timestep = (t - now) / steps
            harden(model, way)
            mujoco.mj_step(model, data, steps)
            now, count = t, count + steps
        # Forces belong to the state before the last step, so they are computed again.
        mujoco.mj_forward(model, data)
        kept.append((model.opt.timestep, data.qpos.copy(), data.qvel.copy()))
    return kept, time.process_time() - since, count


def moment_of(case, model, data, joint):
    """Moment on the body that a joint of the tree carries, about the joint's point, in world axes."""
    read = data.sensor(f"{joint}.moment").data[2]
    carried = model.jnt_bodyid[model.joint(joint).id]
    # MuJoCo computes the sensor's moment by inverse dynamics, without the loads on the links beyond this joint.
    for load in case.loads:
        body = model.body(load["link"]).id
        while body not in (0, carried):
            body = model.body_parentid[body]
        if body == carried:
            spin = data.body(load["link"]).cvel[2]
            own = -math.copysign(load["moment_N_m"], spin) if load["type"] == "resistance" else load["moment_N_m"]
            read -= own
    return read


def reaction(case, model, data, joint):
    """Force and moment of a joint's first link on its second, about the joint's point on the second, in world axes."""
    name = joint["name"]
    sensor = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SENSOR, f"{name}.force")
    if sensor < 0:
        # This joint closes a loop; the rows of its `connect` are the force on the first of its two sites.
        rows = (data.efc_id[: data.nefc] == model.equality(name).id) & (
            data.efc_type[: data.nefc] == mujoco.mjtConstraint.mjCNSTR_EQUALITY)
        return -data.efc_force[: data.nefc][rows][:2], None
    site = model.sensor_objid[sensor]
    sense = 1.0 if model.site(site).name == f"{name}.second" else -1.0
    force = (data.site_xmat[site].reshape(3, 3) @ data.sensor(f"{name}.force").data * sense)[:2]
    if joint["type"] != "prismatic":
        return force, None
    moment = moment_of(case, model, data, name) * sense
    if sense < 0.0:
        # The sensor's moment is about the joint's point on the carried body, here the first link.
        first, second = (data.site(f"{name}.{side}").xpos for side in ("first", "second"))
        arm = first - second
        moment += arm[0] * force[1] - arm[1] * force[0]
    return force, moment


def solve(request, case, way):
    model = model_of(request, case, way)
    seconds = []
    for _ in range(REPEATS):
        kept, taken, count = run(case, model, way)
        seconds.append(taken)
        if sum(seconds) > 0.5:
            break
    names, rows = [link["name"] for link in case.moving], len(case.times)
    table = lambda: {name: np.zeros((rows, 2)) for name in names}
    line = lambda: {name: np.zeros(rows) for name in names}
    motion = Motion(table(), line(), table(), line(), table(), line())
    # Sensors include neither forces of springs nor forces on points.
    forces = "reactions" in case.stages and all(load["type"] in ("resistance", "moment") for load in case.loads)
    if forces:
        motion.force = {joint["name"]: np.zeros((rows, 2)) for joint in case.joints}
        motion.moment = {joint["name"]: np.zeros(rows) for joint in case.joints if joint["type"] == "prismatic"}
        motion.torque = [np.zeros(rows) for _ in case.drives]
    data, six = mujoco.MjData(model), np.zeros(6)
    for row, (step, qpos, qvel) in enumerate(kept):
        model.opt.timestep = step
        harden(model, way)
        data.qpos[:], data.qvel[:] = qpos, qvel
        mujoco.mj_forward(model, data)
        mujoco.mj_rnePostConstraint(model, data)
        for name in names:
            body = model.body(name).id
            motion.origin[name][row] = data.xpos[body][:2]
            motion.angle[name][row] = angle(case, model, data, body)
            kind = mujoco.mjtObj.mjOBJ_XBODY
            mujoco.mj_objectVelocity(model, data, kind, body, six, 0)
            motion.omega[name][row], motion.velocity[name][row] = six[2], six[3:5]
            mujoco.mj_objectAcceleration(model, data, kind, body, six, 0)
            # MuJoCo's accelerations contain gravity, which is removed here.
            motion.alpha[name][row], motion.acceleration[name][row] = six[2], six[3:5] + case.gravity
        if forces:
            for joint in case.joints:
                force, moment = reaction(case, model, data, joint)
                motion.force[joint["name"]][row] = force
                if moment is not None:
                    motion.moment[joint["name"]][row] = moment
            for index, drive in enumerate(case.drives):
                motion.torque[index][row] = moment_of(case, model, data, drive["joint"])
    stages = 4 if way["name"].startswith("RK4") else 1
    return motion, seconds, {"steps": count, "evaluations": count * stages + rows}


def angle(case, model, data, body):
    """Angle of a body including whole turns: the sum of the coordinates of its hinges."""
    total = 0.0
    while body:
        name, parent = model.body(body).name, model.body_parentid[body]
        joint = model.body_jntadr[body]
        if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE:
            total += data.qpos[model.jnt_qposadr[joint]]
        else:
            outer = case.links[model.body(parent).name]["start"]["angle_rad"] if parent else 0.0
            total += case.links[name]["start"]["angle_rad"] - outer
        body = parent
    return total


if __name__ == "__main__":
    main(ways, solve, f"MuJoCo {mujoco.__version__}")
