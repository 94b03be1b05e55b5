#!/usr/bin/env python3
"""How far is a simulation from the truth, and with which order does it converge?

    python check.py crank_rocker 1e-3=coarse.csv 5e-4=fine.csv [-o errors.svg]

The first argument is a directory of this set, with truth.csv and bounds.csv.
A result is a CSV file with a header: t_s, and any columns of truth.csv under the same names, in the same units.
STEP= (s) before the name is needed for the order; without it, only the error of the result is printed.
Results may have their own instants: the truth is interpolated, by cubics with its rates where it has them."""
import csv
import math
import sys
from pathlib import Path

import numpy as np

RATES = {"angle_rad": "omega_rad_s", "omega_rad_s": "alpha_rad_s2", "slide_m": "slide_speed_m_s",
         "slide_speed_m_s": "slide_acceleration_m_s2", "x_m": "vx_m_s", "y_m": "vy_m_s", "vx_m_s": "ax_m_s2", "vy_m_s": "ay_m_s2"}
SORTS = {"angle_rad": "angles", "slide_m": "positions", "slide_speed_m_s": "velocities", "slide_acceleration_m_s2": "accelerations",
         "x_m": "positions", "y_m": "positions", "omega_rad_s": "angular velocities",
         "vx_m_s": "velocities", "vy_m_s": "velocities", "alpha_rad_s2": "angular accelerations", "ax_m_s2": "accelerations",
         "ay_m_s2": "accelerations", "fx_N": "reactions", "fy_N": "reactions", "moment_N_m": "reaction moments"}
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#999999"]


def read(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    if not rows or "t_s" not in rows[0]:
        sys.exit(f"{path}: no column t_s; the header has {', '.join(rows[0][:5]) if rows else 'nothing'}")
    numbers = np.array([[float(cell or "nan") for cell in row] for row in rows[1:]])
    order = np.argsort(numbers[:, rows[0].index("t_s")], kind="stable")
    return {name: numbers[order, k] for k, name in enumerate(rows[0])}


def at(times, truth, name, t=None, rows=slice(None)):
    """The truth of a column at other instants, from the given rows."""
    t, y = truth["t_s"][rows] if t is None else t[rows], truth[name][rows]
    base, last = name.rpartition(".")[::2]
    rate = truth.get(f"{base}.{RATES.get(last)}")
    k = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(t) - 2)
    h = t[k + 1] - t[k]
    s = np.where(h > 0, (times - t[k]) / np.where(h > 0, h, 1), 0)
    if rate is not None:
        d = rate[rows]
        return ((1 + 2 * s) * (1 - s) ** 2 * y[k] + s * s * (3 - 2 * s) * y[k + 1] + h * s * (1 - s) * ((1 - s) * d[k] - s * d[k + 1]))
    k = np.clip(k - 1, 0, max(len(t) - 4, 0))
    found = np.zeros(len(times))
    for i in range(min(4, len(t))):
        weight = np.ones(len(times))
        for j in range(min(4, len(t))):
            if j != i:
                weight *= (times - t[k + j]) / (t[k + i] - t[k + j])
        found += weight * y[k + i]
    return found


def apart(name, one, two):
    """Difference of two columns; of angles, without whole turns."""
    gap = one - two
    return (gap + math.pi) % (2 * math.pi) - math.pi if name.endswith("angle_rad") else gap


def errors(truth, bounds, result):
    """By sort of quantity: largest error as a share of the scale, the column, the error, its instant, and the floor."""
    t = result["t_s"]
    inside = (t >= truth["t_s"][0] - 1e-12) & (t <= truth["t_s"][-1] + 1e-12)
    # Between the rows of the truth, the error of the interpolation (order 4) counts too.
    is_on_rows = len(t) == len(truth["t_s"]) and np.allclose(t, truth["t_s"], rtol=0, atol=1e-12 * t[-1])
    found, curves = {}, {}
    for name in sorted(set(result) & set(bounds)):
        sort, (unit, bound) = SORTS.get(name.rpartition(".")[2], "driving moments and forces"), bounds[name]
        # The scale is half of the column's range. A range below a tenth of the largest range with the same unit is
        # replaced by this tenth.
        scale = max(np.ptp(truth[name]) / 2, max(np.ptp(truth[own]) for own in bounds if bounds[own][0] == unit) / 20) or 1.0
        gap = np.abs(apart(name, result[name][inside], at(t[inside], truth, name)))
        if not len(gap):
            sys.exit("no instant of the result lies within the truth")
        half = np.abs(apart(name, truth[name][1::2], at(truth["t_s"][1::2], truth, name, rows=slice(None, None, 2))))
        floor = (bound + (0 if is_on_rows else np.max(half[:-1], initial=0) / 16)) / scale
        worst = int(np.argmax(np.where(np.isnan(gap), np.inf, gap)))
        curves.setdefault(sort, []).append((t[inside], gap / scale))
        row = (gap[worst] / scale, name, gap[worst], t[inside][worst], floor, unit)
        found[sort] = max(found.get(sort, (-1,)), row)
    return found, curves


def drawn(lines, title, across, logarithmic):
    """Lines (name, x, y) as SVG, y on a logarithmic scale."""
    x = np.concatenate([own[1] for own in lines])
    y = np.concatenate([own[2] for own in lines])
    y = y[y > 0]
    low, high = (math.floor(math.log10(y.min())), math.ceil(math.log10(y.max()) + 1e-9)) if len(y) else (-16, 0)
    along = np.log10 if logarithmic else (lambda value: value)
    left, right = float(along(x).min()), float(along(x).max())
    px = lambda value: 70 + 520 * (along(value) - left) / ((right - left) or 1)
    py = lambda value: 380 - 340 * (np.log10(np.maximum(value, 10.0**low)) - low) / ((high - low) or 1)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 {440 + 18 * len(lines)}" font-family="sans-serif" font-size="13">'
           f'<rect width="100%" height="100%" fill="#fff"/><text x="70" y="24">{title}</text>']
    for power in range(low, high + 1):
        out.append(f'<path d="M70 {py(10.0**power):.1f}H590" stroke="#ddd"/><text x="62" y="{py(10.0**power) + 4:.1f}" text-anchor="end">1e{power}</text>')
    for value in sorted(set(x) if logarithmic else np.linspace(left, right, 5)):
        out.append(f'<text x="{px(value):.1f}" y="398" text-anchor="middle">{value:.3g}</text>')
    out.append(f'<text x="590" y="418" text-anchor="end">{across}</text>')
    for k, (name, xs, ys) in enumerate(lines):
        way = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(px(xs), py(ys)))
        colour, y0 = COLOURS[k % len(COLOURS)], 440 + 18 * k
        out.append(f'<polyline points="{way}" fill="none" stroke="{colour}" stroke-width="2"/>'
                   f'<path d="M70 {y0 - 4}h24" stroke="{colour}" stroke-width="2"/><text x="100" y="{y0}">{name}</text>')
    return "\n".join(out) + "\n</svg>\n"


def main(words):
    picture = words[words.index("-o") + 1] if "-o" in words[:-1] else None
    words = [word for k, word in enumerate(words) if word != "-o" and (k == 0 or words[k - 1] != "-o")]
    if len(words) < 2:
        sys.exit(__doc__)
    place = Path(words[0])
    truth = read(place / "truth.csv")
    with open(place / "bounds.csv", newline="") as file:
        bounds = {row["channel"]: (row["unit"], float(row["bound"])) for row in csv.DictReader(file)}
    runs = []
    for word in words[1:]:
        step, _, path = word.rpartition("=")
        runs.append((float(step) if step else None, path, *errors(truth, bounds, read(path))))
        if not runs[-1][2]:
            sys.exit(f"{path}: none of its columns is in {place / 'truth.csv'}")
    for step, path, found, _ in runs:
        print(f"\n{path}{'' if step is None else f', step {step:g} s'}")
        for sort, (share, name, error, when, floor, unit) in sorted(found.items()):
            told = "as exact as the truth" if share <= floor else f"{share:.2e} of the range"
            print(f"  {sort:26} {told}; largest error {error:.3e} {unit} in {name} at t = {when:.6g} s")
    steps = sorted((run for run in runs if run[0] is not None), key=lambda run: -run[0])
    for sort in sorted(set.intersection(*[set(run[2]) for run in steps])) if len(steps) > 1 else []:
        (coarse, first, _), (fine, second, floor) = [(run[0], run[2][sort][0], run[2][sort][4]) for run in steps[-2:]]
        if second <= floor:
            print(f"{sort}: as exact as the truth at the smallest step")
            continue
        order = math.log(first / second) / math.log(coarse / fine)
        print(f"{sort}: " + (f"converges with order {order:.2f}" if order > 0.3 else f"stays at {second:.1e} of the range"))
    if picture:
        title, share = f"{place.name}: error as a share of the range", lambda all_: np.max([gap for _, gap in all_], axis=0)
        if len(steps) > 1:
            lines = [(sort, np.array([run[0] for run in steps]), np.array([run[2][sort][0] for run in steps])) for sort in sorted(steps[0][2])]
        else:
            lines = [(sort, all_[0][0], share(all_)) for sort, all_ in sorted(runs[0][3].items())]
        Path(picture).write_text(drawn(lines, title, "step, s" if len(steps) > 1 else "t, s", len(steps) > 1))


main(sys.argv[1:])
