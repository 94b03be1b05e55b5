"""Sensitivities: the numbers of the command, units, faults."""

import csv
import json

import duckdb
import linkproof
import numpy as np
import pyarrow as pa
import pytest
from conftest import TOP, commands, run

FIGURES = ["max:point.D.y_mm", "rms:drive.torque_N_m"]
BY = ["links.crank.points.A.x_m", "links.rocker.mass_kg"]


def numbers(column):
    return np.array([float(cell) if cell else np.nan for cell in column])


def test_derivatives_equal_those_of_the_command_bit_by_bit(crank_rocker, tmp_path):
    tolerances = {"links.crank.points.A.x_m": 1e-5, "links.coupler.points.B.x_m": 5e-5}
    found = crank_rocker.sensitivity(FIGURES, BY, tolerances=tolerances, samples=50, seed=4)
    table = found.derivatives
    for index, command in enumerate(commands()):
        base = tmp_path / str(index)
        words = [*(f"--figure={own}" for own in FIGURES), *(f"--by={own}" for own in BY), "--samples=50", "--seed=4"]
        words += [f"--tolerance={key}={limit!r}" for key, limit in tolerances.items()]
        told = run("sensitivity", TOP / "scenarios/crank_rocker.toml", *words, "-o", f"{base}.csv", "-o", f"{base}.json", command=command)
        assert told.returncode == 0, told.stderr
        header, *rows = csv.reader((tmp_path / f"{index}.csv").open())
        assert header == list(table) and len(rows) == table.rows == 6
        for name, column in zip(header, zip(*rows, strict=True), strict=True):
            own = table[name]
            assert list(column) == own if isinstance(own, list) else numbers(column).tobytes() == own.tobytes(), name
        for row, figure in enumerate(json.loads((tmp_path / f"{index}.json").read_text())["figures"]):
            stack, own = figure["stack"], {name: column[row] for name, column in found.stacks.items()}
            stack["sampled_least"], stack["sampled_most"] = stack.pop("sampled_ends")
            assert own == {"figure": figure["figure"], "unit": figure["unit"], **stack}
            assert found.figures["value"][row] == figure["value"]


def test_derivatives_are_those_of_the_scenario(slider_crank):
    """The stroke's end is crank + rod; a longer crank moves it one to one."""
    found = slider_crank.sensitivity("max:point.B.x_mm")
    table = found.derivatives
    rows = dict(zip(table["key"], table["derivative"], strict=True))
    assert rows["crank_mm"] == pytest.approx(1.0, rel=1e-12) and rows["rod_mm"] == pytest.approx(1.0, rel=1e-12)
    assert table["figure_unit"][0] == "mm" and table["unit"][table["key"].index("crank_mm")] == "mm"
    assert found.figures["value"].tolist() == [200.0] and found.stacks.rows == 0 and found.left_out == {}
    # The derivatives are those of the changed scenario.
    longer = slider_crank.set(crank_mm=50).sensitivity("max:point.B.x_mm", "crank_mm")
    assert longer.figures["value"].tolist() == pytest.approx([210.0], rel=1e-15) and longer.derivatives["value"].tolist() == [50.0]
    one = slider_crank.at(input=[0.5]).sensitivity("max:point.B.x_mm", "crank_mm").derivatives
    step = 1e-3
    ends = [slider_crank.at(input=[0.5]).set(crank_mm=40 + sign * step).solve()["point.B.x_m"][0] for sign in (-1, 1)]
    assert one["derivative"][0] == pytest.approx(1e3 * (ends[1] - ends[0]) / (2 * step), rel=1e-8)


def test_data_frames_and_notebooks_take_it(slider_crank):
    found = slider_crank.sensitivity(["max:point.B.x_mm"], tolerances={"crank_mm": 0.02})
    table = found.derivatives
    arrow = pa.table(table)
    assert arrow.shape == (table.rows, 9) and arrow["tolerance"].null_count == table.rows - 1
    assert duckdb.sql("select key from arrow where tolerance > 0 limit 1").fetchall() == [("crank_mm",)]
    assert found.draw().data.startswith(b"<svg") and "<table>" in found._repr_html_()
    assert found.stacks["worst"][0] == pytest.approx(0.02) and "1 figures" in repr(found)


def test_faults_have_a_way_out(slider_crank):
    def refused(call, *parts, key=None, kind=linkproof.InputError):
        with pytest.raises(kind) as caught:
            call()
        assert caught.value.help and caught.value.key == key, (caught.value.key, caught.value)
        for part in parts:
            assert part in str(caught.value), caught.value

    figure = "max:point.B.x_mm"
    refused(lambda: slider_crank.sensitivity("biggest:point.B.x_mm"), "max", key="figures")
    refused(lambda: slider_crank.sensitivity("max:point.Q.x_mm"), "point.Q")
    refused(lambda: slider_crank.sensitivity(figure, "crnk_mm"), "crank_mm")
    refused(lambda: slider_crank.sensitivity(figure, tolerances={"crank_mm": 0.0}), "above 0", key="tolerances")
    refused(lambda: slider_crank.sensitivity(figure, tolerances={"crank_mm": 0.1}, samples=5), "10", key="samples")
    friction = linkproof.Scenario.from_file(TOP / "scenarios/slider_crank_friction.toml")
    refused(lambda: friction.sensitivity("max:drive.torque_N_m"), kind=linkproof.UnsupportedError)
    with pytest.raises(TypeError):
        slider_crank.sensitivity(3)
