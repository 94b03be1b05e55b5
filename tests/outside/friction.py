"""Friction of joints and losses of transmissions for newton_euler.py: fixed-point iteration in 40 digits."""

from mpmath import mp, mpf

# Changes below this fraction of the largest force end the iteration.
SETTLED = mpf(10) ** -35


def of(m, q, v, f, quantity, signs=None):
    """Frictions for the reactions f: the joint (None for a transmission), its friction on the second link, and the actions.

    An action is a link, a force, its point of application, and a moment.
    """
    found = []
    for number, load in enumerate(m.loads):
        if load["type"] != "friction":
            continue
        j, joint = next((j, own) for j, own in enumerate(m.joints) if own["name"] == load["joint"])
        first, second = joint["links"]
        x, y, moment = f[3 * j : 3 * j + 3]
        sense = signs[number] if signs else mp.sign(rate(m, q, v, joint, quantity))
        if joint["type"] == "revolute":
            size = -sense * mpf(str(load["coefficient"])) * quantity(load, "radius") * mp.hypot(x, y)
            zero = (mpf(0), mpf(0))
            actions = [(second, zero, zero, size), (first, zero, zero, -size)]
        else:
            along = m.angle(q, first) + quantity(joint, "axis")
            axis = (mp.cos(along), mp.sin(along))
            across = axis[0] * y - axis[1] * x
            length = quantity(load, "length")
            ends = [across] if not length else [across / 2 + moment / length, across / 2 - moment / length]
            size = -sense * mpf(str(load["coefficient"])) * sum(abs(own) for own in ends)
            at = m.at(q, *m.sides(joint)[1])
            actions = [(link, (sign * size * axis[0], sign * size * axis[1]), at, mpf(0)) for link, sign in ((second, 1), (first, -1))]
        found.append((joint, size, actions))
    for t, own in enumerate(m.transmissions):
        force = f[3 * len(m.joints) + len(m.drives) + t]
        if actions := own.losses(q, v, force):
            found.append((None, actions[0][3], actions))
    return found


def rate(m, q, v, joint, quantity):
    """Rate of a joint's coordinate."""
    def spin(link):
        return mpf(0) if link == "ground" else v[3 * (m.links.index(link) - 1) + 2]
    def velocity(link, at):
        if link == "ground":
            return mpf(0), mpf(0)
        k = 3 * (m.links.index(link) - 1)
        return v[k] - v[k + 2] * (at[1] - q[k + 1]), v[k + 1] + v[k + 2] * (at[0] - q[k])
    first, second = joint["links"]
    if joint["type"] == "revolute":
        return spin(second) - spin(first)
    # Velocity of the block relative to the guide, at the block's point.
    at = m.at(q, *m.sides(joint)[1])
    along = m.angle(q, first) + quantity(joint, "axis")
    one, other = velocity(first, at), velocity(second, at)
    return mp.cos(along) * (other[0] - one[0]) + mp.sin(along) * (other[1] - one[1])


def settled(m, q, v, loads, quantity, forces, signs=None):
    """The loads with friction, and the reactions that they cause; `forces` computes reactions from loads."""
    f = forces(loads)
    for _ in range(400):
        actions = [own for _, _, all in of(m, q, v, f, quantity, signs) for own in all]
        before, f = f, forces(loads + actions)
        if max(abs(a - b) for a, b in zip(f, before)) <= SETTLED * max(abs(own) for own in f):
            return loads + actions, f
    raise ValueError("the friction does not settle")
