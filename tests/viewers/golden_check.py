"""Checks the set of truths with its checker: golden_check.py LINKPROOF

Rapier's results must have order 2 where the speed is prescribed, MuJoCo's positions too, and Exudyn's motion and reactions everywhere.
A wrong inertia, a wrong length, a wrong column and a wrong unit must be seen."""

import csv
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent.parent
STEPS = (360, 720, 1440)
PRESCRIBED = ("double_crank", "six_bar_slider", "fourth_class")
POSITIONS = ("angles", "positions")
# For each engine: sorts of quantities whose order of convergence is checked, and this order under forces.
# At prescribed speed, the order is 2.
ENGINES = {
    "rapier": (POSITIONS, 1),
    "mujoco": (POSITIONS, 1),
    "exudyn": ((*POSITIONS, "velocities", "accelerations", "reactions"), 2),
}


def run(*words):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True).stdout


def need(condition, what):
    if not condition:
        sys.exit(f"golden: {what}")


def checked(place, name, results, *more):
    return run(sys.executable, place / "check.py", place / name, *[f"{step!r}={file}" for step, file in results], *more)


def simulated(linkproof, engine, place, name, step, file):
    """The result of an engine for a mechanism of the set."""
    if engine == "rapier":
        run(linkproof, "solve", place / name / f"{name}.toml", "--with", "rapier", "--dt", repr(step), "-o", file)
    else:
        run(sys.executable, TOP / f"examples/golden/{engine}_run.py", place / name, repr(step), file)
    return step, file


def orders(told):
    return {found[1]: float(found[2]) for found in re.finditer(r"^([a-z ]+): converges with order ([\d.]+)$", told, re.M)}


def changed(source, target, change):
    """A result with changed columns."""
    rows = list(csv.DictReader(source.open()))
    with target.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(change(dict(row)) for row in rows)
    return target


def main(linkproof):
    with tempfile.TemporaryDirectory() as directory:
        place = Path(directory, "set")
        run(linkproof, "golden", *PRESCRIBED, "swinging_parallelogram", "-o", place)
        for name in (*PRESCRIBED, "swinging_parallelogram"):
            times = [float(row["t_s"]) for row in csv.DictReader((place / name / "truth.csv").open())]
            # Steps that divide the intervals of the truth.
            steps = [(times[1] - times[0]) / math.ceil(count / (len(times) - 1)) for count in STEPS]
            for engine, (sorts, under_forces) in ENGINES.items():
                file = lambda step: Path(directory, f"{engine}_{name}_{step}.csv")
                all_results = [simulated(linkproof, engine, place, name, step, file(step)) for step in steps]
                picture = Path(directory, "errors.svg")
                found = orders(checked(place, name, all_results, "-o", picture))
                wanted = 2 if name in PRESCRIBED else under_forces
                near = [found.get(sort, 0) for sort in sorts]
                need(all(abs(order - wanted) < 0.15 for order in near), f"{name}, {engine}: orders {found}")
                need("<polyline" in picture.read_text(), f"{name}, {engine}: no curve is drawn")
                print(f"  ok     {name}, {engine}: {', '.join(f'{sort} {order:.2f}' for sort, order in sorted(found.items()))}")
        # A wrong moment of inertia changes the reactions, and leaves a prescribed motion as it is.
        name = "double_crank"
        numbers = json.loads((place / name / f"{name}.json").read_text())
        numbers["links"][2]["inertia_kg_m2"] *= 1.01
        wrong = Path(directory, "wrong", name)
        wrong.mkdir(parents=True)
        (wrong / f"{name}.json").write_text(json.dumps(numbers))
        # The crank turns once in 1 s.
        results = [simulated(linkproof, "exudyn", wrong.parent, name, 1.0 / count, wrong / f"{count}.csv") for count in STEPS[1:]]
        found = orders(checked(place, name, results))
        need("positions" in found and "reactions" not in found, f"{name}: a wrong inertia is not seen: {found}")
        # Faults: the checker tells their size.
        name, (step, good) = "double_crank", (1.0, place / "double_crank/truth.csv")
        exact = checked(place, name, [(step, good)])
        need(exact.count("as exact as the truth") == exact.count("largest error") > 5, f"the truth is not exact: {exact}")
        faults = {
            "angles": lambda row: {**row, "link.follower.angle_rad": float(row["link.follower.angle_rad"]) + 1e-6},
            "reactions": lambda row: {**row, "joint.B.fx_N": -float(row["joint.B.fx_N"])},
            "positions": lambda row: {**row, "point.B.x_m": 1e3 * float(row["point.B.x_m"])},
        }
        for sort, change in faults.items():
            told = checked(place, name, [(step, changed(good, Path(directory, "bad.csv"), change))])
            wrong = [line.split("  ")[1].strip() for line in told.splitlines() if "of the range" in line]
            need(wrong == [sort], f"a fault in {sort} is told as one in {wrong}: {told}")
        turned = lambda row: {**row, "link.follower.angle_rad": float(row["link.follower.angle_rad"]) + 6.283185307179586}
        told = checked(place, name, [(step, changed(good, Path(directory, "turned.csv"), turned))])
        need("of the range" not in told, f"a whole turn is an error: {told}")
        print("golden: orders of all engines, and faults in inertia, angles, reactions and units are found")


main(sys.argv[1])
