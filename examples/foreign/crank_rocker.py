"""Data of the crank-rocker (m, kg, kg m2, N m), and its pose with the crank along +x."""

import math

GROUND = (0.15, 0.015)  # pivot C of the rocker, relative to pivot O of the crank
CRANK, COUPLER, ROCKER = 0.025995627740337, 0.34707193189181, 0.25
MASS = {"crank": 2.6, "coupler": 34.7, "rocker": 33.3}
INERTIA = {"crank": 0.00014641741001640535, "coupler": 0.8356, "rocker": 0.74}
RESISTANCE = 100.0  # on the rocker, against its rotation
SPEED = 130 * 2 * math.pi / 60


def start_angles():
    """Angles of coupler and rocker (rad) by the law of cosines; B is left of the line from A to C."""
    x, y = GROUND[0] - CRANK, GROUND[1]
    gap = math.hypot(x, y)
    coupler = math.atan2(y, x) + math.acos((COUPLER**2 + gap**2 - ROCKER**2) / (2 * COUPLER * gap))
    rocker = math.atan2(COUPLER * math.sin(coupler) - y, COUPLER * math.cos(coupler) - x)
    return coupler, rocker


def start_speeds(crank):
    """Angular velocities of coupler and rocker (rad/s), from v_A + w_coupler x AB = w_rocker x CB."""
    coupler, rocker = start_angles()
    across = math.sin(coupler - rocker)
    return (crank * CRANK * math.sin(rocker) / (COUPLER * across), crank * CRANK * math.sin(coupler) / (ROCKER * across))
