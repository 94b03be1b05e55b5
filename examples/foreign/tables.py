"""Reads a table of a foreign program by its mapping, and computes its errors against `linkproof solve` with numpy."""

import io
import math
import re
import subprocess
import tomllib
from dataclasses import dataclass

import numpy as np

FUNCTIONS = {name: getattr(np, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "abs", "sign")}
FUNCTIONS |= {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2, "ln": np.log, "pi": math.pi}
# For each other unit in names of channels: its SI unit, and how many of it make one SI unit.
UNITS = {"mm": ("m", 1e3), "deg": ("rad", 180 / math.pi)}
KINDS = (
    ("position", r"(^|\.)([xy]|slide)_m$"),
    ("angle", r"angle_rad$"),
    ("velocity", r"(v[xy]_m_s|omega_rad_s|slide_speed_m_s)$"),
    ("acceleration", r"(a[xy]_m_s2|alpha_rad_s2|slide_acceleration_m_s2)$"),
    ("reaction", r"joint\..*_N(_m)?$"),
    ("driving moment", r"torque_N_m$"),
)


def read(path):
    """Columns by name. Lines with # are comments; a table without names has the columns c1, c2, ..."""
    lines = [line for line in open(path).read().splitlines() if line and not line.startswith("#")]
    first = lines[0].split(",")
    try:
        [float(word) for word in first]
        names = [f"c{number}" for number in range(1, len(first) + 1)]
    except ValueError:
        names, lines = first, lines[1:]
    return dict(zip(names, np.loadtxt(lines, delimiter=",", ndmin=2).T))


def value(arithmetic, columns):
    if arithmetic in columns:
        return columns[arithmetic]
    known, text = dict(FUNCTIONS), arithmetic.replace("^", "**")
    for number, name in enumerate(sorted(columns, key=len, reverse=True)):
        known[f"column{number}"] = columns[name]
        text = text.replace(f"`{name}`", f"column{number}")
        text = re.sub(rf"(?<![\w.`]){re.escape(name)}(?![\w.`])", f"column{number}", text)
    return eval(text, {"__builtins__": {}}, known)  # the mappings are files of this repository


def mapped(path, mapping):
    """Key of the instants, the instants, and the channels in SI."""
    mapping, columns = tomllib.loads(open(mapping).read()), read(path)
    (how, at), = mapping["at"].items()
    channels = {}
    for name, arithmetic in mapping["channels"].items():
        base, unit = name.rsplit("_", 1)
        si, factor = UNITS.get(unit, (unit, 1.0))
        channels[f"{base}_{si}"] = value(arithmetic, columns) / factor
    return how, value(at, columns), channels


def exact(linkproof, scenario, how, at):
    """Analytic solution at the same instants."""
    option, factor = {"time_s": ("--times", 1.0), "crank_deg": ("--crank-deg", 1.0),
                      "crank_rad": ("--crank-deg", 180 / math.pi)}[how]
    listed = ",".join(repr(float(instant) * factor) for instant in at)
    solved = subprocess.run([linkproof, "solve", scenario, "--with", "assur", option, listed],
                            check=True, capture_output=True, text=True).stdout
    names, rows = solved.split("\n", 1)
    return dict(zip(names.split(","), np.loadtxt(io.StringIO(rows), delimiter=",", ndmin=2).T))


def kind(channel):
    return next(name for name, pattern in KINDS if re.search(pattern, channel))


def scales(found, names):
    """Scales of channels: half the range, but at least a thousandth of the largest scale with the same unit.

    For all quantities except positions and angles, the scale is also at least a tenth of the largest value.
    """
    scale = {name: np.ptp(found[name]) / 2 for name in names}
    for name in names:
        if kind(name) not in ("position", "angle"):
            scale[name] = max(scale[name], np.abs(found[name]).max() / 10)
    unit = lambda name: name.rsplit(".", 1)[1].split("_", 1)[1]
    return {name: max(own, 1e-3 * max(scale[other] for other in names if unit(other) == unit(name)))
            for name, own in scale.items()}


@dataclass
class Worst:
    """The worst channel of a kind: largest error, its fraction of the scale, and this fraction in the second half."""

    channel: str
    error: float
    share: float
    later: float


def errors(linkproof, scenario, path, mapping):
    """The worst channel of each kind."""
    how, at, channels = mapped(path, mapping)
    found = exact(linkproof, scenario, how, at)
    scale, worst = scales(found, channels), {}
    for name, values in channels.items():
        off = np.abs(values - found[name])
        now = Worst(name, off.max(), off.max() / scale[name], off[len(off) // 2:].max() / scale[name])
        worst[kind(name)] = max(worst.get(kind(name), now), now, key=lambda one: one.share)
    return worst
