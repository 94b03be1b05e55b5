"""Gear pairs, racks, belts and cams for newton_euler.py: pitch circles that roll, strands, and lifts of followers.

Wheels turn relative to their carrier. Equal arcs roll off on both pitch circles, which is one more equation for the
pose. The transmitted force is one more unknown: a tangential force at the pitch point with the radial force of the
loaded flank, or the tension of the tight strand. The sign of the force selects the loaded flank or strand.
"""

from mpmath import mp, mpf


def unit(x, y):
    length = mp.hypot(x, y)
    return x / length, y / length


class Transmission:
    def __init__(self, m, table, quantity):
        self.m, self.table, self.name, self.quantity = m, table, table["name"], quantity
        (self.first, self.second), self.carrier = table["links"], table.get("carrier", "ground")
        self.kind = table["type"]
        own = (joint for joint in m.joints if set(joint["links"]) == {self.second, self.carrier})
        name = table.get("start_joint") or next(own)["name"]
        self.joint = next(joint for joint in m.joints if joint["name"] == name)
        self.begun, self.sense = None, 1

    def begin(self, q):
        """Determines the phase and the positions of the axles on the carrier from the closed start pose."""
        m = self.m
        spots = [(joint, link, m.at(q, link, local)) for joint in m.joints if joint["type"] == "revolute" for link, local in m.sides(joint)]
        def axle(link):
            for own, on, place in spots:
                if on == link:
                    for other, carrier, spot in spots:
                        if carrier == self.carrier and mp.hypot(place[0] - spot[0], place[1] - spot[1]) < mpf(10) ** -20:
                            return dict(m.sides(other))[self.carrier]
            raise ValueError(f"{link} has no axle on {self.carrier}")
        self.a = axle(self.first)
        if self.kind in ("rack", "screw"):
            self.guide = next(joint for joint in m.joints if joint["type"] == "prismatic" and set(joint["links"]) == {self.second, self.carrier})
        else:
            self.b = axle(self.second)
            distance = mp.hypot(self.b[0] - self.a[0], self.b[1] - self.a[1])
            if self.kind == "gears":
                one, other = (mpf(str(teeth)) for teeth in self.table["teeth"])
                self.inside = self.table.get("contact") == "internal"
                scale = distance / (abs(one - other) if self.inside else one + other)
                self.radii = one * scale, other * scale
            else:
                scale, radii = (1000, table_mm) if (table_mm := self.table.get("radii_mm")) else (1, self.table["radii_m"])
                self.radii = [mpf(str(own)) / scale for own in radii]
        self.begun = self.rolled(q)

    def relative(self, q, link):
        return self.m.angle(q, link) - self.m.angle(q, self.carrier)

    def axis(self, q):
        first = self.guide["links"][0]
        along = self.m.angle(q, first) + self.quantity(self.guide, "axis")
        return mp.cos(along), mp.sin(along)

    def foot(self, q):
        """The pitch point of a rack: where the normal through the axle meets the line of the guide."""
        (ex, ey), (x, y) = self.axis(q), self.m.at(q, self.carrier, self.a)
        if self.kind == "screw":
            radius = self.quantity(self.table, "lead") / (2 * mp.pi)
            return x + radius * ey, y - radius * ex
        gx, gy = self.m.at(q, *self.m.sides(self.guide)[0])
        way = (x - gx) * ex + (y - gy) * ey
        return gx + way * ex, gy + way * ey

    def rolled(self, q):
        """Difference of the arcs on the second pitch circle or line and on the first."""
        turn = self.relative(q, self.first)
        if self.kind in ("rack", "screw"):
            (ex, ey), (x, y), (px, py) = self.axis(q), self.m.at(q, self.carrier, self.a), self.foot(q)
            (fx, fy), (sx, sy) = (self.m.at(q, *side) for side in self.m.sides(self.guide))
            slide = (sx - fx) * ex + (sy - fy) * ey
            moved = slide if self.guide["links"][1] == self.second else -slide
            # The velocity of the pinion at the pitch point is (-(py - y), px - x) per unit of angular velocity.
            return moved - turn * (-(py - y) * ex + (px - x) * ey)
        same = self.inside if self.kind == "gears" else self.table.get("strands") != "crossed"
        return self.radii[1] * self.relative(q, self.second) + (-1 if same else 1) * self.radii[0] * turn

    def row(self, q):
        if self.begun is not None:
            return self.rolled(q) - self.begun
        first, second = self.joint["links"]
        start = self.quantity(self.table, "start")
        if self.joint["type"] == "prismatic":
            a, b = (self.m.at(q, *side) for side in self.m.sides(self.joint))
            along = self.m.angle(q, first) + self.quantity(self.joint, "axis")
            return (b[0] - a[0]) * mp.cos(along) + (b[1] - a[1]) * mp.sin(along) - start
        turn = self.m.angle(q, second) - self.m.angle(q, first) - start
        return turn - 2 * mp.pi * mp.nint(turn / (2 * mp.pi))

    def pull(self, q, side):
        """A strand: the point where it leaves the first wheel, and its direction from the second wheel to the first."""
        a, b = self.m.at(q, self.carrier, self.a), self.m.at(q, self.carrier, self.b)
        (ux, uy), distance = unit(b[0] - a[0], b[1] - a[1]), mp.hypot(b[0] - a[0], b[1] - a[1])
        crossed = self.table.get("strands") == "crossed"
        lean = mp.acos((self.radii[0] + (1 if crossed else -1) * self.radii[1]) / distance) * side
        nx, ny = ux * mp.cos(lean) - uy * mp.sin(lean), uy * mp.cos(lean) + ux * mp.sin(lean)
        at = a[0] + self.radii[0] * nx, a[1] + self.radii[0] * ny
        second = (-1 if crossed else 1) * self.radii[1]
        return at, unit(at[0] - b[0] - second * nx, at[1] - b[1] - second * ny)

    def both(self, force, at):
        return [(self.second, force, at), (self.first, (-force[0], -force[1]), at)]

    def known(self, q):
        """Forces that do not depend on the transmitted force: the tension of the slack strand, in both strands."""
        if self.kind != "belt":
            return []
        slack = self.quantity(self.table, "slack", mpf(0))
        pulls = [self.pull(q, side) for side in (1, -1)]
        return [own for at, (x, y) in pulls for own in self.both((slack * x, slack * y), at)]

    def efforts(self, q):
        """Forces for a unit of the transmitted force, along the loaded flank or strand: link, force, place."""
        if self.kind == "belt":
            at, (x, y) = self.pull(q, self.sense)
            return self.both((self.sense * x, self.sense * y), at)
        angle = mpf(0) if self.kind == "screw" else self.quantity(self.table, "pressure_angle", mp.pi / 9)
        a = self.m.at(q, self.carrier, self.a)
        if self.kind in ("rack", "screw"):
            at, (tx, ty) = self.foot(q), self.axis(q)
            away = unit(at[0] - a[0], at[1] - a[1])
        else:
            b = self.m.at(q, self.carrier, self.b)
            ux, uy = unit(b[0] - a[0], b[1] - a[1])
            # A wheel touches its ring gear on the side away from the ring's axle.
            # From the ring's axle, the contact lies beyond the wheel's axle.
            far = self.inside and self.radii[0] < self.radii[1]
            reach = -self.radii[0] if far else self.radii[0]
            at, (tx, ty) = (a[0] + reach * ux, a[1] + reach * uy), (-uy, ux)
            away = (-ux, -uy) if self.inside else (ux, uy)
        c, s = mp.cos(angle), self.sense * mp.sin(angle)
        return self.both((c * tx + s * away[0], c * ty + s * away[1]), at)


    def losses(self, q, v, force):
        """Moments on the first member and the carrier that dissipate the lost power: link, force, place, moment."""
        forward = mpf(str(self.table.get("efficiency", 1)))
        back = mpf(str(self.table.get("efficiency_back", forward)))
        if forward == back == 1:
            return []
        def velocity(link, at):
            if link == "ground":
                return mpf(0), mpf(0), mpf(0)
            k = 3 * (self.m.links.index(link) - 1)
            return v[k] - v[k + 2] * (at[1] - q[k + 1]), v[k + 1] + v[k + 2] * (at[0] - q[k]), v[k + 2]
        power = mpf(0)
        for link, (x, y), at in self.efforts(q):
            if link == self.second:
                (ux, uy, _), (cx, cy, _) = velocity(link, at), velocity(self.carrier, at)
                power += force * (x * (ux - cx) + y * (uy - cy))
        lost = power * (1 / forward - 1) if power > 0 else -power * (1 - back)
        spin = velocity(self.first, (0, 0))[2] - velocity(self.carrier, (0, 0))[2]
        moment = -lost / spin if spin else mpf(0)
        return [(self.first, (mpf(0), mpf(0)), (mpf(0), mpf(0)), moment), (self.carrier, (mpf(0), mpf(0)), (mpf(0), mpf(0)), -moment)]


class Cam(Transmission):
    """A cam: the follower's coordinate on the carrier is the lift at the cam's angle plus a constant."""

    def begin(self, q):
        self.flat = self.table.get("follower") == "flat"
        self.slides = self.joint["type"] == "prismatic"
        pin = next(joint for joint in self.m.joints if set(joint["links"]) == {self.first, self.carrier})
        self.a = dict(self.m.sides(pin))[self.carrier]
        self.begun = self.rolled(q)

    def lift(self, turn):
        if "formula" in self.table:
            return self.value(self.table["formula"], phi=turn)
        if "lifts" in self.table:
            return self.spline([(self.quantity(row, "angle"), self.quantity(row, "lift")) for row in self.table["lifts"]], 2 * mp.pi, turn)
        turn = turn - 2 * mp.pi * mp.floor(turn / (2 * mp.pi))
        begun, low = mpf(0), mpf(0)
        for piece in self.table["motion"]:
            end = self.quantity(piece, "to")
            high = self.quantity(piece, "lift", low)
            if turn <= end:
                return low + (high - low) * curve(piece.get("law", "cycloidal"), (turn - begun) / (end - begun))
            begun, low = end, high
        raise ValueError("the law does not reach a turn")

    def coordinate(self, q):
        first, second = self.joint["links"]
        if not self.slides:
            return self.m.angle(q, second) - self.m.angle(q, first)
        a, b = (self.m.at(q, *side) for side in self.m.sides(self.joint))
        along = self.m.angle(q, first) + self.quantity(self.joint, "axis")
        return (b[0] - a[0]) * mp.cos(along) + (b[1] - a[1]) * mp.sin(along)

    def rolled(self, q):
        return self.coordinate(q) - self.lift(self.relative(q, self.first))

    def way(self, q):
        """The follower's point, and its velocity relative to the carrier per unit rate of the follower's coordinate."""
        at = self.m.at(q, self.second, self.m.points[self.second][self.table["point"]])
        sense = 1 if self.joint["links"][1] == self.second else -1
        if self.slides:
            along = self.m.angle(q, self.joint["links"][0]) + self.quantity(self.joint, "axis")
            return at, (sense * mp.cos(along), sense * mp.sin(along))
        pivot = self.m.at(q, *next(side for side in self.m.sides(self.joint) if side[0] == self.second))
        return at, (-sense * (at[1] - pivot[1]), sense * (at[0] - pivot[0]))

    def efforts(self, q):
        (x, y), (wx, wy) = self.way(q)
        ax, ay = self.m.at(q, self.carrier, self.a)
        turn, h = self.relative(q, self.first), mpf(10) ** -12
        rate = (self.lift(turn + h) - self.lift(turn - h)) / (2 * h)
        if self.flat:
            nx, ny = unit(wx, wy)
            if nx * (x - ax) + ny * (y - ay) < 0:
                nx, ny = -nx, -ny
            # At the contact point, cam and face have equal velocities along the normal of the face.
            side = -rate * (nx * wx + ny * wy)
            reach = nx * (x - ax) + ny * (y - ay)
            at = ax + reach * nx - side * ny, ay + reach * ny + side * nx
            return self.both((nx, ny), at)
        # Tangent of the path that the point describes on the cam, and its normal away from the axle.
        tx, ty = unit(rate * wx + (y - ay), rate * wy - (x - ax))
        nx, ny = (ty, -tx) if ty * (x - ax) - tx * (y - ay) > 0 else (-ty, tx)
        return self.both((nx, ny), (x, y))


def curve(law, x):
    if law == "cycloidal":
        return x - mp.sin(2 * mp.pi * x) / (2 * mp.pi)
    if law == "3-4-5":
        return 10 * x**3 - 15 * x**4 + 6 * x**5
    if law == "4-5-6-7":
        return 35 * x**4 - 84 * x**5 + 70 * x**6 - 20 * x**7
    assert law == "modified-sine", law
    if x < mpf(1) / 8 or x > mpf(7) / 8:
        return (mp.pi * x - mp.sin(4 * mp.pi * x) / 4 + (4 if x > 0.5 else 0)) / (4 + mp.pi)
    return (2 + mp.pi * x - 9 * mp.sin((4 * mp.pi * x + mp.pi) / 3) / 4) / (4 + mp.pi)


def of(m, table, quantity, value, spline):
    own = (Cam if table["type"] == "cam" else Transmission)(m, table, quantity)
    own.value, own.spline = value, spline
    return own
