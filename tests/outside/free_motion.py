"""Motions under forces for newton_euler.py: double precision, numpy, no code of this project.

The state consists of the inputs of the free drives and their rates. Newton's method closes the pose. The accelerations
come from one linear system in the coordinates of the links' frames, with multipliers for every joint and for every
prescribed drive. newton_euler.py computes the forces afterwards in other coordinates. Modified midpoint steps are
extrapolated to order 12 (Gragg, Bulirsch, Stoer). A step ends where a link under a resistance reverses.
"""

import numpy as np
from mpmath import mp, mpf

COUNTS = (2, 4, 6, 8, 10, 12)


def motor(m, quantity, speed):
    """Static torque on the crank, inertia of motor and reducer reduced to the crank, and torque on the motor shaft."""
    motor = m.file.get("motor")
    if motor is None or m.drives[0].get("motion") != "free":
        return 0.0, 0.0, 0.0
    q = lambda key, default=None: float(quantity(motor, key, default))
    ratio, sense = motor["ratio"], np.sign(float(quantity(m.drives[0], "speed")))
    own, law = ratio * sense * speed, motor["law"]
    if law == "constant":
        torque = q("torque")
    elif law == "linear":
        torque = q("torque_at_rest") + q("slope") * own
    elif law == "table":
        points = [(float(quantity(row, "speed")), float(quantity(row, "torque"))) for row in motor["points"]]
        inner = [i for i in range(1, len(points) - 1) if points[i][0] <= own]
        (x0, y0), (x1, y1) = points[(inner or [0])[-1]:][:2]
        torque = y0 + (y1 - y0) * (own - x0) / (x1 - x0)
    else:
        assert law == "kloss", law
        full = q("synchronous_speed")
        slip = 1 - own / full
        at = motor["breakdown_slip"] if "breakdown_slip" in motor else 1 - q("breakdown_speed") / full
        torque = 2 * q("breakdown_torque") * slip * at / (slip * slip + at * at)
    inertia = (q("rotor_inertia", 0) + q("input_inertia", 0)) * ratio**2 + q("output_inertia", 0)
    inertia += q("intermediate_inertia", 0) * motor.get("intermediate_ratio", 0) ** 2
    return sense * motor.get("efficiency", 1) * ratio * torque, inertia, torque


class Motion:
    def __init__(self, m, quantity, actions, twists, steps_per_second):
        self.m, self.quantity, self.actions, self.twists = m, quantity, actions, twists
        self.rate = steps_per_second
        self.free = [d for d, drive in enumerate(m.drives) if drive.get("motion") == "free"]
        self.link = [m.links.index(m.driven(drive)) - 1 for drive in m.drives]
        self.kind = [m.kind(drive) for drive in m.drives]
        self.n = 3 * (len(m.links) - 1)
        self.body = [(float(mass), float(c[0]), float(c[1]), float(inertia)) for mass, c, inertia in (m.body[l] for l in m.links[1:])]
        self.joints = []
        for joint in m.joints:
            (first, a), (second, b) = m.sides(joint)
            ends = (m.links.index(first) - 1, complex(*map(float, a)), m.links.index(second) - 1, complex(*map(float, b)))
            slide = joint["type"] == "prismatic"
            axes = [float(quantity(joint, key, mpf(0))) for key in ("axis", "second_axis")] if slide else None
            self.joints.append((ends, axes, float(2 * mp.pi * m.turns.get(joint["name"], 0))))
        self.driven = [self.joints[m.joints.index(m.joint(drive))] for drive in m.drives]
        self.sense, self.rubbed = {}, []
        for number, load in enumerate(m.loads):
            assert "table" not in load or load.get("interpolation", "linear") == "smooth", "a linear table has knots"
            assert load["type"] != "resisting_force" and load.get("acts", "always") == "always", load
            if load["type"] == "resistance":
                self.sense[number] = lambda q, v, k=3 * (m.links.index(load["link"]) - 1) + 2: v[k]
            elif load["type"] == "friction":
                index = next(j for j, own in enumerate(m.joints) if own["name"] == load["joint"])
                self.sense[number] = lambda q, v, index=index: self.sliding(q, v, index)[0]
                self.rubbed.append((number, index, load["coefficient"], float(quantity(load, "radius", quantity(load, "length", mpf(0))))))
        self.motor_least = np.inf

    def rows(self, q, v):
        """Residuals of the joints, their Jacobian, and their second time derivatives for zero accelerations."""
        value, jacobian, bias = [], [], []
        spin = lambda link: (q[3 * link + 2], v[3 * link + 2]) if link >= 0 else (0.0, 0.0)
        for (i, a, j, b), axes, turns in self.joints:
            arm, at, speed, turning = {}, {}, {}, {}
            for end, (link, local) in enumerate(((i, a), (j, b))):
                angle, omega = spin(link)
                arm[end] = local * np.exp(1j * angle)
                at[end] = arm[end] + (complex(*q[3 * link:3 * link + 2]) if link >= 0 else 0)
                speed[end] = 1j * omega * arm[end] + (complex(*v[3 * link:3 * link + 2]) if link >= 0 else 0)
                turning[end] = -omega**2 * arm[end]
            gap, rate, second = at[1] - at[0], speed[1] - speed[0], turning[1] - turning[0]
            row = np.zeros((2, self.n))
            if axes is None:
                for end, link, sign in ((0, i, -1), (1, j, 1)):
                    if link >= 0:
                        k, d = 3 * link, 1j * arm[end]
                        row[0, k], row[1, k + 1], row[0, k + 2], row[1, k + 2] = sign, sign, sign * d.real, sign * d.imag
                value += [gap.real, gap.imag]
                bias += [second.real, second.imag]
            else:
                (angle, omega), (other, _) = spin(i), spin(j)
                along = np.exp(1j * (angle + axes[0]))
                across = 1j * along
                dot = lambda p, q: (p.conjugate() * q).real
                for end, link, sign in ((0, i, -1), (1, j, 1)):
                    if link >= 0:
                        k = 3 * link
                        row[0, k], row[0, k + 1] = sign * across.real, sign * across.imag
                        row[0, k + 2] = sign * dot(across, 1j * arm[end])
                        row[1, k + 2] = sign
                if i >= 0:
                    row[0, 3 * i + 2] -= dot(along, gap)
                value += [dot(across, gap), other + axes[1] - angle - axes[0] - turns]
                bias += [dot(across, second) - 2 * omega * dot(along, rate) - omega**2 * dot(across, gap), 0.0]
            jacobian.append(row)
        return np.array(value), np.vstack(jacobian), np.array(bias)

    def sliding(self, q, v, index):
        """Rate of a joint's coordinate; for a prismatic joint also its axis and the joint's point on the second link."""
        (i, a, j, b), axes, _ = self.joints[index]
        spin = lambda link: (q[3 * link + 2], v[3 * link + 2]) if link >= 0 else (0.0, 0.0)
        (angle, omega), (other, turning) = spin(i), spin(j)
        if axes is None:
            return turning - omega, None, None
        along, arm = np.exp(1j * (angle + axes[0])), b * np.exp(1j * other)
        at = arm + (complex(*q[3 * j:3 * j + 2]) if j >= 0 else 0)
        speed = 1j * turning * arm + (complex(*v[3 * j:3 * j + 2]) if j >= 0 else 0)
        if i >= 0:
            origin = complex(*q[3 * i:3 * i + 2])
            speed -= complex(*v[3 * i:3 * i + 2]) + 1j * omega * (at - origin)
        return (along.conjugate() * speed).real, along, at

    def friction(self, q, v, multipliers):
        """Forces of all joint frictions on the links, from the multipliers (reactions) of the joints."""
        force = np.zeros(self.n)
        for number, index, coefficient, length in self.rubbed:
            one, other = multipliers[2 * index:2 * index + 2]
            (i, _, j, _), axes, _ = self.joints[index]
            _, along, at = self.sliding(q, v, index)
            if axes is None:
                size = coefficient * length * np.hypot(one, other)
            elif length:
                size = coefficient * (abs(one / 2 + other / length) + abs(one / 2 - other / length))
            else:
                size = coefficient * abs(one)
            for link, sign in ((j, -self.signs[number]), (i, self.signs[number])):
                if link < 0:
                    continue
                k = 3 * link
                if axes is None:
                    force[k + 2] += sign * size
                else:
                    own, arm = sign * size * along, at - complex(*q[k:k + 2])
                    force[k:k + 3] += [own.real, own.imag, arm.real * own.imag - arm.imag * own.real]
        return force

    def inputs(self, q, v):
        """Inputs of the drives, their Jacobian, and their second time derivatives for zero accelerations."""
        value, jacobian, bias = [], np.zeros((len(self.kind), self.n)), []
        spin = lambda link: (q[3 * link + 2], v[3 * link + 2]) if link >= 0 else (0.0, 0.0)
        for kind, link, row, ((i, a, j, b), axes, turns) in zip(self.kind, self.link, jacobian, self.driven):
            if kind == "angle":
                row[3 * link + 2] = 1
                value.append(q[3 * link + 2])
                bias.append(0.0)
            elif kind == "turn":
                row[3 * j + 2], row[3 * i + 2] = 1, -1
                value.append(q[3 * j + 2] - q[3 * i + 2] - turns)
                bias.append(0.0)
            else:
                # The slide is measured in the axes of the first link, which rotates.
                angle, omega = spin(i)
                along, gap, rate, second = np.exp(1j * (angle + axes[0])), 0j, 0j, 0j
                dot = lambda p: (along.conjugate() * p).real
                for body, local, sign in ((j, b, 1), (i, a, -1)):
                    turn, speed = spin(body)
                    arm, k = local * np.exp(1j * turn), 3 * body
                    gap, rate, second = gap + sign * arm, rate + sign * 1j * speed * arm, second - sign * speed**2 * arm
                    if body >= 0:
                        gap, rate = gap + sign * complex(*q[k:k + 2]), rate + sign * complex(*v[k:k + 2])
                        row[k:k + 3] += [sign * along.real, sign * along.imag, sign * dot(1j * arm)]
                if i >= 0:
                    row[3 * i + 2] -= dot(1j * gap)
                value.append(dot(gap))
                bias.append(dot(second - 2j * omega * rate - omega**2 * gap))
        return np.array(value), jacobian, np.array(bias)

    def drives(self, t, y):
        """Inputs of the drives and their rates; second derivatives for prescribed drives, otherwise zero."""
        count, out = len(self.free), []
        for d, drive in enumerate(self.m.drives):
            if d in self.free:
                k = self.free.index(d)
                out.append((y[k], y[count + k], 0.0))
            elif drive.get("law", "constant") == "constant":
                out.append((float(self.m.law(d, mpf(0))) + float(self.quantity(drive, "speed")) * t, float(self.quantity(drive, "speed")), 0.0))
            else:
                # With 40 digits, the differences keep enough digits.
                h = mpf(10) ** -9
                before, now, after = (self.m.law(d, mpf(t) + k * h) for k in (-1, 0, 1))
                out.append((float(now), float((after - before) / (2 * h)), float((before - 2 * now + after) / h**2)))
        return out

    def pose(self, t, y, guess):
        """Coordinates and their rates."""
        drives, q, zero = self.drives(t, y), np.array(guess), np.zeros(self.n)
        for _ in range(30):
            value, jacobian, _ = self.rows(q, zero)
            measured, held, _ = self.inputs(q, zero)
            off = measured - [own[0] for own in drives]
            full = np.vstack([jacobian, held])
            step = np.linalg.solve(full, np.concatenate([value, off]))
            q -= step
            if np.max(np.abs(step)) < 1e-14 * max(1.0, np.max(np.abs(q))):
                break
        else:
            if not np.max(np.abs(step)) < 1e-12:
                raise ArithmeticError(f"no pose closes the joints at {t} s: the step is too long, or the mechanism is torn")
        v = np.linalg.solve(full, np.concatenate([np.zeros(len(value)), [own[1] for own in drives]]))
        return q, v

    def solved(self, t, y, guess):
        """Coordinates, rates and accelerations."""
        q, v = self.pose(t, y, guess)
        _, jacobian, bias = self.rows(q, v)
        mass, force = np.zeros((self.n, self.n)), np.zeros(self.n)
        for link, (m, cx, cy, inertia) in enumerate(self.body):
            k, (angle, omega) = 3 * link, (q[3 * link + 2], v[3 * link + 2])
            r = complex(cx, cy) * np.exp(1j * angle)
            mass[k:k + 3, k:k + 3] = [[m, 0, -m * r.imag], [0, m, m * r.real], [-m * r.imag, m * r.real, inertia + m * abs(r) ** 2]]
            g = complex(*map(float, self.m.gravity))
            force[k:k + 2] += [m * (g + omega**2 * r).real, m * (g + omega**2 * r).imag]
            force[k + 2] += m * (r.real * g.imag - r.imag * g.real)
        if self.m.loads:
            crank = self.inputs(q, v)[0][0] - float(self.quantity(self.m.drives[0], "zero", mpf(0)))
            of = lambda number, _: self.signs[number]
            for link, f, at, moment in self.actions(self.m, [mpf(x) for x in q], [mpf(x) for x in v], self.twists, mpf(crank), of):
                if link != "ground":
                    k = 3 * (self.m.links.index(link) - 1)
                    force[k:k + 2] += [float(f[0]), float(f[1])]
                    if f[0] or f[1]:
                        force[k + 2] += (float(at[0]) - q[k]) * float(f[1]) - (float(at[1]) - q[k + 1]) * float(f[0])
                    force[k + 2] += float(moment)
        k = 3 * self.link[0] + 2
        assert "motor" not in self.m.file or self.kind[0] == "angle"
        torque, inertia, own = motor(self.m, self.quantity, v[k])
        self.motor_least = min(self.motor_least, own)
        mass[k, k] += inertia
        force[k] += torque
        held = [d for d in range(len(self.link)) if d not in self.free]
        _, extra, own = self.inputs(q, v)
        wanted = np.array([second for _, _, second in self.drives(t, y)])
        jacobian, bias = np.vstack([jacobian, extra[held]]), np.concatenate([bias, (own - wanted)[held]])
        c = len(bias)
        # No scaling is needed: in SI, the rows of this matrix have similar sizes for these machines.
        full = np.block([[mass, jacobian.T], [jacobian, np.zeros((c, c))]])
        a = np.linalg.solve(full, np.concatenate([force, -bias]))
        for _ in range(100 if self.rubbed else 0):
            before, a = a, np.linalg.solve(full, np.concatenate([force + self.friction(q, v, a[self.n:]), -bias]))
            if np.max(np.abs(a - before)) <= 1e-14 * np.max(np.abs(a)):
                break
        return q, v, a[:self.n]

    def slope(self, t, y):
        count = len(self.free)
        q, v, a = self.solved(t, y, self.near + (t - self.when) * self.rates)
        _, jacobian, bias = self.inputs(q, v)
        return np.concatenate([y[count:], (jacobian @ a + bias)[self.free]])

    def step(self, t, y, h):
        table = []
        first = self.slope(t, y)
        for row, n in enumerate(COUNTS):
            s = h / n
            before, now = y, y + s * first
            for k in range(1, n):
                before, now = now, before + 2 * s * self.slope(t + k * s, now)
            table.append([0.5 * (before + now + s * self.slope(t + h, now))])
            for j in range(row):
                factor = (n / COUNTS[row - j - 1]) ** 2
                table[row].append(table[row][j] + (table[row][j] - table[row - 1][j]) / (factor - 1))
        return table[-1][-1]

    def at(self, start, end):
        """Coordinates, rates and accelerations at a time."""
        y = [float(self.m.coordinate(start, d)) for d in self.free]
        speeds = [float(self.quantity(self.m.drives[d], "initial_speed", mpf(0))) for d in self.free]
        y = np.array(y + speeds)
        t, q = 0.0, np.array([float(x) for x in start])
        _, v = self.pose(t, y, q)
        self.signs = {}
        if self.sense:
            if any(speeds):
                first = v
            elif "motor" in self.m.file:
                # A motor that starts from rest moves the links in its driving sense.
                ahead = np.array(list(y[:len(self.free)]) + [float(self.quantity(self.m.drives[d], "speed")) for d in self.free])
                _, first = self.pose(t, ahead, q)
            else:
                # From rest, the motion begins in the direction of the accelerations without resistances.
                self.signs = {number: 0.0 for number in self.sense}
                _, _, first = self.solved(t, y, q)
            self.signs = {number: float(np.sign(own(q, first))) for number, own in self.sense.items()}
        steps = max(1, int(np.ceil(end * self.rate)))
        left = [end / steps] * steps
        while left:
            self.when, self.near, self.rates = t, *self.pose(t, y, q)
            h = left.pop()
            def turned(h):
                moved = self.step(t, y, h)
                near, v = self.pose(t + h, moved, self.near + h * self.rates)
                return moved, {number: own(near, v) * self.signs[number] for number, own in self.sense.items()}
            moved, senses = turned(h)
            back = [number for number, own in senses.items() if own < 0 and h > 1e-14]
            if back:
                number, (low, high) = back[0], (0.0, h)
                f_low, f_high = None, senses[number]
                for _ in range(60):
                    middle = 0.5 * (low + high) if f_low is None else low + (high - low) * f_low / (f_low - f_high)
                    middle = min(max(middle, low + 0.01 * (high - low)), high - 0.01 * (high - low))
                    moved, senses = turned(middle)
                    if senses[number] < 0:
                        high, f_high = middle, senses[number]
                    else:
                        low, f_low = middle, senses[number]
                    if high - low < 1e-15 + 1e-13 * h:
                        break
                moved, senses = turned(high)
                left.append(h - high)
                h = high
                self.signs[number] = -self.signs[number]
            y, q, t = moved, self.near + h * self.rates, t + h
        q, _ = self.pose(t, y, q)
        return self.solved(t, y, q)


def at(m, quantity, actions, twists, start, end, rate):
    """Coordinates, rates and accelerations at a time, their relative change with half the step, and the senses of loads."""
    results = []
    for steps in (rate, 2 * rate):
        motion = Motion(m, quantity, actions, twists, steps)
        results.append(motion.at(start, float(end)))
    motor = m.file.get("motor", {})
    assert motor.get("efficiency", 1) == 1 or motion.motor_least > 0, "losses of a motor that brakes are not stated"
    change = max(float(np.max(np.abs(a - b)) / np.max(np.abs(b))) for a, b in zip(*results))
    return results[1], change, motion.signs
