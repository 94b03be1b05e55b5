"""Shared fixtures. The tests use the installed package, not the sources."""

import os
import pathlib
import subprocess
import sys
import threading
import time

import linkproof
import numpy as np
import pytest

pytest_plugins = ["pytester"]

TOP = pathlib.Path(__file__).resolve().parents[2]
#: The command that the wheel has installed.
COMMAND = pathlib.Path(sys.prefix) / "bin" / "linkproof"

# A package beside the tests would hide the wheel.
assert pathlib.Path(linkproof.__file__).is_relative_to(sys.prefix), linkproof.__file__


def run(*words, command=COMMAND, **options):
    """Run the command; the output is text."""
    return subprocess.run([command, *map(str, words)], capture_output=True, encoding="utf-8", timeout=120, **options)


def commands():
    """The command of the wheel and, if LINKPROOF names it, the command that cargo has built."""
    built = os.environ.get("LINKPROOF")
    return [COMMAND, built] if built else [COMMAND]


def assert_others_run(work, least):
    """Check that other threads of Python run during `work`, which takes more than `least` seconds."""
    done, ticks = threading.Event(), []

    def task():
        try:
            work()
        finally:
            done.set()

    thread = threading.Thread(target=task)
    began = time.perf_counter()
    thread.start()
    while not done.is_set():
        ticks.append(time.perf_counter())
        time.sleep(1e-3)
    thread.join()
    took = ticks[-1] - began
    assert took > least, "too fast to tell anything"
    # With the lock held, this thread would stand still for nearly the whole time.
    longest = max(np.diff([began, *ticks]))
    assert len(ticks) > 20 and longest < 0.5 * took, (len(ticks), longest, took)


@pytest.fixture(scope="session")
def crank_rocker():
    """The crank-rocker of the repository."""
    return linkproof.Scenario.from_file(TOP / "scenarios/crank_rocker.toml")


@pytest.fixture(scope="session")
def slider_crank():
    """A slider-crank with the parameters crank and rod."""
    return linkproof.Scenario.new("slider-crank")
