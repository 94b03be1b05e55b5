"""Gear pairs, racks and belts for newton_euler.py, from the rolling of pitch circles and the strands of a belt.

A wheel turns against its carrier. What rolls off on one pitch circle rolls off on the other: that is one equation more
for the pose. Its force is one unknown more: a tangential force at the pitch point with the radial force of the flank
that carries it, or the pull of the strand that is tight. Which flank or strand that is follows from the sign.
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
        """Takes the phase, and the axles in the carrier, from the closed start pose."""
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
        if self.kind == "rack":
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
        gx, gy = self.m.at(q, *self.m.sides(self.guide)[0])
        way = (x - gx) * ex + (y - gy) * ey
        return gx + way * ex, gy + way * ey

    def rolled(self, q):
        """Arc on the second pitch circle or line that has not rolled off on the first."""
        turn = self.relative(q, self.first)
        if self.kind == "rack":
            (ex, ey), (x, y), (px, py) = self.axis(q), self.m.at(q, self.carrier, self.a), self.foot(q)
            (fx, fy), (sx, sy) = (self.m.at(q, *side) for side in self.m.sides(self.guide))
            slide = (sx - fx) * ex + (sy - fy) * ey
            moved = slide if self.guide["links"][1] == self.second else -slide
            # The pitch point of the pinion has the speed -(py - y), px - x for a unit turn.
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
        """A strand: where it leaves the first wheel, and its direction from the second wheel to the first."""
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
        """Forces that do not depend on what is transmitted: the tension of both strands."""
        if self.kind != "belt":
            return []
        slack = self.quantity(self.table, "slack", mpf(0))
        pulls = [self.pull(q, side) for side in (1, -1)]
        return [own for at, (x, y) in pulls for own in self.both((slack * x, slack * y), at)]

    def efforts(self, q):
        """Forces for a unit of what is transmitted, along the flank or strand that carries it: link, force, place."""
        if self.kind == "belt":
            at, (x, y) = self.pull(q, self.sense)
            return self.both((self.sense * x, self.sense * y), at)
        angle = self.quantity(self.table, "pressure_angle", mp.pi / 9)
        a = self.m.at(q, self.carrier, self.a)
        if self.kind == "rack":
            at, (tx, ty) = self.foot(q), self.axis(q)
            away = unit(at[0] - a[0], at[1] - a[1])
        else:
            b = self.m.at(q, self.carrier, self.b)
            ux, uy = unit(b[0] - a[0], b[1] - a[1])
            # A wheel in a ring touches it on the side of the other axle, or beyond its own.
            far = self.inside and self.radii[0] < self.radii[1]
            reach = -self.radii[0] if far else self.radii[0]
            at, (tx, ty) = (a[0] + reach * ux, a[1] + reach * uy), (-uy, ux)
            away = (-ux, -uy) if self.inside else (ux, uy)
        c, s = mp.cos(angle), self.sense * mp.sin(angle)
        return self.both((c * tx + s * away[0], c * ty + s * away[1]), at)
