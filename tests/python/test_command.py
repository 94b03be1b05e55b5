"""The command that the wheel installs."""

import subprocess
import sys

import linkproof
from conftest import COMMAND, TOP, run


def test_the_command_works_and_its_exit_codes_are_those_of_the_program(tmp_path):
    assert run("--version").stdout == f"linkproof {linkproof.__version__}\n"
    assert run("--help").returncode == 0 and "Usage: linkproof <COMMAND>" in run("--help").stdout
    file = tmp_path / "four_bar.toml"
    made = run("new", "four-bar", "-o", file)
    assert made.returncode == 0 and file.read_text() == linkproof.Scenario.new("four-bar").text
    proven = run("run", file, "--no-record")
    assert proven.returncode == 0 and "four_bar: AGREE" in proven.stdout
    wrong = run("check", file, "phi", "--channel", "link.rocker.angle_rad")
    assert wrong.returncode == 1, wrong
    missing = run("run", tmp_path / "none.toml")
    assert missing.returncode == 2 and "none.toml" in missing.stderr
    unknown = run("prove")
    assert unknown.returncode == 2 and "unrecognized subcommand" in unknown.stderr and unknown.stdout == ""
    module = run("-m", "linkproof", "--version", command=sys.executable)
    assert module.stdout == run("--version").stdout


def test_a_closed_pipe_is_no_fault():
    words = f"'{COMMAND}' solve '{TOP / 'scenarios/crank_rocker.toml'}' | head -n 1"
    done = subprocess.run(["bash", "-o", "pipefail", "-c", words], capture_output=True, encoding="utf-8")
    assert done.stdout.startswith("t_s,crank_rad,") and done.stderr == ""


def test_the_pages_and_scenarios_are_in_the_wheel(tmp_path):
    assert "# Python" in run("docs", "python").stdout
    assert run("new", "--shipped", tmp_path).returncode == 0
    assert (tmp_path / "scenarios/crank_rocker.toml").read_bytes() == (TOP / "scenarios/crank_rocker.toml").read_bytes()
