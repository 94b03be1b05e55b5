"""Sweeps: the numbers of `solve`, the bytes of the command, stops, faults."""

import csv
import io
import os
import pathlib
import signal
import subprocess
import sys

import duckdb
import linkproof
import numpy as np
import polars as pl
import pyarrow as pa
import pytest
from conftest import assert_others_run, commands, run

VARY = {"crank_mm": "20:40", "links.rocker.mass_kg": (0.1, 0.5), "density": "normal(1.5, 0.1, 1, 2)"}
FIGURES = ["max:joint.A.f_N", "maxabs:drive.torque_N_m", "at=0:link.coupler.alpha_rad_s2"]


@pytest.fixture(scope="module")
def four_bar():
    return linkproof.Scenario.new("four-bar")


def figures_of(solution):
    """The three figures from the columns of a solution."""
    force = np.sqrt(solution["joint.A.fx_N"] ** 2 + solution["joint.A.fy_N"] ** 2).max()
    return [force, np.abs(solution["drive.torque_N_m"]).max(), solution["link.coupler.alpha_rad_s2"][0]]


def test_rows_have_the_bits_of_solve_and_of_the_command(four_bar, tmp_path):
    done = four_bar.sweep(VARY, FIGURES, sobol=8, seed=3)
    table = done.table()
    assert list(table) == ["case", *VARY, *FIGURES, "state", "reason"] and table.rows == done.cases == 8
    assert table["case"].tolist() == list(range(8)) and table["state"] == ["solved"] * 8 and table["reason"] == [None] * 8
    assert done.units["links.rocker.mass_kg"] == "kg" and table.units["max:joint.A.f_N"] == "N"
    for case in range(8):
        assert done.setting(case) == {key: table[key][case] for key in VARY}
        solution = four_bar.set(done.setting(case)).solve()
        assert [table[figure][case] for figure in FIGURES] == figures_of(solution)
    file = tmp_path / "four_bar.toml"
    file.write_text(four_bar.text)
    vary = [f"--vary={key}={text if isinstance(text, str) else '0.1:0.5'}" for key, text in VARY.items()]
    for index, command in enumerate(commands()):
        out = tmp_path / str(index)
        words = [*vary, *(f"--figure={figure}" for figure in FIGURES), "--sobol", 8, "--seed", 3, "-o", out]
        assert run("sweep", file, *words, command=command).returncode == 0
        assert (out / "cases.parquet").read_bytes() == pathlib.Path(done.path).read_bytes()
        # One case by the command `solve`.
        told = run("solve", file, *(f"--set={key}={number!r}" for key, number in done.setting(5).items()), command=command)
        header, *rows = csv.reader(io.StringIO(told.stdout))
        solution = dict(zip(header, np.array(rows, dtype=float).T, strict=True))
        assert [table[figure][5] for figure in FIGURES] == figures_of(solution)


def test_data_frames_take_the_sweep(four_bar):
    sweep = four_bar.sweep({"crank_mm": (20, 60, 9), "ground_mm": "100:400:2"}, "max:joint.A.f_N", part=4)
    table = sweep.table()
    frame, arrow = pl.DataFrame(sweep), pa.table(sweep)
    assert frame.columns == arrow.column_names == list(table) and arrow["case"].num_chunks == 5
    assert frame.equals(pl.read_parquet(sweep.path)) and frame["crank_mm"].to_list() == table["crank_mm"].tolist()
    refused = frame.filter(pl.col("state") == "refused")
    assert 0 < refused.height < 18 and refused["max:joint.A.f_N"].null_count() == refused.height
    assert np.isnan(table["max:joint.A.f_N"]).sum() == refused.height == sweep.counts["refused"]
    assert sum(sweep.reasons().values()) == refused.height and sweep.verdicts() == {}
    least = frame["max:joint.A.f_N"].min()
    assert duckdb.sql('select min("max:joint.A.f_N"), count(*) from sweep').fetchall() == [(least, 18)]
    assert arrow.schema.field("crank_mm").metadata == {b"unit": b"mm"} and sweep.table().to_pandas().shape == (18, 6)
    spread, best, worst = sweep.spread(), sweep.best(), sweep.best("max:joint.A.f_N", largest=True)
    assert spread["least"][0] == least == best["max:joint.A.f_N"][0] and spread["count"][0] == 18 - refused.height
    assert best["case"][0] == spread["least_case"][0] and worst["case"][0] == spread["most_case"][0]
    assert list(best) == ["case", "crank_mm", "ground_mm", "max:joint.A.f_N"]
    assert "<table>" in sweep._repr_html_() and "18 cases" in repr(sweep)


def test_shares_and_stops_give_the_same_bytes(four_bar, tmp_path):
    given = {"vary": {"crank_mm": "20:50"}, "figures": FIGURES, "latin": 500, "part": 32}
    expected = pathlib.Path(four_bar.sweep(**given, jobs=1, out=tmp_path / "one").path).read_bytes()
    # Each share is solved twice: in a separate directory, and in a common directory that already has the plan.
    plan = four_bar.sweep(**given, out=tmp_path / "shared", plan_only=True)
    assert not plan.is_complete and plan.parts == 16 and plan.counts == {"solved": 0, "refused": 0, "stored": 0}
    for number in [1, 2, 3]:
        four_bar.sweep(**given, out=tmp_path / f"own{number}", shard=(number, 3))
        share = linkproof.resume(tmp_path / "shared", shard=(number, 3))
        assert all(os.path.exists(file) for file in share.part_files) and not share.is_complete
        assert share.counts["solved"] == sum(share.counts.values()) in (160, 180, 192, 148)
    with pytest.raises(linkproof.InputError, match="not solved yet") as caught:
        share.table()
    assert f'linkproof.resume("{tmp_path / "shared"}")' in caught.value.help
    merged = linkproof.merge(*(tmp_path / f"own{number}" for number in [1, 2, 3]), out=tmp_path / "all")
    assert pathlib.Path(merged.path).read_bytes() == expected
    assert pathlib.Path(linkproof.merge(tmp_path / "shared").path).read_bytes() == expected
    again = four_bar.sweep(**given, out=tmp_path / "shared")
    assert again.counts == {"solved": 0, "refused": 0, "stored": 500}
    assert linkproof.resume(tmp_path / "shared").table().rows == 500


def test_an_exception_of_progress_stops_the_sweep_and_the_same_call_continues_it(four_bar, tmp_path):
    given = {"vary": {"crank_mm": "20:50"}, "figures": FIGURES, "latin": 5000, "part": 32}
    seen, out = [], tmp_path / "stopped"

    def stop(done, cases):
        seen.append((done, cases))
        if len(seen) == 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        four_bar.sweep(**given, out=out, jobs=1, progress=stop)
    assert seen == [(32, 5000), (64, 5000), (96, 5000)] and not (out / "cases.parquet").exists()
    whole = four_bar.sweep(**given, out=out, progress=lambda *done: seen.append(done))
    assert 96 <= whole.counts["stored"] < 5000 and seen[-1] == (5000, 5000)
    assert pathlib.Path(whole.path).read_bytes() == pathlib.Path(four_bar.sweep(**given).path).read_bytes()


def test_a_temporary_directory_goes_with_the_object(four_bar):
    done = four_bar.sweep({"crank_mm": "30:40:3"}, FIGURES)
    stream, directory = pa.table(done), done.directory
    assert os.path.isdir(directory)
    del done
    assert not os.path.exists(directory) and stream.num_rows == 3


def test_proofs_are_taken_and_stop_the_sweep_if_they_disagree(four_bar, tmp_path):
    given = {"vary": {"crank_mm": "30:40:4"}, "figures": "maxabs:drive.torque_N_m", "prove_every": 2}
    done = four_bar.sweep(**given)
    assert done.verdicts() == {"agree": 2} and done.table()["proof"] == ["agree", None, "agree", None]
    wrong = linkproof.Scenario.from_text(four_bar.text.replace("2*atan2(q + sqrt", "2*atan2(q - sqrt"))
    with pytest.raises(linkproof.NumericError, match="case 0 disagrees") as caught:
        wrong.sweep(**given, jobs=1, out=tmp_path)
    assert 'scenario.set({"crank_mm": 30.0}).prove()' in caught.value.help and caught.value.key == "prove_every"
    # The joined table tells the case again.
    assert linkproof.merge(tmp_path).verdicts() == {"disagree": 2}
    with pytest.raises(linkproof.NumericError, match="case 0 disagrees"):
        wrong.sweep(**given, out=tmp_path)


def refused(call, *parts, key=None, kind=linkproof.InputError):
    with pytest.raises(kind) as caught:
        call()
    assert caught.value.help and caught.value.key == key, (caught.value.key, caught.value)
    assert "--" not in str(caught.value)
    for part in parts:
        assert part in str(caught.value), caught.value


def test_faults_have_a_place_and_a_way_out(four_bar, tmp_path):
    def sweep(vary, figures=FIGURES, scenario=four_bar, **options):
        return lambda: scenario.sweep(vary, figures, **options)

    grid = {"crank_mm": "30:40:3"}
    refused(sweep({"crnk_mm": "1:2:3"}), "crnk_mm", "crank_mm", key="parameters")
    refused(sweep({"links.crank.mas_kg": "1:2:3"}), "links.crank.mass_kg", key="links.crank.mas_kg")
    for values in ["1:2:3:4", [1.0, 2.0], (1.0, 2.0, 2.5), 3, "normal(1, -1)"]:
        refused(sweep({"crank_mm": values}), "20:60:41", key="vary")
    refused(sweep({"crank_mm": (1, 2)}), "grid", key="vary")
    refused(sweep({}), "varied", key="vary")
    refused(sweep(grid, sobol=8), "samples", key="vary")
    refused(sweep({"crank_mm": (30, 40)}, sobol=8, random=8), "random", "latin", key="sobol")
    refused(sweep(grid, []), "no figure", key="figures")
    refused(sweep(grid, "biggest:drive.torque_N_m"), "max", key="figures")
    refused(sweep(grid, ["max:drive.torque_Nm"]), "drive.torque_Nm", key="figures")
    refused(sweep(grid, shard=(1, 2)), "`out`", key="out")
    refused(sweep(grid, shard=(3, 2), out=tmp_path / "a"), "(2, 8)", key="shard")
    refused(sweep(grid, part=0), "above 0", key="part")
    refused(sweep(grid, prove_every=0), "above 0", key="prove_every")
    refused(sweep(grid, scenario=four_bar.at(input=[0.0, 0.1])), "grid.step_deg", key="scenario")
    refused(sweep(grid, scenario=linkproof.Scenario.builder("rotor").ground({"O": (0, 0)}).link("rotor", {"O": (0, 0)})
                  .pin("O", "ground", "rotor").crank("O", 1.0).build()), "built in code", key="scenario")
    (tmp_path / "notes.txt").write_text("mine")
    refused(sweep(grid, out=tmp_path), "notes.txt", key="out")
    refused(lambda: linkproof.merge(), "no directory", key="directories")
    refused(lambda: linkproof.resume(tmp_path), "no sweep", kind=linkproof.ReadError)
    done = four_bar.sweep(grid, FIGURES, out=tmp_path / "done")
    refused(lambda: done.best("max:nothing"), FIGURES[0], key="figure")
    refused(lambda: done.setting(3), "3", key="case")
    refused(sweep(grid, FIGURES[:1], out=tmp_path / "done"), "another sweep", key="out")
    (tmp_path / "done/cases.parquet").write_bytes(b"PAR1 broken PAR1")
    refused(done.table, "cases.parquet", kind=linkproof.ReadError)
    for wrong in [sweep(3), sweep(grid, 3), sweep(grid, jobs=-1), sweep(grid, shard=1)]:
        with pytest.raises((TypeError, OverflowError, AttributeError)):
            wrong()


def test_other_threads_run_during_a_sweep(four_bar):
    assert_others_run(lambda: four_bar.sweep({"crank_mm": "20:50"}, ["reach_from"], random=300, jobs=1), 0.05)


LONG = """
import linkproof, os, sys
def told(done, cases):
    print(done, flush=True)
scenario = linkproof.Scenario.new("four-bar")
try:
    scenario.sweep({"crank_mm": "20:50"}, ["transmission_angle_deg"], random=10**7, part=64, out=sys.argv[1], progress=told)
except KeyboardInterrupt:
    os._exit(7)
"""


def test_ctrl_c_stops_a_sweep_and_its_parts_stay(tmp_path):
    process = subprocess.Popen([sys.executable, "-c", LONG, tmp_path / "out"], stdout=subprocess.PIPE)
    assert int(process.stdout.readline()) == 64
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=10) == 7
    parts = sorted((tmp_path / "out/parts").glob("0*.parquet"))
    assert parts and pl.read_parquet(parts[0]).height == 64
