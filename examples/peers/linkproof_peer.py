"""Common part of peers of `linkproof bench` in Python; docs/peers.md describes the protocol.

A peer calls `main(ways, solve)`. `ways(request, case)` returns a list of dictionaries with a name and a resolution;
`solve(request, case, way)` returns a `Motion`, the seconds it took (a list) and its counts of work.
Both functions may raise `Refused` with a reason, which the diagram shows.
"""

import csv
import json
import pathlib
import sys
from dataclasses import dataclass, field

import numpy as np


class Refused(Exception):
    """The reason why the peer cannot run the case."""


class Case:
    """The scenario: `data` is the JSON of `linkproof export -o FILE.json`."""

    def __init__(self, data):
        self.data = data
        self.times = np.array(data["times_s"], float)
        self.links = {link["name"]: link for link in data["links"]}
        self.moving = [link for link in data["links"] if link["name"] != "ground"]
        self.joints, self.drives, self.loads = data["joints"], data["drives"], data["loads"]
        self.channels = [channel["name"] for channel in data["channels"]]
        self.stages = {channel["stage"] for channel in data["channels"]}
        self.gravity = np.array(data["gravity_m_s2"], float)

    def uniform(self):
        """Interval of the grid, which must begin at 0 and be uniform."""
        steps = np.diff(self.times)
        if len(steps) == 0 or self.times[0] != 0.0 or np.ptp(steps) > 1e-9 * self.times[-1] or steps[0] <= 0.0:
            raise Refused("its instants are not uniform from 0 s on")
        return self.times[-1] / len(steps)


@dataclass
class Motion:
    """Arrays with one row for each instant. The components x and y are along the last axis of an array.

    The keys of `origin`, `angle`, `velocity`, `omega`, `acceleration` and `alpha` are links; those of `force` and `moment` are
    joints. A force is that of the first link on the second; a moment is about the joint's point on the second link. Torques
    are in the order of drives. If a quantity is empty, its channels are left out.
    """

    origin: dict
    angle: dict
    velocity: dict = field(default_factory=dict)
    omega: dict = field(default_factory=dict)
    acceleration: dict = field(default_factory=dict)
    alpha: dict = field(default_factory=dict)
    force: dict = field(default_factory=dict)
    moment: dict = field(default_factory=dict)
    torque: list = field(default_factory=list)

    def point(self, link, local):
        """Position of a point of a link, and velocity and acceleration if they are known."""
        if link == "ground":
            still = np.zeros((len(next(iter(self.angle.values()))), 2))
            return still + local, still, still
        c, s = np.cos(self.angle[link]), np.sin(self.angle[link])
        arm = np.stack([c * local[0] - s * local[1], s * local[0] + c * local[1]], axis=-1)
        across = np.stack([-arm[:, 1], arm[:, 0]], axis=-1)
        place, velocity, acceleration = self.origin[link] + arm, None, None
        if link in self.omega:
            velocity = self.velocity[link] + across * self.omega[link][:, None]
        if link in self.alpha:
            acceleration = (self.acceleration[link] + across * self.alpha[link][:, None]
                            - arm * self.omega[link][:, None] ** 2)
        return place, velocity, acceleration


def columns(case, motion):
    """All channels of a motion, by name."""
    found = {"t_s": case.times}

    def put(name, of, suffixes):
        for part, (x, y) in zip(of, suffixes):
            if part is not None:
                found[f"{name}.{x}"], found[f"{name}.{y}"] = part.T

    place_of = {}
    for link in case.moving:
        name = link["name"]
        found[f"link.{name}.angle_rad"] = motion.angle[name]
        if name in motion.omega:
            found[f"link.{name}.omega_rad_s"] = motion.omega[name]
        if name in motion.alpha:
            found[f"link.{name}.alpha_rad_s2"] = motion.alpha[name]
        suffixes = (("x_m", "y_m"), ("vx_m_s", "vy_m_s"), ("ax_m_s2", "ay_m_s2"))
        put(f"link.{name}", motion.point(name, link["mass_centre_m"]), suffixes)
        for point, local in link["points_m"].items():
            if point not in place_of:
                place_of[point] = name
                put(f"point.{point}", motion.point(name, local), suffixes)
    for joint in case.joints:
        name = joint["name"]
        if name in motion.force:
            found[f"joint.{name}.fx_N"], found[f"joint.{name}.fy_N"] = motion.force[name].T
        if joint["type"] == "prismatic":
            slide(case, motion, joint, found)
    shaking(case, motion, found)
    for index, drive in enumerate(case.drives):
        if index < len(motion.torque):
            name = "drive" if index == 0 else f"drive.{drive['joint']}"
            found[f"{name}.{'force_N' if 'start_m' in drive else 'torque_N_m'}"] = motion.torque[index]
    return {name: found[name] for name in ["t_s", *case.channels] if name in found}


def slide(case, motion, joint, found):
    """Adds the slide along the axis on the first link, its derivatives, and the moment."""
    name, (first, second) = joint["name"], (joint["first"], joint["second"])
    one, two = (motion.point(side["link"], side["at_m"]) for side in (first, second))
    angle = motion.angle.get(first["link"], np.zeros(len(case.times))) + np.arctan2(*joint["axes"][0][::-1])
    axis = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    along = lambda k: (axis * (two[k] - one[k])).sum(axis=1)
    found[f"joint.{name}.slide_m"] = along(0)
    if one[1] is not None and two[1] is not None:
        found[f"joint.{name}.slide_speed_m_s"] = along(1)
    if one[2] is not None and two[2] is not None:
        omega = motion.omega.get(first["link"], 0.0)
        found[f"joint.{name}.slide_acceleration_m_s2"] = along(2) + along(0) * omega**2
    if name in motion.moment:
        found[f"joint.{name}.moment_N_m"] = motion.moment[name]


def shaking(case, motion, found):
    """Adds force and moment on the frame, from the joints on the ground and the drives."""
    # Springs and dampers on the ground, and driven slides, load the frame too.
    ends = [end for load in case.loads for end in (*load.get("links", []), *(own["link"] for own in load.get("ends", [])))]
    if "ground" in ends or any("start_m" in drive for drive in case.drives):
        return
    if len(motion.torque) < len(case.drives) or any(joint["name"] not in motion.force for joint in case.joints):
        return
    force, moment = np.zeros((len(case.times), 2)), -sum(motion.torque)
    for joint in case.joints:
        sign = {joint["second"]["link"]: 1.0, joint["first"]["link"]: -1.0}.get("ground")
        if sign is None:
            continue
        own = motion.force[joint["name"]] * sign
        place = motion.point(joint["second"]["link"], joint["second"]["at_m"])[0]
        force = force + own
        moment = moment + place[:, 0] * own[:, 1] - place[:, 1] * own[:, 0]
        if joint["name"] in motion.moment:
            moment = moment + sign * motion.moment[joint["name"]]
    found["frame.fx_N"], found["frame.fy_N"] = force.T
    found["frame.moment_N_m"] = moment


def main(ways, solve, version):
    """Answers the request named on the command line."""
    what, path = sys.argv[1:3]
    request = json.loads(pathlib.Path(path).read_text())
    case = Case(json.loads(pathlib.Path(request["case"]).read_text()))
    try:
        if what == "ways":
            print("\n" + json.dumps(ways(request, case)), flush=True)
            return
        motion, seconds, work = solve(request, case, request["way"])
        found = columns(case, motion)
        with open(request["csv"], "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(found)
            writer.writerows(zip(*(map(repr, map(float, values)) for values in found.values())))
        print("\n" + json.dumps({"version": version, "seconds": seconds, "work": work}), flush=True)
    except Refused as refused:
        print("\n" + json.dumps({"refused": str(refused)}), flush=True)
