"""Proves every linkproof scenario of a folder as a separate pytest case. Standard library and pytest only.

LINKPROOF names the command (default: `linkproof`), SCENARIOS the folder (default: `scenarios` beside this file).
"""

import json
import os
import pathlib
import subprocess

import pytest

LINKPROOF = os.environ.get("LINKPROOF", "linkproof")
FOLDER = pathlib.Path(os.environ.get("SCENARIOS", pathlib.Path(__file__).parent / "scenarios"))
FILES = sorted(FOLDER.glob("*.toml"))

# Of the channels and checks that do not agree, at most this number is shown.
SHOWN = 5


def test_there_are_scenarios():
    assert FILES, f"no *.toml in {FOLDER}"


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_proven(file):
    command = [LINKPROOF, "run", str(file), "--no-record", "-o", "-"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    if not done.stdout:
        pytest.fail(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}", pytrace=False)
    document = json.loads(done.stdout)
    told = [failure(error) for error in document.get("errors", [])]
    told += [report(proof) for proof in document["runs"] if proof["verdict"] != "agree"]
    if told or done.returncode != 0:
        pytest.fail("\n".join(told) or done.stderr, pytrace=False)


def failure(error):
    """Message, location and remedy for a scenario that cannot be read or solved."""
    place = error["scenario"] if error["line"] is None else f"{error['scenario']}:{error['line']}"
    return f"{place}: {error['message']}" + (f"\nhelp: {error['help']}" if error["help"] else "")


def report(proof):
    """Verdict, worst channel or check, cause, and further channels that disagree or are inconclusive."""
    lines = [f"{proof['verdict'].upper()}: {proof['scenario']}, {proof['title']}"]
    found = sorted(not_agreeing(proof), key=used, reverse=True)
    if found:
        worst = found[0]
        # JSON has no infinite numbers and no NaN.
        bound = "a bound that is no number" if worst["bound"] is None else f"its bound {worst['bound']:.3e} {worst['unit']}"
        lines.append(f"worst: {worst['name']}, {used(worst):.3g} times {bound}")
    diagnosis = proof.get("diagnosis") or {}
    if diagnosis.get("cause"):
        lines.append(f"cause: {diagnosis['cause']}")
    lines += [f"- {own['name']}: {own['reason']}" for own in found[:SHOWN]]
    if len(found) > SHOWN:
        lines.append(f"- ... and {len(found) - SHOWN} more")
    return "\n".join(lines)


def not_agreeing(proof):
    """Channels and checks that disagree (or, if none disagrees, are inconclusive), each with a name and a value."""
    engines = proof["engines"]
    channels = [
        own | {"name": f"{own['channel']} ({engine['name']})", "value": own["max"]}
        for engine in engines
        for own in engine["channels"] + (engine.get("own_forces") or {}).get("channels", [])
    ]
    checks = proof["checks"] + [own for engine in engines for own in engine["checks"]]
    word = "disagree" if proof["verdict"] == "disagree" else "inconclusive"
    return [own for own in channels + checks if own["verdict"] == word]


def used(own):
    """Ratio of value to bound; entries without a number come first."""
    value, bound = own["value"], own["bound"]
    return value / bound if value is not None and bound else float("inf")
