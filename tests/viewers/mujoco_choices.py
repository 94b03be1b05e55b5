"""Prints the errors of other choices in the exported file, as in docs/mjcf.md.

usage: mujoco_choices.py LINKPROOF SCENARIO...

Errors are the largest differences from the analytic solution over one turn, divided by half the range of the channel.
"""

import re
import sys
import tempfile
import tomllib
from pathlib import Path

import mujoco
import numpy as np
from mujoco_check import FORCE, POSITION, STEPS, Scenario, distance, order_of, scales, simulate

INTEGRATORS = ("implicitfast", "Euler", "implicit", "discrete", "RK4")
# Gains of a velocity actuator (N m s/rad), divided by the rotor's inertia times the crank's speed.
GAINS = (1e-9, 1e-7, 1e-5, 1e-3)


def errors(scenario, model):
    """Largest error of positions and of forces at every number of steps."""
    rows = []
    for steps in STEPS:
        run = simulate(scenario, model, steps)
        scale = scales(scenario.solution, run)
        worst = {POSITION: 0.0, FORCE: 0.0}
        for channel, column in run.items():
            order = order_of(channel)
            error = distance(channel, column, scenario.solution[channel], int(order == FORCE)) / scale[channel]
            # A simulation that diverged has no number.
            worst[order] = max(worst[order], error if np.isfinite(error) else np.inf)
        rows.append(worst)
    return rows


def line(what, rows):
    """One line of a table."""
    parts = [" ".join(f"{row[order]:.1e}" for row in rows) for order in (POSITION, FORCE)]
    print(f"| {what} | {parts[0]} | {parts[1]} |")


def with_actuators(text, gain):
    """The file with velocity actuators in place of rotors; their control is the speed in the keyframe."""
    drives = re.findall(r'<joint name="([^"]*)"[^>]*armature="([^"]*)"', text)
    speeds = {}
    model = mujoco.MjModel.from_xml_string(text)
    for name, _ in drives:
        speeds[name] = float(model.key("start").qvel[model.joint(name).dofadr[0]])
    text = re.sub(r' armature="[^"]*"', "", text)
    actuator = lambda name, rotor: f'<velocity joint="{name}" kv="{gain * float(rotor) * abs(speeds[name])!r}"/>'
    text = text.replace("<sensor>", f"<actuator>{''.join(actuator(*drive) for drive in drives)}</actuator><sensor>")
    # Controls are in the order of the actuators.
    control = " ".join(repr(speeds[name]) for name, _ in drives)
    return text.replace("<key ", f'<key ctrl="{control}" ')


def without_mass(path, link):
    """Text of a scenario with one massless link, without the published numbers that depend on its mass."""
    text = Path(path).read_text()
    table = re.search(rf"(?m)^\[links\.{link}\]\n(.*?)(?=^\[)", text, re.S)
    text = text[: table.start(1)] + text[table.end(1) :]
    return text.split("[[oracle]]")[0]


def lent(linkproof, path):
    """Lines of a table: errors if a massless link gets a small mass in MuJoCo."""
    for link in tomllib.loads(Path(path).read_text())["links"]:
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory) / "lent.toml"
            file.write_text(without_mass(path, link))
            scenario = Scenario(linkproof, str(file))
        line(f"{link} without mass", errors(scenario, scenario.model))


def main(arguments):
    """Prints the tables."""
    if len(arguments) < 2:
        sys.exit(__doc__)
    linkproof, *paths = arguments
    for path in paths:
        scenario = Scenario(linkproof, path)
        print(f"\n{scenario.name}, {', '.join(map(str, STEPS))} steps a turn\n\n| choice | positions | forces and moments |\n|---|---|---|")
        for name in INTEGRATORS:
            text = scenario.text.replace('integrator="implicitfast"', f'integrator="{name}"')
            line(name, errors(scenario, mujoco.MjModel.from_xml_string(text)))
        for constant in (0.5, 1.0):
            text = scenario.text.replace('"1e-9 0.5"', f'"1e-9 {constant}"')
            line(f"damping ratio {constant}", errors(scenario, mujoco.MjModel.from_xml_string(text)))
        text = scenario.text.replace('solref="1e-9 0.5"', 'solref="0.02 1"').replace('"0.9999 0.9999 1"', '"0.9 0.95 0.001"')
        line("MuJoCo's own solref and solimp", errors(scenario, mujoco.MjModel.from_xml_string(text)))
        for integrator in ("implicitfast", "discrete"):
            for gain in GAINS:
                text = with_actuators(scenario.text, gain).replace('integrator="implicitfast"', f'integrator="{integrator}"')
                line(f"velocity actuator, gain {gain:g}, {integrator}", errors(scenario, mujoco.MjModel.from_xml_string(text)))
        lent(linkproof, path)


if __name__ == "__main__":
    main(sys.argv[1:])
