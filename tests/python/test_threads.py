"""Python's global interpreter lock during computations, and Ctrl-C."""

import signal
import subprocess
import sys
import threading
import time

import linkproof
import numpy as np
from conftest import COMMAND, assert_others_run

#: Angles of many instants: a solution takes a good part of a second.
MANY = np.linspace(0.0, 100.0, 400_000)


def test_other_threads_run_while_a_solution_is_made():
    scenario = linkproof.Scenario.new("four-bar").at(input=MANY)
    assert_others_run(scenario.solve, 0.1)


def test_solutions_in_several_threads_have_the_same_bits():
    scenario = linkproof.Scenario.new("watt")
    name = "point.E.y_m" if "point.E.y_m" in scenario.channels else list(scenario.channels)[-1]
    alone, found = scenario.solve()[name].tobytes(), []
    threads = [threading.Thread(target=lambda: found.append(scenario.solve()[name].tobytes())) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [alone] * 8


def interrupted(words, after):
    """Exit code and standard error of a process that gets Ctrl-C, and the time (s) that it then needs."""
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    time.sleep(after)
    assert process.poll() is None, "it ended before Ctrl-C"
    began = time.perf_counter()
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=60)
    return process.returncode, told, time.perf_counter() - began


LONG = """
import linkproof, os
scenario = linkproof.Scenario.new("four-bar")
try:
    scenario.prove(step=1e-7, budget=1e12)
except KeyboardInterrupt:
    print("stopped", flush=True)
    os._exit(7)
"""


def test_ctrl_c_ends_a_proof_in_python():
    code, told, took = interrupted([sys.executable, "-c", LONG], 2.0)
    assert code == 7, told
    assert took < 2.0


def test_ctrl_c_ends_the_command(tmp_path):
    file = tmp_path / "four_bar.toml"
    file.write_text(linkproof.Scenario.new("four-bar").text)
    words = [COMMAND, "run", file, "--dt", "1e-7", "--no-record"]
    code, told, took = interrupted(words, 2.0)
    assert code == -signal.SIGINT, (code, told)
    assert took < 2.0
