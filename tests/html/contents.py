"""Compares loads and plans of a page with the scenario, `linkproof solve` and `linkproof plan`."""

import json
import math
import re
import subprocess
import tomllib
from pathlib import Path

from wrong import GO_TO, WITHIN, need

# Hollow arrows at the instant shown: name and path.
ARROWS = """
() => [...document.querySelectorAll('#loads > g:not(.hidden)')].map((own) => [own.dataset.name, own.querySelector('path').getAttribute('d')])
"""
# Vectors of a plan at the instant shown, by name.
VECTORS = """
(number) => {
    const now = planNow(number);
    return now.vectors.map(([name, part, from, to]) => [name, part, now.at[to][0] - now.at[from][0], now.at[to][1] - now.at[from][1]]);
}
"""
# Drawn vectors of the plan: name and line.
DRAWN = """
(number) => [...document.querySelectorAll('#plan-list svg')[number].querySelectorAll('.vector')].map((own) =>
    [own.querySelector('title').textContent.split(':')[0], own.querySelector('path').getAttribute('d').match(/-?[\\d.]+/g).map(Number)])
"""
SWEEP = 1.5 * math.pi
NUMBER = r"-?[\d.]+(?:e[-+]?\d+)?"


def show(tab, what):
    """Scrolls a part of the page into the window, because parts outside it are not redrawn at every instant."""
    if tab.locator(what).count():
        tab.locator(what).scroll_into_view_if_needed()
        tab.wait_for_timeout(100)


def numbers(text):
    return [float(own) for own in re.findall(NUMBER, text)]


# Sizes of units in SI, by the ending of a key; the longest ending counts.
UNITS = {"mm": 1e-3, "cm": 1e-2, "deg": math.pi / 180, "rpm": math.tau / 60, "g": 1e-3, "kN": 1e3, "N_mm": 1e3, "ms": 1e-3, "mm_s": 1e-3}
UNITS |= {own: 1.0 for own in ("m", "rad", "kg", "kg_m2", "N", "N_m", "m_s2", "m_s", "rad_s", "s", "N_m_s", "N_s_m", "N_m_rad")}


def split(key):
    """Name of a key without its unit, and size of the unit in SI; 0 if the key has no unit."""
    ends = [own for own in UNITS if key.endswith(f"_{own}")]
    longest = max(ends, key=len, default=None)
    return (key, 0.0) if longest is None else (key[: -len(longest) - 1], UNITS[longest])


def given_in(scenario):
    """The tables of a scenario file, with expressions of parameters replaced by their values."""
    read = tomllib.loads(Path(scenario).read_text())
    known = {}

    def computed(text, size):
        names = {own: value / (size or 1.0) if unit else value for own, (value, unit) in known.items()}
        plain = {"pi": math.pi, "sqrt": math.sqrt, "sin": math.sin, "cos": math.cos, "atan2": math.atan2, "acos": math.acos}
        named = re.sub(r"(?<![\w.])[A-Za-z_]\w*", lambda found: f"all_names[{found[0]!r}]", text.replace("^", "**"))
        return eval(named, {"__builtins__": {}, "all_names": plain | names})

    for key, value in read.get("parameters", {}).items():
        name, size = split(key)
        number = computed(value, size) if isinstance(value, str) else value
        known |= {key: (number, 0.0), name: (number * (size or 1.0), size)}

    def resolved(key, value):
        if isinstance(value, dict):
            return {own: resolved(own, inner) for own, inner in value.items()}
        if isinstance(value, list):
            return [resolved(key, inner) for inner in value]
        _, size = split(key)
        return computed(value, size) if size and isinstance(value, str) else value

    return {key: value if key in ("parameters", "formula", "oracle") else resolved(key, value) for key, value in read.items()}


def place_of(row, scenario, link, local):
    """World position (m) of a point of a link, from the angle and mass centre in the solution."""
    if link == "ground":
        return local
    centre = vector(scenario["links"][link].get("mass_centre", {"x_m": 0, "y_m": 0}))
    angle = float(row[f"link.{link}.angle_rad"])
    x, y = local[0] - centre[0], local[1] - centre[1]
    return (
        float(row[f"link.{link}.x_m"]) + math.cos(angle) * x - math.sin(angle) * y,
        float(row[f"link.{link}.y_m"]) + math.sin(angle) * x + math.cos(angle) * y,
    )


def vector(given):
    """A position in metres, given in any of the forms of a scenario."""
    return tuple(given[f"{axis}_m"] if f"{axis}_m" in given else given[f"{axis}_mm"] / 1e3 for axis in "xy")


def point_of(row, scenario, link, name):
    owner = scenario["ground"] if link == "ground" else scenario["links"][link]
    return place_of(row, scenario, link, vector(owner["points"][name]))


def forces_of(row, scenario):
    """By name: point of application (m) and vector (N) of all forces that the scenario gives as numbers."""
    found = {}
    gravity = scenario.get("gravity", {})
    gravity = (gravity.get("x_m_s2", 0), gravity.get("y_m_s2", 0))
    for link, own in scenario["links"].items():
        mass = own.get("mass_kg", 0)
        if mass > 0 and gravity != (0, 0):
            centre = (float(row[f"link.{link}.x_m"]), float(row[f"link.{link}.y_m"]))
            found[f"weight of {link}"] = (centre, (mass * gravity[0], mass * gravity[1]))
    for load in scenario.get("loads", []):
        if load["type"] == "force" and "x_N" in load and load["link"] != "ground":
            angle = float(row[f"link.{load['link']}.angle_rad"]) if load.get("frame") == "link" else 0
            x, y = load["x_N"], load["y_N"]
            force = (math.cos(angle) * x - math.sin(angle) * y, math.sin(angle) * x + math.cos(angle) * y)
            foot = point_of(row, scenario, load["link"], load["point"])
            found[f"force at {load['point']} on {load['link']}"] = (foot, force)
    return found


def springs_of(row, scenario):
    """By name: magnitude of the force (N) of each spring between points."""
    found = {}
    for load in scenario.get("loads", []):
        if load["type"] != "spring" or "stiffness_N_m" not in load or "free_length_mm" not in load:
            continue
        ends = [point_of(row, scenario, link, point) for link, point in zip(load["links"], load["points"])]
        told = [point if link == "ground" else f"{point} on {link}" for link, point in zip(load["links"], load["points"])]
        size = load["stiffness_N_m"] * (math.dist(*ends) - load["free_length_mm"] / 1e3)
        found[f"spring from {told[0]} to {told[1]}"] = size
    return found


def check_loads(tab, data, scenario, rows):
    """Checks that every load is drawn at its point, along its force, with its length by the scale."""
    if "loads" not in data:
        return
    given = given_in(scenario)
    motion, time = data["motion"], tab.evaluate("() => [...time]")
    unit, size = motion["unit"], motion["size"]
    scale, largest, moment = tab.evaluate("() => [loadScale, largestLoad, largestMoment]")
    show(tab, "#force-rows")
    met = 0
    for at in sorted({0, len(time) // 7, len(time) // 3, 5 * len(time) // 6}):
        row = rows.get(time[at])
        if row is None:
            continue
        tab.evaluate(GO_TO, at)
        drawn = dict(tab.evaluate(ARROWS))
        for name, (foot, force) in forces_of(row, given).items():
            if math.hypot(*force) * scale < 1:
                continue
            met += 1
            need(name in drawn, f"{name} is not drawn")
            told = numbers(drawn[name])
            corners = list(zip(told[::2], told[1::2]))
            own = [(corners[0][axis] + corners[6][axis]) / 2 for axis in (0, 1)]
            off = math.hypot(own[0] * unit - foot[0], -own[1] * unit - foot[1])
            need(off <= WITHIN * size, f"{name} begins {off:.1e} m away from its point at row {at}")
            apart = [(corners[3][0] - own[0]) / scale - force[0], -(corners[3][1] - own[1]) / scale - force[1]]
            need(math.hypot(*apart) <= WITHIN * largest, f"{name} is off by {math.hypot(*apart):.1e} N at row {at}")
        torque = float(row.get("drive.torque_N_m", "nan"))
        if len(data["loads"]["drives"]) > 0 and abs(torque) > 2e-3 * moment:
            met += 1
            name = data["loads"]["drives"][0]["name"]
            need(name in drawn, f"{name} is not drawn")
            told = numbers(drawn[name])
            # The path is `M x y A r r 0 long way x y`: an arc from the angle -45 deg to the tip of the moment's arrow.
            start, end, clockwise = told[:2], told[7:9], told[6]
            link, *local = data["loads"]["drives"][0]["on"]
            where = place_of(row, given, motion["links"][link - 1]["name"], local)
            turns = [math.atan2(-(y + where[1] / unit), x - where[0] / unit) for x, y in (start, end)]
            turn = (turns[1] - turns[0]) % math.tau if clockwise == 0 else -((turns[0] - turns[1]) % math.tau)
            apart = turn - SWEEP * torque / moment
            need(abs(apart) <= 1e-4, f"the arc of {name} has {turn:.6f} rad instead of {SWEEP * torque / moment:.6f}")
        told = dict(tab.evaluate("() => [...document.querySelectorAll('#force-rows tr')].map((own) => [own.cells[0].textContent, own.cells[1].textContent])"))
        for name, force in springs_of(row, given).items():
            met += 1
            need(name in told, f"{name} has no number")
            need(abs(numbers(told[name])[0] - abs(force)) <= 1e-3 * abs(force) + 1e-9, f"{name}: {told[name]}, not {force} N")
    loads = given.get("loads", [])
    need(met > 0 or not (loads or given.get("gravity")) or all("table" in own for own in loads), "no load was compared")


def check_plans(tab, data, linkproof, scenario):
    """Checks that vectors equal those of `linkproof plan`, and that all are drawn to one scale."""
    plans = data.get("plans", {}).get("plans", [])
    given = tomllib.loads(Path(scenario).read_text())
    drives = given["drive"] if isinstance(given["drive"], list) else [given["drive"]]
    if not plans or any(own.get("motion") == "free" for own in drives):
        return
    show(tab, "#plan-list")
    count = tab.evaluate("() => time.length")
    for at in sorted({count // 7, count // 3, 5 * count // 6}):
        tab.evaluate(GO_TO, at)
        when = tab.evaluate("() => time[shown.row]")
        made = subprocess.run([linkproof, "plan", scenario, f"--time={when!r}", "-o", "-"], capture_output=True, text=True)
        need(made.returncode == 0, made.stderr)
        right = json.loads(made.stdout)
        for number, plan in enumerate(plans):
            # The page leaves out the singular points of groups, which are fixed to no link.
            theirs = {own["name"]: (own["x"], own["y"]) for own in right[plan["word"]]["vectors"] if "Σ" not in own["name"]}
            vectors = tab.evaluate(VECTORS, number)
            ours = {name: (x, y) for name, _, x, y in vectors}
            largest = max(math.hypot(*own) for own in theirs.values())
            for name in theirs.keys() | ours.keys():
                apart = math.dist(theirs.get(name, (0, 0)), ours.get(name, (0, 0)))
                need(apart <= WITHIN * largest, f"{name} of the {plan['word']} plan is off by {apart:.1e} at row {at}")
            if tab.locator("#plan-list svg").count() <= number or largest == 0:
                continue
            drawn = {name: (line[2] - line[0], line[1] - line[3]) for name, line in tab.evaluate(DRAWN, number)}
            longest = max(drawn, key=lambda name: math.hypot(*drawn[name]))
            scale = math.hypot(*drawn[longest]) / math.hypot(*ours[longest])
            for name, line in drawn.items():
                apart = math.dist(line, [scale * own for own in ours[name]])
                need(apart < 0.2, f"{name} of the {plan['word']} plan is drawn {apart:.2f} off at row {at}")
            need("coriolis" not in {part for _, part, x, y in vectors if math.hypot(x, y) * scale > 1}
                 or any(name.endswith("^cor") for name in drawn), "no Coriolis part is drawn")
