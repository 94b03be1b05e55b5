"""Solutions: numbers, names, units, memory."""

import csv
import gc
import io

import duckdb
import linkproof
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest
from conftest import TOP, commands, run

FILES = [
    "scenarios/crank_rocker.toml",
    "scenarios/quick_return.toml",
    "scenarios/class3_group.toml",
    "scenarios/geared_five_bar.toml",
    "scenarios/cam_follower.toml",
    "scenarios/slider_crank_friction.toml",
    "scenarios/double_pendulum.toml",
    "scenarios/robot_arm.toml",
    "scenarios/lifting_screw.toml",
]


@pytest.mark.parametrize("file", FILES)
def test_numbers_equal_those_of_the_command_bit_by_bit(file):
    solution = linkproof.Scenario.from_file(TOP / file).solve()
    for command in commands():
        told = run("solve", TOP / file, command=command)
        assert told.returncode == 0, told.stderr
        header, *rows = csv.reader(io.StringIO(told.stdout))
        assert list(solution) == header
        table = np.array(rows, dtype=float)
        assert table.shape == (solution.rows, len(solution))
        for index, name in enumerate(header):
            assert solution[name].tobytes() == np.ascontiguousarray(table[:, index]).tobytes(), name


def test_changed_numbers_equal_those_of_the_command(tmp_path):
    scenario = linkproof.Scenario.new("four-bar")
    file = tmp_path / "four_bar.toml"
    file.write_text(scenario.text)
    solution = scenario.set(crank_mm=37.5, speed_rpm=90).only("link.rocker", "drive.torque_N_m").solve()
    words = ["--set", "crank_mm=37.5", "--set", "speed_rpm=90", "--only", "link.rocker", "--only", "drive.torque_N_m"]
    told = run("solve", file, *words)
    header, *rows = csv.reader(io.StringIO(told.stdout))
    assert list(solution) == header and len(header) == 2 + 9 + 1
    for name, column in zip(header, np.array(rows, dtype=float).T, strict=True):
        assert solution[name].tobytes() == np.ascontiguousarray(column).tobytes(), name
    unchanged = scenario.solve()["link.rocker.angle_rad"]
    assert np.abs(unchanged - solution["link.rocker.angle_rad"]).max() > 1e-3


def test_a_solution_is_a_mapping_with_units(crank_rocker):
    solution = crank_rocker.solve()
    names = list(solution)
    assert names[:3] == ["t_s", "crank_rad", "link.crank.angle_rad"] and len(solution) == len(names) == 59
    assert solution.time.shape == solution.input.shape == (361,) and solution.time.dtype == np.float64
    assert solution.input_name == "crank_rad" and solution.rows == 361
    assert solution.units["link.rocker.alpha_rad_s2"] == "rad/s^2" and solution.units["drive.torque_N_m"] == "N m"
    assert set(solution.units) == set(names)
    assert "drive.torque_N_m" in solution and "drive" not in solution and 3 not in solution
    assert solution.get("nothing") is None and solution.get("t_s", 0) is not None
    assert dict(solution).keys() == dict(solution.items()).keys() == set(solution.keys())
    assert crank_rocker.channels == {name: unit for name, unit in solution.units.items() if name in names[2:]}
    with pytest.raises(KeyError, match="did you mean .*link.rocker.angle_rad"):
        solution["link.rocker.angle_red"]


def address(array):
    return array.__array_interface__["data"][0]


def test_arrays_share_the_memory_of_the_solution(crank_rocker):
    solution = crank_rocker.solve()
    first, second = solution["link.rocker.angle_rad"], solution["link.rocker.angle_rad"]
    assert first is not second and address(first) == address(second) and not first.flags.owndata
    assert np.shares_memory(first, second)
    # Arrow uses the same memory.
    arrow = pa.table(solution)["link.rocker.angle_rad"].chunk(0)
    assert address(arrow.to_numpy(zero_copy_only=True)) == address(first)
    frame = pl.DataFrame(solution)["link.rocker.angle_rad"]
    assert address(frame.to_numpy(allow_copy=False)) == address(first)


def test_arrays_are_read_only_and_outlive_the_solution(crank_rocker):
    solution = crank_rocker.solve()
    array, kept = solution["joint.A.fx_N"], solution["joint.A.fx_N"].copy()
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 1.0
    with pytest.raises(ValueError, match="WRITEABLE"):
        array.flags.writeable = True
    kept[0] += 1.0
    assert kept[0] == array[0] + 1.0
    del solution
    gc.collect()
    # If the memory of `array` had been freed, these solutions would overwrite it.
    others = [crank_rocker.solve() for _ in range(20)]
    assert all(np.array_equal(other["joint.A.fx_N"], array) for other in others)


def test_data_frames_take_the_table(crank_rocker):
    solution = crank_rocker.solve()
    torque = solution["drive.torque_N_m"]
    for frame in [pl.DataFrame(solution), pl.from_arrow(pa.table(solution)), pd.DataFrame(dict(solution)), solution.to_pandas()]:
        assert list(frame.columns) == list(solution)
        assert np.array_equal(np.asarray(frame["drive.torque_N_m"]), torque)
    if hasattr(pd.DataFrame, "from_arrow"):
        assert np.array_equal(pd.DataFrame.from_arrow(solution)["drive.torque_N_m"], torque)
    largest = duckdb.sql('select max("drive.torque_N_m"), count(*) from solution').fetchall()
    assert largest == [(torque.max(), 361)]
    field = pa.table(solution).schema.field("link.rocker.omega_rad_s")
    assert field.type == pa.float64() and not field.nullable and field.metadata == {b"unit": b"rad/s"}


def test_instants_and_starts_can_be_chosen(crank_rocker):
    angles = np.radians([10.0, 20.0, 45.0])
    solution = crank_rocker.at(input=angles).solve()
    assert solution.input.tolist() == angles.tolist() and solution.rows == 3
    assert crank_rocker.at(time=[0.0, 0.25]).solve().time.tolist() == [0.0, 0.25]
    other = crank_rocker.start("coupler,rocker=right").solve()
    assert (other["link.rocker.angle_rad"][0] < 0) != (crank_rocker.solve()["link.rocker.angle_rad"][0] < 0)
    assert crank_rocker.start(input=np.pi).solve().input[0] == crank_rocker.solve().input[0]
    assert crank_rocker.start(input=np.pi).solve().time[0] != 0
    # A change keeps all earlier changes.
    both = linkproof.Scenario.new("four-bar").set(crank_mm=30).at(input=[0.5]).only("positions").set({"rocker_mm": 85})
    assert both.parameters["crank_mm"] == 30 and both.parameters["rocker_mm"] == 85 and both.solve().rows == 1
    assert not any("omega" in name for name in both.solve())
