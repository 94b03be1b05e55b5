"""Opens exported SDF, USD and URDF files with public parsers and compares them with the analytic solution.

usage: formats_check.py LINKPROOF SCENARIO...

Of every file: the pose of each body in the start pose, mass, mass centre and moment of inertia, and both anchors of each joint.
The same for files of three further starts, whose poses are those of `linkproof solve`.
URDF is also posed at three instants with the joint values of `linkproof solve`.
A format that refuses a scenario must do so by name. Planted faults must be found.
"""

import contextlib
import csv
import io
import json
import math
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import yourdfpy
from pxr import Usd, UsdGeom, UsdPhysics
from urdf_parser_py import urdf as ros

# Errors relative to the size of the mechanism. The physics attributes of USD have single precision.
DOUBLE, SINGLE = 1e-12, 2e-7
# Further starts: the inputs at these fractions of the motion's time.
STARTS = (0.25, 0.5, 0.75)
# Starts are taken only before the first change point; the number is this part of the motion's time.
# After the change point, the mode in the file gives another configuration.
UNTIL = {"n_four_bar_1": 0.07, "n_four_bar_2": 0.07}
# Number of poses in which URDF is compared beside the start pose, and number of poses for the errors of relations.
POSES, RELATED = 3, 10_000
# Degrees of the relations, and the largest bound as a multiple of the largest error found.
DEGREES, TIGHT = (1, 4, 9), 1.5
# Bounds below this value need not be tight (rad; for a length, as a fraction of the mechanism's size).
FLOOR = 1e-9

results = []


def check(what, passed, found=""):
    """Prints and counts one check."""
    results.append(bool(passed))
    if not passed:
        print(f"  FAILED {what}: {found}")


def told(*command):
    """Standard output of a command."""
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def turn(angle):
    """Rotation about z."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])


class Case:
    """The case as JSON, with its links in the start pose."""

    def __init__(self, linkproof, path, options):
        self.json = json.loads(told(linkproof, "export", path, "-o", "-.json", *options))
        self.size = self.json["size_m"]
        self.links = {link["name"]: link for link in self.json["links"]}
        self.joints = {joint["name"]: joint for joint in self.json["joints"]}
        self.ground = self.json["links"][0]["name"]
        self.moving = [name for name in self.links if name != self.ground]

    def pose(self, link):
        """Origin and rotation of a link's frame in the start pose."""
        start = self.links[link]["start"]
        return np.array(start["origin_m"]), turn(start["angle_rad"])

    def point(self, joint, link):
        """Point of a joint on a link, in the link's frame."""
        sides = (self.joints[joint]["first"], self.joints[joint]["second"])
        return next(np.array(side["at_m"]) for side in sides if side["link"] == link)

    def place(self, joint, link):
        """Point of a joint on a link in the start pose."""
        origin, rotation = self.pose(link)
        return origin + rotation @ self.point(joint, link)


def compare_body(case, name, at, rotation, mass, centre, inertia, single):
    """Compares a body with its link: `at` and `centre` are places in the world (m)."""
    origin, own = case.pose(name)
    link = case.links[name]
    bound = (SINGLE if single else DOUBLE) * max(case.size, np.linalg.norm(origin))
    check(f"place of {name}", np.linalg.norm(at - origin) <= bound, (at, origin))
    check(f"direction of {name}", np.abs(rotation - own).max() <= (SINGLE if single else DOUBLE), rotation)
    there = origin + own @ np.array(link["mass_centre_m"])
    check(f"mass centre of {name}", np.linalg.norm(centre - there) <= bound + SINGLE * single * case.size, (centre, there))
    for what, key, found in (("mass", "mass_kg", mass), ("inertia", "inertia_kg_m2", inertia)):
        # A link without mass or inertia has a small value in the file.
        good = abs(found - link[key]) <= (SINGLE if single else DOUBLE) * link[key] if link[key] > 0 else found > 0
        check(f"{what} of {name}", good, (found, link[key]))


def compare_joint(case, name, parent, child, anchors, axes, single):
    """Compares a joint: its links, its anchors on both of them, and its axis on both (`None`: about z)."""
    joint = case.joints[name]
    check(f"links of {name}", {parent, child} == {joint["first"]["link"], joint["second"]["link"]}, (parent, child))
    bound = (SINGLE if single else DOUBLE) * 4.0 * max(case.size, *(np.linalg.norm(anchor) for anchor in anchors))
    check(f"anchors of {name}", np.linalg.norm(anchors[0] - anchors[1]) <= bound, anchors)
    there = case.place(name, child)
    check(f"place of {name}", np.linalg.norm(anchors[1] - there) <= bound, (anchors, there))
    if joint["axes"] is None:
        check(f"axis of {name}", axes is None, axes)
        return
    for axis, side, link in zip(joint["axes"], ("first", "second"), (joint["first"]["link"], joint["second"]["link"])):
        own = case.pose(link)[1] @ np.array(axis)
        for found in axes:
            check(f"axis of {name} on the {side} link", abs(abs(found @ own) - 1.0) <= (SINGLE if single else DOUBLE), (found, own))


def numbers(element, path):
    """Numbers of an element of XML."""
    return np.array([float(word) for word in element.findtext(path).split()])


def check_sdf(case, text):
    """Reads SDF as XML."""
    world = ElementTree.fromstring(text).find("world")
    check("gravity", np.array_equal(numbers(world, "gravity")[:2], case.json["gravity_m_s2"]))
    model = world.findall("model")[1]
    poses = {"world": np.zeros(6)}
    for link in model.findall("link"):
        pose = poses[link.get("name")] = numbers(link, "pose")
        rotation = turn(pose[5])
        centre = pose[:2] + rotation @ numbers(link, "inertial/pose")[:2]
        moments = [float(link.findtext(f"inertial/inertia/i{axes}")) for axes in ("xx", "yy", "zz")]
        check("triangle inequality", 2.0 * max(moments) <= sum(moments), moments)
        compare_body(case, link.get("name"), pose[:2], rotation, float(link.findtext("inertial/mass")), centre, moments[2], False)
    check("all links", set(poses) == {"world", *case.moving}, set(poses))
    joints = model.findall("joint")
    check("all joints", {joint.get("name") for joint in joints} == set(case.joints), len(joints))
    for joint in joints:
        parent, child = joint.findtext("parent"), joint.findtext("child")
        pose, own = poses[child], numbers(joint, "pose")
        anchor = pose[:2] + turn(pose[5]) @ own[:2]
        xyz = numbers(joint, "axis/xyz")
        slides = joint.get("type") == "prismatic"
        axes = [turn(pose[5] + own[5]) @ xyz[:2]] if slides else None
        check("axis", slides or np.array_equal(xyz, [0, 0, 1]), xyz)
        # SDF gives the joint only in the child. A slide may be displaced: its parent anchor is not compared.
        other = anchor if slides else case.place(joint.get("name"), case.ground if parent == "world" else parent)
        compare_joint(case, joint.get("name"), case.ground if parent == "world" else parent, child, [other, anchor], axes, False)


def check_usd(case, text):
    """Reads USD with the library of Pixar."""
    with tempfile.TemporaryDirectory() as directory:
        file = Path(directory) / "own.usda"
        file.write_text(text)
        stage = Usd.Stage.Open(str(file))
        check("metres and z", UsdGeom.GetStageMetersPerUnit(stage) == 1.0 and UsdGeom.GetStageUpAxis(stage) == "Z")
        scene = UsdPhysics.Scene.Get(stage, "/mechanism/scene")
        gravity = np.array(scene.GetGravityDirectionAttr().Get()) * scene.GetGravityMagnitudeAttr().Get()
        check("gravity", np.abs(gravity[:2] - case.json["gravity_m_s2"]).max() <= SINGLE * 10.0, gravity)
        cache = UsdGeom.XformCache()

        def named(prim):
            return prim.GetDisplayName() or prim.GetName()

        bodies = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
        check("all links", {named(prim) for prim in bodies} == set(case.links), len(bodies))
        frames = {}
        for prim in bodies:
            matrix = np.array(cache.GetLocalToWorldTransform(prim)).T
            frames[str(prim.GetPath())] = matrix
            if named(prim) == case.ground:
                continue
            mass = UsdPhysics.MassAPI(prim)
            centre = (matrix @ [*mass.GetCenterOfMassAttr().Get(), 1.0])[:2]
            inertia = mass.GetDiagonalInertiaAttr().Get()
            check("triangle inequality", 2.0 * max(inertia) <= sum(inertia), inertia)
            compare_body(case, named(prim), matrix[:2, 3], matrix[:2, :2], mass.GetMassAttr().Get(), centre, inertia[2], True)
        joints = [prim for prim in stage.Traverse() if prim.IsA(UsdPhysics.Joint) and not prim.IsA(UsdPhysics.FixedJoint)]
        check("all joints", {named(prim) for prim in joints} == set(case.joints), len(joints))
        tree = 0
        for prim in joints:
            joint = UsdPhysics.Joint(prim)
            slides = prim.IsA(UsdPhysics.PrismaticJoint)
            tree += not joint.GetExcludeFromArticulationAttr().Get()
            anchors, axes, links = [], [], []
            for body, place, rotation in (
                (joint.GetBody0Rel(), joint.GetLocalPos0Attr(), joint.GetLocalRot0Attr()),
                (joint.GetBody1Rel(), joint.GetLocalPos1Attr(), joint.GetLocalRot1Attr()),
            ):
                path = body.GetTargets()[0]
                links.append(named(stage.GetPrimAtPath(path)))
                matrix = frames[str(path)]
                anchors.append((matrix @ [*place.Get(), 1.0])[:2])
                quaternion = rotation.Get()
                angle = 2.0 * math.atan2(quaternion.GetImaginary()[2], quaternion.GetReal())
                axes.append(matrix[:2, :2] @ turn(angle) @ [1.0, 0.0])
            check(f"frames of {named(prim)}", axes[0] @ axes[1] >= 1.0 - SINGLE, axes)
            compare_joint(case, named(prim), *links, anchors, axes if slides else None, True)
        check("the articulation is a tree", tree == len(case.moving), tree)


class Robot:
    """A URDF file as two parsers read it, with the frames of the mechanism's links."""

    def __init__(self, case, text):
        self.case = case
        quiet = io.StringIO()
        with contextlib.redirect_stderr(quiet):
            self.ros = ros.URDF.from_xml_string(text.encode())
        check("urdf_parser_py reads without warnings", not quiet.getvalue(), quiet.getvalue()[:200])
        options = {"load_meshes": False, "build_collision_scene_graph": False, "load_collision_meshes": False, "build_scene_graph": True}
        self.model = yourdfpy.URDF.load(io.BytesIO(text.encode()), **options)
        self.text = text
        self.parents = {joint.child: joint.parent for joint in self.ros.joints}
        # A URDF link's frame lies at its hinge.
        self.shift = {self.name(case.ground): np.zeros(2)}
        for joint in self.ros.joints:
            point = case.point(joint.name, joint.child)
            self.shift[joint.child] = point if joint.type == "continuous" else np.zeros(2)

    def name(self, link):
        """Name of a link in the file."""
        return "world" if link == self.case.ground else link

    def posed(self, coordinates):
        """Origin and rotation of every link's frame, computed by yourdfpy."""
        self.model.update_cfg({name: coordinates[name] for name in self.model.actuated_joint_names})
        found = {}
        for link in self.case.links:
            matrix = self.model.get_transform(self.name(link), "world")
            rotation = matrix[:2, :2]
            found[link] = (matrix[:2, 3] - rotation @ self.shift[self.name(link)], rotation)
        return found

    def frames(self, coordinates):
        """Origins and angles of all URDF links for many poses at once."""
        count = len(next(iter(coordinates.values())))
        frames = {"world": (np.zeros((count, 2)), np.zeros(count))}
        waiting = list(self.ros.joints)
        while waiting:
            joint = next(own for own in waiting if own.parent in frames)
            waiting.remove(joint)
            origin, angle = frames[joint.parent]
            at = origin + arms(angle, joint.origin.xyz[:2])
            angle = angle + joint.origin.rpy[2]
            value = coordinates[joint.name]
            if joint.type == "continuous":
                angle = angle + value
            else:
                at = at + arms(angle, joint.axis[:2]) * value[:, None]
            frames[joint.child] = (at, angle)
        return frames

    def coordinates(self, motion):
        """Coordinates of all joints of the tree in all poses of a motion; zero in the start pose."""
        found = {}
        for joint in self.ros.joints:
            parent = self.case.ground if joint.parent == "world" else joint.parent
            if joint.type == "continuous":
                begun = self.case.links[joint.child]["start"]["angle_rad"] - self.case.links[parent]["start"]["angle_rad"]
                found[joint.name] = motion.angle(joint.child) - motion.angle(parent) - begun
            else:
                gap = motion.place(joint.name, joint.child) - motion.place(joint.name, parent)
                begun = self.case.place(joint.name, joint.child) - self.case.place(joint.name, parent)
                axis = self.case.pose(joint.child)[1] @ np.array(joint.axis[:2])
                found[joint.name] = (arms(motion.angle(joint.child), joint.axis[:2]) * gap).sum(axis=1) - axis @ begun
        return found


def arms(angles, local):
    """The vector `local` turned by each of the angles."""
    c, s = np.cos(angles), np.sin(angles)
    return np.stack([c * local[0] - s * local[1], s * local[0] + c * local[1]], axis=1)


class Motion:
    """The motion of all links as `linkproof solve` computes it."""

    def __init__(self, case, linkproof, path, times, *options):
        table = told(linkproof, "solve", path, "--with", "assur", "--only", "positions", "--times", times, *options)
        rows = list(csv.reader(io.StringIO(table)))
        self.case = case
        self.columns = dict(zip(rows[0], np.array(rows[1:], dtype=float).T))
        self.count = len(rows) - 1

    def angle(self, link):
        """Angles of a link (rad)."""
        return np.zeros(self.count) if link == self.case.ground else self.columns[f"link.{link}.angle_rad"]

    def origin(self, link):
        """Origins of a link's frame (m); the columns have the mass centre."""
        if link == self.case.ground:
            return np.zeros((self.count, 2))
        centre = np.stack([self.columns[f"link.{link}.{axis}_m"] for axis in "xy"], axis=1)
        return centre - arms(self.angle(link), self.case.links[link]["mass_centre_m"])

    def place(self, joint, link):
        """Places of a joint's point on a link (m)."""
        return self.origin(link) + arms(self.angle(link), self.case.point(joint, link))


def check_poses(case, robot, motion):
    """URDF posed by yourdfpy with the joint values of the solution."""
    coordinates = robot.coordinates(motion)
    for row in range(motion.count):
        poses = robot.posed({name: values[row] for name, values in coordinates.items()})
        for link in case.moving:
            there = motion.origin(link)[row]
            bound = 1e-9 * (case.size + np.linalg.norm(there))
            check(f"place of {link} in motion", np.linalg.norm(poses[link][0] - there) <= bound, (poses[link][0], there))
            off = np.abs(poses[link][1] - turn(motion.angle(link)[row])).max()
            check(f"direction of {link} in motion", off <= 1e-9, off)


def relations(text):
    """The relations in the comment of a URDF file."""
    line = next(line for line in text.splitlines() if '"driven":' in line)
    return json.loads(line.strip().removeprefix("<!--").removesuffix("-->"))


def range_of(told_by):
    """Range of the driven joint's coordinate (rad or m)."""
    return told_by.get("domain_rad") or told_by["domain_m"]


def check_relations(case, robot, motion, degree):
    """The relations of `--mimic`: no error of the poses exceeds its bound, and the bounds are tight."""
    told_by = relations(robot.text)
    domain = range_of(told_by)
    true = robot.coordinates(motion)
    driven = true[told_by["driven"]]
    inside = (driven >= domain[0] - 1e-12) & (driven <= domain[1] + 1e-12)
    check("enough poses in the range", inside.sum() > 0.4 * RELATED, inside.sum())
    x = (2.0 * driven - domain[0] - domain[1]) / (domain[1] - domain[0])
    followed = {told_by["driven"]: driven}
    mimics = {joint.name: joint.mimic for joint in robot.ros.joints if joint.mimic}

    def compare(what, errors, bound, scale):
        most = float(errors[inside].max())
        check(f"{what} is within its bound", most <= bound + 1e-13 * scale, (most, bound))
        check(f"the bound of {what} is tight", bound <= max(TIGHT * most, FLOOR * scale), (most, bound))
        return bound / most if most > FLOOR * scale else 1.0

    ratios = []
    for own in told_by["joints"]:
        followed[own["joint"]] = np.polynomial.chebyshev.chebval(x, own["chebyshev"])
        slides = "error_m" in own
        off = followed[own["joint"]] - true[own["joint"]]
        off = np.abs(off if slides else (off + math.pi) % (2.0 * math.pi) - math.pi)
        ratios.append(compare(f"joint {own['joint']}", off, own["error_m" if slides else "error_rad"], case.size if slides else 1.0))
        mimic = mimics.get(own["joint"])
        check("a relation of degree 1 is a mimic", (mimic is not None) == (len(own["chebyshev"]) == 2), own)
        if mimic:
            line = mimic.multiplier * driven + mimic.offset
            check("the mimic is the polynomial", np.abs(line - followed[own["joint"]]).max() <= 1e-9, own)
    frames = robot.frames(followed)
    for own in told_by["pins"]:
        origin, angle = frames[own["link"]]
        place = origin + arms(angle, case.point(own["joint"], own["link"]) - robot.shift[own["link"]])
        off = np.linalg.norm(place - motion.place(own["joint"], own["link"]), axis=1)
        ratios.append(compare(f"pin {own['joint']} on {own['link']}", off, own["error_m"], case.size))
    worst = max((own["error_rad"] for own in told_by["joints"] if "error_rad" in own), default=0.0)
    print(f"  degree {degree}: largest bound of an angle {worst:.2e} rad; bound / error at most {max(ratios, default=1.0):.3f}")


def check_urdf(case, text):
    """Reads URDF with two parsers, and the joints that close loops as XML."""
    robot = Robot(case, text)
    poses = robot.posed(dict.fromkeys(robot.model.actuated_joint_names, 0.0))
    for link in robot.ros.links:
        if link.name == "world":
            continue
        origin, rotation = poses[link.name]
        centre = origin + rotation @ (np.array(link.inertial.origin.xyz[:2]) + robot.shift[link.name])
        moments = link.inertial.inertia
        check("triangle inequality", 2.0 * moments.izz <= moments.ixx + moments.iyy + moments.izz, moments)
        compare_body(case, link.name, origin, rotation, link.inertial.mass, centre, moments.izz, False)
    check("all links", {link.name for link in robot.ros.links} == {"world", *case.moving})
    closing = ElementTree.fromstring(text).findall("gazebo/joint")
    names = {joint.name for joint in robot.ros.joints} | {joint.get("name") for joint in closing}
    check("all joints", names == set(case.joints), names)
    for joint in robot.ros.joints:
        parent = case.ground if joint.parent == "world" else joint.parent
        anchors = []
        for link, at in ((parent, joint.origin.xyz[:2]), (joint.child, [0.0, 0.0])):
            origin, rotation = poses[link]
            anchors.append(origin + rotation @ (np.array(at) + robot.shift[robot.name(link)]))
        axes = None
        if joint.type == "prismatic":
            axes = [poses[joint.child][1] @ np.array(joint.axis[:2])]
            # The frame of a sliding link is at the link's origin, not at the joint's point.
            arm = poses[joint.child][1] @ case.point(joint.name, joint.child)
            anchors = [anchor + arm for anchor in anchors]
        compare_joint(case, joint.name, parent, joint.child, anchors, axes, False)
    for joint in closing:
        parent, child = joint.findtext("parent"), joint.findtext("child")
        parent = case.ground if parent == "world" else parent
        origin, rotation = poses[child]
        anchor = origin + rotation @ (numbers(joint, "pose")[:2] + robot.shift[child])
        slides = joint.get("type") == "prismatic"
        axes = [rotation @ numbers(joint, "axis/xyz")[:2]] if slides else None
        other = anchor if slides else case.place(joint.get("name"), parent)
        compare_joint(case, joint.get("name"), parent, child, [other, anchor], axes, False)


READERS = {"sdf": check_sdf, "usda": check_usd, "urdf": check_urdf}


# Planted faults of each format: a pattern with a number, and its replacement by a function of the number.
FAULTS = {
    "sdf": ((r"<mass>(.*?)</mass>", 1.001), (r'^ {6}<link name="[^"]*">\s*<pose>(-?0\.\d+) ', 1.0001), (r"<izz>(.*?)</izz>", 1.001)),
    "usda": ((r"physics:mass = (?!1$)(.*)", 1.001), (r"localPos\d = \((-?0\.\d+),", 1.001)),
    "urdf": ((r'mass value="(.*?)"', 1.001), (r'type="continuous">\s*<origin xyz="(-?0\.\d+) ', 1.001), (r'izz="(.*?)"', 1.001)),
}


def finds(reader, case, text):
    """Whether a reader finds a difference; its checks are not counted."""
    kept = results.copy()
    with contextlib.redirect_stdout(io.StringIO()):
        reader(case, text)
    found = not all(results[len(kept) :])
    results[:] = kept
    return found


def plant(form, case, text, reader):
    """Faults that the reader must find; those whose pattern does not occur are left out."""
    for pattern, factor in FAULTS[form]:
        # The fault changes the largest value, because a link without mass or inertia has a small value that is not
        # compared.
        found = max(re.finditer(pattern, text, re.MULTILINE), key=lambda own: abs(float(own[1])), default=None)
        if not found:
            continue
        wrong = f"{text[: found.start(1)]}{float(found[1]) * factor!r}{text[found.end(1) :]}"
        check(f"a planted fault in {form} is found", finds(reader, case, wrong), found[0])


def further_starts(linkproof, path, case):
    """Options of further starts and their cases, whose poses are compared with the solution."""
    last = case.json["times_s"][-1] * UNTIL.get(case.json["name"], 1.0)
    motion = Motion(case, linkproof, path, ",".join(repr(share * last) for share in STARTS))
    name, inputs = list(motion.columns.items())[1]
    # At every start, further drives have their inputs at t = 0.
    is_one = len(case.json["drives"]) == 1
    found = []
    for row, value in enumerate(inputs):
        start = ["--start-crank-deg", repr(math.degrees(value) if name.endswith("_rad") else 1e3 * float(value))]
        try:
            own = Case(linkproof, path, start)
        except subprocess.CalledProcessError as error:
            # The phases of transmissions, and laws given as formulas, are valid only for the start in the file.
            check("a start is refused with a reason", re.search(r"starts of the transmissions|law begins", error.stderr), error.stderr)
            print(f"  further starts: {error.stderr.splitlines()[0]}")
            return []
        true, at = (motion, row) if is_one else (Motion(own, linkproof, path, "0", *start), 0)
        for link in case.moving:
            (origin, rotation), there = own.pose(link), true.origin(link)[at]
            check(f"place of {link} at {start}", np.linalg.norm(origin - there) <= 1e-9 * (case.size + np.linalg.norm(there)), (origin, there))
            check(f"direction of {link} at {start}", np.abs(rotation - turn(true.angle(link)[at])).max() <= 1e-9, rotation)
            check(f"masses at {start}", all(own.links[link][key] == case.links[link][key] for key in ("mass_kg", "inertia_kg_m2")))
        found.append((start, own))
    return found


def check_motion(linkproof, path, case, file, options):
    """URDF at instants of the motion, and the relations of its joints."""
    last = case.json["times_s"][-1]
    check_poses(case, Robot(case, file.read_text()), Motion(case, linkproof, path, f"{last / POSES!r}:{last!r}:{last / POSES!r}"))
    law = case.json["drives"][0]["motion"]
    for degree in DEGREES:
        command = [linkproof, "export", path, "-o", str(file), "--mimic", str(degree), *options]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode != 0:
            check("relations are refused with a way out", "help:" in run.stderr, run.stderr)
            print(f"  relations: {run.stderr.splitlines()[0]}")
            return
        robot = Robot(case, file.read_text())
        # At constant speed, the poses cover the range of the relations.
        low, high = range_of(relations(robot.text))
        span = min(last, (high - low) / abs(law.get("speed_rad_s") or law.get("speed_m_s"))) if law["law"] == "constant" else last
        check_relations(case, robot, Motion(case, linkproof, path, f"0:{span!r}:{span / RELATED!r}"), degree)


def check_file(linkproof, path):
    """All formats of one scenario; returns the formats that hold it."""
    held, starts = [], None
    with tempfile.TemporaryDirectory() as directory:
        for form, reader in READERS.items():
            for options in ([], ["--no-loads"]):
                file = Path(directory) / f"own.{form}"
                run = subprocess.run([linkproof, "export", path, "-o", str(file), *options], capture_output=True, text=True)
                if run.returncode == 0:
                    case = Case(linkproof, path, options)
                    reader(case, file.read_text())
                    held.append(form)
                    plant(form, case, file.read_text(), reader)
                    if starts is None:
                        starts = further_starts(linkproof, path, case)
                    for start, own in starts:
                        there = told(linkproof, "export", path, "-o", f"-.{form}", *options, *start)
                        reader(own, there)
                        check(f"another start is found in {form}", finds(reader, case, there), start)
                    if form == "urdf":
                        check_motion(linkproof, path, case, file, options)
                    break
                check(f"{form} is refused by name", "cannot be written to" in run.stderr or "SDF" in run.stderr, run.stderr)
                check(f"{form} is refused with a way out", "help:" in run.stderr, run.stderr)
            else:
                print(f"  {form}: {run.stderr.splitlines()[0]}")
    return held


def main():
    linkproof, *scenarios = sys.argv[1:]
    counts = dict.fromkeys(READERS, 0)
    for path in scenarios:
        print(path)
        for form in check_file(linkproof, path):
            counts[form] += 1
    print(f"{len(scenarios)} scenarios, held by: {counts}; {len(results)} checks, {results.count(False)} failed")
    sys.exit(not all(results))


if __name__ == "__main__":
    main()
