"""Numbers for [[oracle]] tables from an independent program: mpmath, 40 digits, no code of this project.

    python3 tests/outside/newton_euler.py BINARY scenarios/NAME.toml INSTANT [INSTANT ...]

An instant is a crank angle in degrees (70), the slide of the first drive in millimetres with its unit (120mm), or a
time in seconds with its unit (0.35s). With --all the program also prints numbers of points, sliders and the frame.

The program reads the scenario file (tomllib) and has a separate table of units. It closes all joints by Newton's method,
follows the motion from the start in small steps, differentiates the closed poses by differences in 40 digits, and solves
the Newton-Euler equations of all links at once. Each drive adds an equation for the coordinate of its joint, and its
force or moment as an unknown. transmissions.py has the equations of gears, racks, belts and cams, and friction.py has the
equations of friction. The binary (`linkproof solve`) only gives a first guess of the start pose; assembly modes are
checked against docs/scenario.md. Numbers at a crank angle use the nominal speed of a free motion. For numbers at a time,
free_motion.py integrates the motion in double precision, and halves the step until no printed digit changes.
"""

import re
import csv
import io
import math
import subprocess
import sys
import tomllib

from mpmath import mp, mpf

import free_motion
import friction
import transmissions

mp.dps = 40
UNITS = {
    "m": 1, "mm": mpf(1) / 1000, "rad": 1, "deg": mp.pi / 180, "rad_s": 1, "rpm": mp.pi / 30, "s": 1, "ms": mpf(1) / 1000,
    "m_s": 1, "mm_s": mpf(1) / 1000, "kg": 1, "g": mpf(1) / 1000, "kg_m2": 1, "m_s2": 1, "N": 1, "kN": 1000, "N_m": 1, "N_mm": 1000, "N_s_m": 1, "Pa": 1, "bar": 100000, "N_m_rad": 1, "N_m_s": 1,
}


def quantity(table, stem, default=None):
    """The number under the key `stem` + `_` + unit, in SI."""
    for key, value in table.items():
        if key.startswith(stem + "_") and key[len(stem) + 1:] in UNITS:
            return mpf(str(value)) * UNITS[key[len(stem) + 1:]]
    return default


def value(formula, **variables):
    """The value of a formula, in 40 digits."""
    names = {name: getattr(mp, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "pi")}
    digits = re.sub(r"(?<![\w.])\d+(\.\d*)?(e-?\d+)?", lambda own: f"mpf('{own[0]}')", formula)
    return eval(digits.replace("^", "**"), {"mpf": mpf, **names, **variables})


def place(table, known):
    if "from" in table:
        x, y = known[table["from"]]
        length, angle = quantity(table, "length"), quantity(table, "angle")
        return x + length * mp.cos(angle), y + length * mp.sin(angle)
    return quantity(table, "x"), quantity(table, "y")


class Mechanism:
    def __init__(self, text):
        self.file = file = tomllib.loads(text)
        self.links, self.points, self.body = ["ground"] + list(file["links"]), {}, {}
        for name in self.links:
            own = file["ground"] if name == "ground" else file["links"][name]
            points = {}
            for point, at in own.get("points", {}).items():
                points[point] = place(at, points)
            self.points[name] = points
            centre = place(own["mass_centre"], points) if "mass_centre" in own else (mpf(0), mpf(0))
            self.body[name] = (quantity(own, "mass", mpf(0)), centre, quantity(own, "inertia", mpf(0)))
        self.joints = file["joints"]
        drives = file["drive"]
        self.drives = drives if isinstance(drives, list) else [drives]
        gravity = file.get("gravity", {})
        self.gravity = (quantity(gravity, "x", mpf(0)), quantity(gravity, "y", mpf(0)))
        self.loads = file.get("loads", [])
        self.transmissions = [transmissions.of(self, own, quantity, value, spline) for own in file.get("transmissions", [])]
        self.turns = {}
        self.twists = {}
        self.start = self.start_of(0)

    def joint(self, drive):
        return next(joint for joint in self.joints if joint["name"] == drive["joint"])

    def carriers(self, drive):
        """Links that may carry the drive: the ground, and the links that earlier drives move."""
        index = next(index for index, own in enumerate(self.drives) if own is drive)
        return {"ground"} | {self.driven(own) for own in self.drives[:index]}

    def driven(self, drive):
        carriers = self.carriers(drive)
        return next(link for link in self.joint(drive)["links"] if link not in carriers)

    def kind(self, drive):
        """Kind of a drive's input: a slide, a link's angle in the world, or the angle of the second link minus the first."""
        joint = self.joint(drive)
        if joint["type"] == "prismatic":
            return "slide"
        carried = self.carriers(drive) if drive.get("motion") == "free" else {"ground"}
        return "angle" if carried & set(joint["links"]) else "turn"

    def coordinate(self, q, index):
        """Input of a drive in a pose."""
        drive = self.drives[index]
        joint, kind = self.joint(drive), self.kind(drive)
        first, second = joint["links"]
        if kind == "angle":
            return self.angle(q, self.driven(drive))
        if kind == "turn":
            turn = self.angle(q, second) - self.angle(q, first)
            turns = self.turns.setdefault(joint["name"], mp.nint((turn - self.law(index, mpf(0))) / (2 * mp.pi)))
            return turn - 2 * mp.pi * turns
        a, b = (self.at(q, link, local) for link, local in self.sides(joint))
        along = self.angle(q, first) + quantity(joint, "axis")
        return mp.cos(along) * (b[0] - a[0]) + mp.sin(along) * (b[1] - a[1])

    def efforts(self, q, index):
        """Actions of a unit force or moment of a drive: link, force, place, moment."""
        drive = self.drives[index]
        joint, kind, zero = self.joint(drive), self.kind(drive), (mpf(0), mpf(0))
        first, second = joint["links"]
        if kind == "slide":
            along = self.angle(q, first) + quantity(joint, "axis")
            at = self.at(q, *self.sides(joint)[1])
            return [(link, (sign * mp.cos(along), sign * mp.sin(along)), at, mpf(0)) for link, sign in ((second, 1), (first, -1))]
        if kind == "angle" and self.driven(drive) == first:
            first, second = second, first
        return [(second, zero, zero, mpf(1)), (first, zero, zero, mpf(-1))]

    def start_of(self, index):
        drive = self.drives[index]
        if index == 0 and self.kind(drive) == "angle":
            return quantity(self.file["start"], "crank")
        if drive.get("law") == "formula":
            return value(drive["formula"], t=mpf(0))
        return quantity(drive, "start")

    def law(self, index, t):
        """Prescribed input of a drive at a time."""
        drive = self.drives[index]
        start = self.start_of(index)
        zero = quantity(drive, "zero", mpf(0))
        law = drive.get("law", "constant")
        if law == "constant":
            return zero + start + quantity(drive, "speed") * t
        if law == "ramp":
            speed, time = quantity(drive, "speed"), quantity(drive, "time")
            return zero + start + (speed * t * t / time / 2 if t < time else speed * (t - time / 2))
        if law == "table":
            own = "slide" if self.kind(drive) == "slide" else "angle"
            points = [(quantity(row, "time"), quantity(row, own)) for row in drive["points"]]
            return zero + clamped(points, t)
        if law == "hold":
            return zero + start
        if law == "harmonic":
            phase, turn = quantity(drive, "phase", mpf(0)), 2 * mp.pi * t / quantity(drive, "period")
            return zero + start + quantity(drive, "amplitude") * (mp.sin(phase + turn) - mp.sin(phase))
        if law == "formula":
            return zero + value(drive["formula"], t=t)
        assert law == "cycloidal", law
        share = t / quantity(drive, "time")
        return zero + start + (quantity(drive, "to") - start) * (share - mp.sin(2 * mp.pi * share) / (2 * mp.pi))

    def time_of(self, crank):
        if self.drives[0].get("law", "constant") == "constant":
            return (crank - self.start) / quantity(self.drives[0], "speed")
        zero = quantity(self.drives[0], "zero", mpf(0))
        end = quantity(self.drives[0], "time")
        return mp.findroot(lambda t: self.law(0, t) - zero - crank, (mpf(0), end), solver="anderson", tol=1e-70)

    def sides(self, joint):
        names = joint.get("points", [joint.get("point", joint["name"])] * 2)
        return [(link, self.points[link][name]) for link, name in zip(joint["links"], names)]

    def at(self, q, link, local):
        if link == "ground":
            return local
        k = 3 * (self.links.index(link) - 1)
        c, s = mp.cos(q[k + 2]), mp.sin(q[k + 2])
        return q[k] + c * local[0] - s * local[1], q[k + 1] + s * local[0] + c * local[1]

    def angle(self, q, link):
        return mpf(0) if link == "ground" else q[3 * (self.links.index(link) - 1) + 2]

    def rows(self, q, t):
        """Residuals of joints, transmissions and drives."""
        rows = []
        for joint in self.joints:
            (first, a), (second, b) = self.sides(joint)
            a, b = self.at(q, first, a), self.at(q, second, b)
            if joint["type"] == "revolute":
                rows += [b[0] - a[0], b[1] - a[1]]
                continue
            along = self.angle(q, first) + quantity(joint, "axis")
            turn = self.angle(q, second) + quantity(joint, "second_axis", mpf(0)) - along
            turns = self.turns.setdefault(joint["name"], mp.nint(turn / (2 * mp.pi)))
            rows += [mp.cos(along) * (b[1] - a[1]) - mp.sin(along) * (b[0] - a[0]), turn - 2 * mp.pi * turns]
        rows += [own.row(q) for own in self.transmissions]
        return rows + [self.coordinate(q, index) - self.law(index, t) for index in range(len(self.drives))]

    def closed(self, q, t):
        n = len(q)
        for _ in range(60):
            r = self.rows(q, t)
            h = mpf(10) ** (-mp.dps // 2)
            jacobian = mp.matrix(n, n)
            for j in range(n):
                moved = list(q)
                moved[j] += h
                for i, value in enumerate(self.rows(moved, t)):
                    jacobian[i, j] = (value - r[i]) / h
            step = mp.lu_solve(jacobian, mp.matrix([-value for value in r]))
            q = [old + step[i] for i, old in enumerate(q)]
            if max(abs(value) for value in step) < mpf(10) ** (3 - mp.dps):
                return q
        raise ValueError("Newton's method does not converge")


def first_guess(binary, path, mechanism):
    """Pose at t = 0 from `linkproof solve`, in double precision."""
    command = [binary, "solve", path, "--with", "assur", "--times", "0"]
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    row = next(csv.DictReader(io.StringIO("".join(line + "\n" for line in out.splitlines() if not line.startswith("#")))))
    q = []
    for link in mechanism.links[1:]:
        angle, (cx, cy) = mpf(row[f"link.{link}.angle_rad"]), mechanism.body[link][1]
        c, s = mp.cos(angle), mp.sin(angle)
        q += [mpf(row[f"link.{link}.x_m"]) - c * cx + s * cy, mpf(row[f"link.{link}.y_m"]) - s * cx - c * cy, angle]
    return q


def check_modes(m, q):
    """Checks the modes of dyads by docs/scenario.md. Links that a driven joint connects count as one body."""
    driven = {drive["joint"] for drive in m.drives}
    for group in m.file["start"].get("groups", []):
        mode, parts = group.get("mode"), [[link] for link in group["links"]]
        for joint in m.joints:
            if joint["name"] in driven and set(joint["links"]) <= set(group["links"]):
                one, other = (part for part in parts if set(part) & set(joint["links"]))
                one += other
                parts.remove(other)
        if mode is None or len(parts) != 2:
            continue
        inside = lambda joint: [index for link in joint["links"] for index, part in enumerate(parts) if link in part]
        inner = next(joint for joint in m.joints if sorted(inside(joint)) == [0, 1])
        outer = [next(joint for joint in m.joints if inside(joint) == [index]) for index in (0, 1)]
        def spot(joint, part):
            return next(m.at(q, name, local) for name, local in m.sides(joint) if name in parts[part])
        a, b = (spot(joint, part) for part, joint in enumerate(outer))
        slides = [joint for joint in [inner, *outer] if joint["type"] == "prismatic"]
        if not slides:
            c = spot(inner, 0)
            side = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            assert (side > 0) == (mode == "left"), group
            continue
        joint = slides[0]
        along = m.angle(q, joint["links"][0]) + quantity(joint, "axis")
        if joint is inner:
            a, b = (spot(outer[part], part) for part in inside(joint))
        else:
            pin = 0 if outer[1] is joint else 1
            a, b = spot(outer[pin], pin), spot(inner, 0)
        ahead = mp.cos(along) * (b[0] - a[0]) + mp.sin(along) * (b[1] - a[1])
        assert (ahead > 0) == (mode == "ahead"), group


def clamped(points, x):
    """Cubic spline with zero slope at both ends, computed from its slopes at the points."""
    n = len(points)
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    a, r = mp.matrix(n, n), mp.matrix(n, 1)
    a[0, 0] = a[n - 1, n - 1] = mpf(1)
    for i in range(1, n - 1):
        before, after = xs[i] - xs[i - 1], xs[i + 1] - xs[i]
        a[i, i - 1], a[i, i], a[i, i + 1] = 1 / before, 2 / before + 2 / after, 1 / after
        r[i] = 3 * (ys[i] - ys[i - 1]) / before**2 + 3 * (ys[i + 1] - ys[i]) / after**2
    slopes = mp.lu_solve(a, r)
    i = max(k for k in range(n - 1) if k == 0 or xs[k] <= x)
    h = xs[i + 1] - xs[i]
    u = (x - xs[i]) / h
    return (
        (1 + 2 * u) * (1 - u) ** 2 * ys[i] + u * (1 - u) ** 2 * h * slopes[i]
        + u * u * (3 - 2 * u) * ys[i + 1] + u * u * (u - 1) * h * slopes[i + 1]
    )


def spline(points, period, x):
    """Periodic cubic spline."""
    n = len(points)
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    h = [(xs[(i + 1) % n] - xs[i]) % period if n > 1 else period for i in range(n)]
    a, r = mp.matrix(n, n), mp.matrix(n, 1)
    for i in range(n):
        before, after = h[i - 1], h[i]
        a[i, (i - 1) % n] += before
        a[i, i] += 2 * (before + after)
        a[i, (i + 1) % n] += after
        r[i] = 6 * ((ys[(i + 1) % n] - ys[i]) / after - (ys[i] - ys[i - 1]) / before)
    second = mp.lu_solve(a, r)
    for i in range(n):
        s = (x - xs[i]) % period
        if s < h[i]:
            u, v = h[i] - s, s
            m0, m1, y0, y1 = second[i], second[(i + 1) % n], ys[i], ys[(i + 1) % n]
            return (m0 * u**3 + m1 * v**3) / (6 * h[i]) + (y0 / h[i] - m0 * h[i] / 6) * u + (y1 / h[i] - m1 * h[i] / 6) * v


def course(load, stem, crank):
    if "table" not in load:
        return quantity(load, stem)
    period = 2 * mp.pi * load.get("turns", 1)
    points = [(quantity(row, "crank"), quantity(row, stem)) for row in load["table"]]
    if any(key in ("crank_m", "crank_mm") for key in load["table"][0]):
        # A table over a slide is linear between its points, and constant beyond its ends.
        after = [k for k, (x, _) in enumerate(points) if x <= crank]
        k = after[-1] if after else 0
        if not after or k + 1 == len(points):
            return points[k][1]
        (x, y), (xx, yy) = points[k], points[k + 1]
        return y + (yy - y) * (crank - x) / (xx - x)
    if load.get("interpolation", "linear") == "smooth":
        return spline(points, period, crank)
    n = len(points)
    for i, (x, y) in enumerate(points):
        width = points[i + 1][0] - x if i + 1 < n else points[0][0] + period - x
        s = (crank - x) % period
        if s < width:
            return y + (points[(i + 1) % n][1] - y) * s / width


def actions(m, q, v, twists, crank, sense=lambda number, omega: mp.sign(omega)):
    """Forces of all loads: link, force, place, moment."""
    def spot(link, point):
        at = m.at(q, link, m.points[link][point])
        if link == "ground":
            return at, (mpf(0), mpf(0))
        k = 3 * (m.links.index(link) - 1)
        return at, (v[k] - v[k + 2] * (at[1] - q[k + 1]), v[k + 1] + v[k + 2] * (at[0] - q[k]))
    def omega(link):
        return mpf(0) if link == "ground" else v[3 * (m.links.index(link) - 1) + 2]
    zero = (mpf(0), mpf(0))
    for number, load in enumerate(m.loads):
        kind = load["type"]
        if kind == "resistance":
            yield load["link"], zero, zero, -quantity(load, "moment") * sense(number, omega(load["link"]))
        elif kind == "moment":
            turning = omega(load["link"])
            acts = {"always": True, "counter-clockwise": turning > 0, "clockwise": turning < 0}[load.get("acts", "always")]
            yield load["link"], zero, zero, course(load, "moment", crank) if acts else mpf(0)
        elif kind == "force":
            x, y = course(load, "x", crank), course(load, "y", crank)
            if load.get("frame", "world") == "link":
                c, s = mp.cos(m.angle(q, load["link"])), mp.sin(m.angle(q, load["link"]))
                x, y = c * x - s * y, s * x + c * y
            yield load["link"], (x, y), spot(load["link"], load["point"])[0], mpf(0)
        elif kind == "resisting_force":
            at, velocity = spot(load["link"], load["point"])
            speed = mp.hypot(*velocity)
            yield load["link"], tuple(-quantity(load, "force") * own / speed for own in velocity), at, mpf(0)
        elif kind in ("spring", "damper"):
            (a, va), (b, vb) = (spot(*end) for end in zip(load["links"], load["points"]))
            d = (b[0] - a[0], b[1] - a[1])
            length = mp.hypot(*d)
            rate = ((vb[0] - va[0]) * d[0] + (vb[1] - va[1]) * d[1]) / length
            size = quantity(load, "stiffness") * (length - quantity(load, "free_length")) if kind == "spring" else quantity(load, "damping") * rate
            pull = (size * d[0] / length, size * d[1] / length)
            yield load["links"][0], pull, a, mpf(0)
            yield load["links"][1], (-pull[0], -pull[1]), b, mpf(0)
        elif kind.startswith("slide_"):
            joint = next(own for own in m.joints if own["name"] == load["joint"])
            (first, local), (second, other) = m.sides(joint)
            along = m.angle(q, first) + quantity(joint, "axis")
            axis, at, base = (mp.cos(along), mp.sin(along)), m.at(q, second, other), m.at(q, first, local)
            slide = axis[0] * (at[0] - base[0]) + axis[1] * (at[1] - base[1])
            rate = friction.rate(m, q, v, joint, quantity)
            acts = load.get("acts", "always")
            if kind == "slide_force":
                area = mp.pi * quantity(load, "bore") ** 2 / 4 if "pressure" in str(load) else None
                size = course(load, "pressure", crank) * area if area else course(load, "thrust", crank)
                size = size if acts == "always" or (rate > 0) == (acts == "extending") else mpf(0)
            elif kind == "slide_spring":
                stretch = slide - quantity(load, "free_slide")
                size = -quantity(load, "stiffness") * stretch if acts == "always" or (stretch > 0) == (acts == "beyond") else mpf(0)
            else:
                size = -quantity(load, "damping") * rate
            for link, sign in ((second, 1), (first, -1)):
                yield link, (sign * size * axis[0], sign * size * axis[1]), at, mpf(0)
        elif kind != "friction":
            first, second = load["links"]
            if kind == "torsion_spring":
                twist = m.angle(q, second) - m.angle(q, first) + twists[number]
                over, acts = twist - quantity(load, "free_angle"), load.get("acts", "always")
                moment = quantity(load, "stiffness") * over if acts == "always" or (over > 0) == (acts == "beyond") else mpf(0)
            else:
                moment = quantity(load, "damping") * (omega(second) - omega(first))
            yield first, zero, zero, moment
            yield second, zero, zero, -moment


def forces(m, q, v, a, loads):
    """Solves the Newton-Euler equations for joint forces (first link on second), slider moments, drives, transmissions.

    A flank can only push and a strand can only pull: if a force is negative, the other flank or strand is loaded.
    """
    for own in m.transmissions:
        own.sense = 1
    found = balance(m, q, v, a, loads)
    wrong = [own for own, force in zip(m.transmissions, found[3 * len(m.joints) + len(m.drives):]) if force < 0]
    for own in wrong:
        own.sense = -1
    return balance(m, q, v, a, loads) if wrong else found


def balance(m, q, v, a, loads):
    geared = 3 * len(m.joints) + len(m.drives)
    moving, n = m.links[1:], geared + len(m.transmissions)
    loads = loads + [(*own, mpf(0)) for transmission in m.transmissions for own in transmission.known(q)]
    rows, right = [], []
    def centre(link):
        return m.at(q, link, m.body[link][1])
    for link in moving:
        mass, _, inertia = m.body[link]
        k = 3 * (m.links.index(link) - 1)
        s = centre(link)
        r = (s[0] - q[k], s[1] - q[k + 1])
        alpha, square = a[k + 2], v[k + 2] ** 2
        acceleration = (a[k] - alpha * r[1] - square * r[0], a[k + 1] + alpha * r[0] - square * r[1])
        own = [[mpf(0)] * n for _ in range(3)]
        for j, joint in enumerate(m.joints):
            if link not in joint["links"]:
                continue
            sign = 1 if joint["links"][1] == link else -1
            second, local = m.sides(joint)[1]
            p = m.at(q, second, local)
            own[0][3 * j] += sign
            own[1][3 * j + 1] += sign
            own[2][3 * j] -= sign * (p[1] - s[1])
            own[2][3 * j + 1] += sign * (p[0] - s[0])
            own[2][3 * j + 2] += sign
        for d in range(len(m.drives)):
            for target, force, at, moment in m.efforts(q, d):
                if target == link:
                    own[0][3 * len(m.joints) + d] += force[0]
                    own[1][3 * len(m.joints) + d] += force[1]
                    own[2][3 * len(m.joints) + d] += moment + (at[0] - s[0]) * force[1] - (at[1] - s[1]) * force[0]
        for d, transmission in enumerate(m.transmissions):
            for target, force, at in transmission.efforts(q):
                if target == link:
                    own[0][geared + d] += force[0]
                    own[1][geared + d] += force[1]
                    own[2][geared + d] += (at[0] - s[0]) * force[1] - (at[1] - s[1]) * force[0]
        known = [mass * (acceleration[0] - m.gravity[0]), mass * (acceleration[1] - m.gravity[1]), inertia * alpha]
        for target, force, at, moment in loads:
            if target == link:
                known[0] -= force[0]
                known[1] -= force[1]
                known[2] -= moment + (at[0] - s[0]) * force[1] - (at[1] - s[1]) * force[0]
        rows += own
        right += known
    for j, joint in enumerate(m.joints):
        own = [mpf(0)] * n
        if joint["type"] == "revolute":
            own[3 * j + 2] = mpf(1)
        else:
            along = m.angle(q, joint["links"][0]) + quantity(joint, "axis")
            own[3 * j], own[3 * j + 1] = mp.cos(along), mp.sin(along)
        rows.append(own)
        right.append(mpf(0))
    return mp.lu_solve(mp.matrix(rows), mp.matrix(right))


def main():
    global ALL
    ALL = "--all" in sys.argv
    binary, path, *instants = (own for own in sys.argv[1:] if own != "--all")
    text = open(path).read()
    m = Mechanism(text)
    start = m.closed(first_guess(binary, path, m), mpf(0))
    check_modes(m, start)
    for own in m.transmissions:
        own.begin(start)
    twists = {}
    for number, load in enumerate(m.loads):
        if load["type"] == "torsion_spring":
            begun = m.angle(start, load["links"][1]) - m.angle(start, load["links"][0])
            twists[number] = -2 * mp.pi * mp.ceil((begun - mp.pi) / (2 * mp.pi))
    # Channels that `want` does not request are not printed.
    want = m.file.get("channels", {}).get("want", ["positions", "velocities", "accelerations", "reactions", "balancing_moment"])
    print_start(m, start)
    for instant in instants:
        is_time = instant.endswith("s")
        if is_time and any(drive.get("motion") == "free" for drive in m.drives):
            print_timed(m, start, twists, instant, want)
            continue
        is_slide = instant.endswith("mm")
        own = mpf(instant[:-2]) / 1000 if is_slide else 0 if is_time else mpf(instant) * mp.pi / 180
        t = mpf(instant[:-1]) if is_time else m.time_of(own)
        crank = m.law(0, t) - quantity(m.drives[0], "zero", mpf(0))
        mp.dps = 15
        # Steps of 0.03 rad or 5 mm.
        far = [abs(m.law(d, t) - m.law(d, mpf(0))) / (0.005 if m.kind(own) == "slide" else 0.03) for d, own in enumerate(m.drives)]
        steps = int(max(far)) + 1
        q = list(start)
        before = list(start)
        for k in range(1, steps + 1):
            guess = [2 * b - a for a, b in zip(before, q)]
            before, q = q, m.closed(guess, t * k / steps)
        mp.dps = 40
        h = mpf(10) ** -7 / abs(quantity(m.drives[0], "speed", mpf(10)))
        near = {k: m.closed(q, t + k * h) for k in (-2, -1, 0, 1, 2)}
        q = near[0]
        v = [(near[-2][i] - 8 * near[-1][i] + 8 * near[1][i] - near[2][i]) / (12 * h) for i in range(len(q))]
        a = [(-near[-2][i] + 16 * near[-1][i] - 30 * q[i] + 16 * near[1][i] - near[2][i]) / (12 * h * h) for i in range(len(q))]
        loads = list(actions(m, q, v, twists, crank))
        loads, f = friction.settled(m, q, v, loads, quantity, lambda own: forces(m, q, v, a, own))
        where, key = (f"{instant[:-1]} s", f"time_s = {instant[:-1]}") if is_time else (f"{instant} deg", f"crank_deg = {instant}")
        if is_slide:
            where, key = f"{instant[:-2]} mm", f"crank_mm = {instant[:-2]}"
        print_oracle(m, where, key, SOURCE + ", 40 digits", q, v, a, f, loads, want)


# If true, the program also prints numbers of points, sliders and the frame, as in tests/outside/scenarios.
ALL = False
SOURCE = "tests/outside/newton_euler.py: separate reader, closure and equations"


def print_timed(m, start, twists, instant, want):
    """Prints numbers at a time. The motion under forces is integrated; its reactions are then solved in 40 digits."""
    t = mpf(instant[:-1])
    source = f"{SOURCE}, integrated by tests/outside/free_motion.py"
    for rate in (100, 200, 400, 800, 1600, 3200):
        try:
            (q, v, a), change, signs = free_motion.at(m, quantity, actions, twists, start, t, rate)
        except ArithmeticError as error:
            # A motor without a rotor has a time constant of milliseconds; longer steps diverge.
            print(f"# {rate} steps a second: {error}", file=sys.stderr)
            continue
        print(f"# {rate} steps a second: half the step changes {change:.1e}", file=sys.stderr)
        if change < 2e-12:
            break
    else:
        raise ValueError("the integration does not converge")
    q, v, a = ([mpf(float(x)) for x in own] for own in (q, v, a))
    crank = m.coordinate(q, 0) - quantity(m.drives[0], "zero", mpf(0))
    loads = list(actions(m, q, v, twists, crank, lambda number, _: signs[number]))
    loads, f = friction.settled(m, q, v, loads, quantity, lambda own: forces(m, q, v, a, own), signs)
    # The effort of a free drive is known. The Newton-Euler equations, in other coordinates, must give the same effort.
    largest = max(abs(value) for value in f)
    for d, drive in enumerate(m.drives):
        if drive.get("motion") == "free":
            k = 3 * (m.links.index(m.driven(drive)) - 1) + 2
            torque, inertia, _ = free_motion.motor(m, quantity, float(v[k])) if d == 0 else (0.0, 0.0, 0.0)
            off = abs(f[3 * len(m.joints) + d] - (torque - inertia * a[k])) / largest
            print(f"# force or moment of {drive['joint']}: off by {mp.nstr(off, 3)} of the largest force", file=sys.stderr)
            assert off < 1e-11, off
    print_oracle(m, f"{instant[:-1]} s", f"time_s = {instant[:-1]}", source, q, v, a, f, loads, want)


def print_start(m, q):
    """Prints a distance at t = 0 between the driven link and the ground, which depends on the start of the drive."""
    link, joint = m.driven(m.drives[0]), m.joint(m.drives[0])
    turning = dict(m.sides(joint)) if m.kind(m.drives[0]) == "angle" else {}
    end = next((name for name, at in m.points[link].items() if at != turning.get(link) and name not in m.points["ground"]), None)
    others = (name for name, at in reversed(m.points["ground"].items()) if name not in m.points[link] and at != turning.get("ground"))
    other = next(others, None)
    if end is None or other is None:
        return
    a, b = m.at(q, link, m.points[link][end]), m.points["ground"][other]
    distance = mp.nstr(mp.nint(mp.hypot(a[0] - b[0], a[1] - b[1]) * 10**9) / mpf(10) ** 9, 20)
    print('\n[[oracle]]\nname = "start"\nbasis = "recomputed"')
    print('source = "tests/outside/newton_euler.py: separate reader"')
    print(f'figures = [{{ figure = "distance_m", points = ["{end}", "{other}"], value = {distance}, digits = 9 }}]')


def place_of(m, q, v, a, link, local):
    """Position, velocity and acceleration of a point of a link."""
    x, y = m.at(q, link, local)
    if link == "ground":
        return (x, y), (mpf(0), mpf(0)), (mpf(0), mpf(0))
    k = 3 * (m.links.index(link) - 1)
    r, omega, alpha = (x - q[k], y - q[k + 1]), v[k + 2], a[k + 2]
    return (
        (x, y),
        (v[k] - omega * r[1], v[k + 1] + omega * r[0]),
        (a[k] - alpha * r[1] - omega**2 * r[0], a[k + 1] + alpha * r[0] - omega**2 * r[1]),
    )


def shaking(m, q, f, loads):
    """Shaking force, and shaking moment about the origin, from joints, drives and loads."""
    x, y, moment = mpf(0), mpf(0), mpf(0)
    for j, joint in enumerate(m.joints):
        if "ground" in joint["links"]:
            sign = -1 if joint["links"][0] == "ground" else 1
            second, local = m.sides(joint)[1]
            at = m.at(q, second, local)
            x, y = x + sign * f[3 * j], y + sign * f[3 * j + 1]
            moment += sign * (at[0] * f[3 * j + 1] - at[1] * f[3 * j] + f[3 * j + 2])
    for d in range(len(m.drives)):
        effort = f[3 * len(m.joints) + d]
        loads = loads + [(link, (effort * u[0], effort * u[1]), at, effort * own) for link, u, at, own in m.efforts(q, d)]
    for t, own in enumerate(m.transmissions):
        size = f[3 * len(m.joints) + len(m.drives) + t]
        loads = loads + [(link, (size * u[0], size * u[1]), at, mpf(0)) for link, u, at in own.efforts(q)]
        loads = loads + [(*other, mpf(0)) for other in own.known(q)]
    for target, force, at, own in loads:
        if target == "ground":
            x, y = x + force[0], y + force[1]
            moment += own + at[0] * force[1] - at[1] * force[0]
    return x, y, moment


def print_oracle(m, where, key, source, q, v, a, f, loads, want):
    values = []
    def add(stage, channel, quantity_, value):
        if stage in want:
            values.append((channel, quantity_, value))
    for link in m.links[1:]:
        k = 3 * (m.links.index(link) - 1)
        s, velocity, acceleration = place_of(m, q, v, a, link, m.body[link][1])
        add("positions", f"link.{link}.angle_deg", "angle", q[k + 2] * 180 / mp.pi)
        add("velocities", f"link.{link}.omega_rad_s", "omega", v[k + 2])
        add("accelerations", f"link.{link}.alpha_rad_s2", "alpha", a[k + 2])
        add("positions", f"link.{link}.x_m", "place", s[0])
        add("positions", f"link.{link}.y_m", "place", s[1])
        add("velocities", f"link.{link}.vx_m_s", "velocity", velocity[0])
        add("velocities", f"link.{link}.vy_m_s", "velocity", velocity[1])
        add("accelerations", f"link.{link}.ax_m_s2", "acceleration", acceleration[0])
        add("accelerations", f"link.{link}.ay_m_s2", "acceleration", acceleration[1])
    seen = set(m.points["ground"])
    for link in m.links[1:]:
        for point, local in m.points[link].items():
            if point in seen or not ALL:
                continue
            seen.add(point)
            own = zip((("positions", "{}_m", "place"), ("velocities", "v{}_m_s", "velocity"), ("accelerations", "a{}_m_s2", "acceleration")),
                      place_of(m, q, v, a, link, local))
            for (stage, suffix, kind), values_ in own:
                for axis, value in zip("xy", values_):
                    add(stage, f"point.{point}." + suffix.format(axis), kind, value)
    for joint in m.joints:
        if joint["type"] != "prismatic" or not ALL:
            continue
        (first, local), (second, other) = m.sides(joint)
        begin, end = place_of(m, q, v, a, first, local), place_of(m, q, v, a, second, other)
        along = m.angle(q, first) + quantity(joint, "axis")
        spin = mpf(0) if first == "ground" else v[3 * (m.links.index(first) - 1) + 2]
        slide, speed, second_rate = ((e[0] - b[0]) * mp.cos(along) + (e[1] - b[1]) * mp.sin(along) for b, e in zip(begin, end))
        add("positions", f"joint.{joint['name']}.slide_m", "place", slide)
        add("velocities", f"joint.{joint['name']}.slide_speed_m_s", "velocity", speed)
        add("accelerations", f"joint.{joint['name']}.slide_acceleration_m_s2", "acceleration", second_rate + spin**2 * slide)
    for j, joint in enumerate(m.joints):
        add("reactions", f"joint.{joint['name']}.fx_N", "force", f[3 * j])
        add("reactions", f"joint.{joint['name']}.fy_N", "force", f[3 * j + 1])
        if joint["type"] == "prismatic":
            add("reactions", f"joint.{joint['name']}.moment_N_m", "moment", f[3 * j + 2])
    for joint, size, _ in friction.of(m, q, v, f, quantity):
        if joint is None:
            continue
        suffix, kind = ("friction_N_m", "moment") if joint["type"] == "revolute" else ("friction_N", "force")
        add("reactions", f"joint.{joint['name']}.{suffix}", kind, size)
    for t, own in enumerate(m.transmissions):
        add("reactions", f"transmission.{own.name}.force_N", "force", f[3 * len(m.joints) + len(m.drives) + t])
    if ALL:
        for name, kind, value in zip(("fx_N", "fy_N", "moment_N_m"), ("force", "force", "moment"), shaking(m, q, f, loads)):
            add("balancing_moment", f"frame.{name}", kind, value)
    for d, drive in enumerate(m.drives):
        if drive.get("motion") == "free" and (d > 0 or "motor" not in m.file):
            continue
        suffix, kind = ("force_N", "force") if m.kind(drive) == "slide" else ("torque_N_m", "moment")
        name = f"drive.{suffix}" if d == 0 else f"drive.{drive['joint']}.{suffix}"
        add("balancing_moment", name, kind, f[3 * len(m.joints) + d])
    largest = {}
    for _, kind, value in values:
        largest[kind] = max(largest.get(kind, mpf(0)), abs(value))
    print(f'\n[[oracle]]\nname = "Newton and Euler at {where}"\nbasis = "recomputed"')
    print(f'source = "{source}"')
    print(f"{key}\nvalues = [")
    for channel, kind, value in values:
        whole = int(mp.ceil(mp.log10(largest[kind]))) if largest[kind] > mpf(10) ** -20 else 0
        digits = max(0, min(12, 9 - whole))
        text = mp.nstr(mp.nint(value * mpf(10) ** digits) / mpf(10) ** digits, 20, min_fixed=-30, max_fixed=30)
        print(f'    {{ channel = "{channel}", value = {text}, digits = {digits} }},')
    print("]")


if __name__ == "__main__":
    main()
