"""Tables of other programs, compared with a scenario."""

import duckdb
import linkproof
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest
from conftest import TOP


@pytest.fixture(scope="module")
def frame(crank_rocker):
    """A table of another program, with other names, degrees and milliseconds."""
    solution = crank_rocker.solve()
    return pd.DataFrame(
        {
            "time [ms]": 1e3 * solution.time,
            "psi": np.degrees(solution["link.rocker.angle_rad"]),
            "xB": 1e3 * solution["point.B.x_m"],
            "torque": solution["drive.torque_N_m"],
            "note": ["from the other program"] * solution.rows,
        }
    )


MAP = {"time_ms": "time [ms]", "link.rocker.angle_deg": "psi", "point.B.x_m": "xB/1000", "drive.torque_N_m": "torque"}


def tables(frame):
    numbers = frame.drop(columns="note")
    return {
        "pandas": frame,
        "polars": pl.from_pandas(frame),
        "arrow": pa.Table.from_pandas(frame),
        "arrow in parts": pa.concat_tables([pa.Table.from_pandas(frame[:100]), pa.Table.from_pandas(frame[100:])]),
        "duckdb": duckdb.from_df(frame),
        "arrays": {name: numbers[name].to_numpy() for name in numbers},
        "lists": {name: numbers[name].to_list() for name in numbers},
    }


@pytest.mark.parametrize("kind", ["pandas", "polars", "arrow", "arrow in parts", "duckdb", "arrays", "lists"])
def test_a_table_of_any_package_agrees_or_disagrees(crank_rocker, frame, kind):
    found = crank_rocker.compare(tables(frame)[kind], MAP)
    assert found.verdict == "agree", found.report()
    assert found.channels["channel"] == list(MAP)[1:] and found.channels["judged"].tolist() == [361] * 3
    late = frame.assign(psi=np.roll(frame.psi, 5))
    found = crank_rocker.compare(tables(late)[kind], MAP)
    assert found.verdict == "disagree" and "link.rocker.angle_deg" in found.reason + found.report()
    verdicts = dict(zip(found.channels["channel"], found.channels["verdict"], strict=True))
    assert verdicts == {"link.rocker.angle_deg": "disagree", "point.B.x_m": "agree", "drive.torque_N_m": "agree"}


def test_a_cause_is_named(crank_rocker, frame):
    found = crank_rocker.compare(frame.assign(torque=-frame.torque), MAP)
    [(channels, cause)] = found.causes
    assert channels == ["drive.torque_N_m"] and "sign" in cause, cause
    assert cause in " ".join(found.report().split()) and "DISAGREE" in found._repr_html_()


def test_a_frame_without_arrow_is_read_by_its_columns(crank_rocker, frame):
    class Bare(dict):
        """A table whose stream needs a package that is not installed, such as pandas without pyarrow."""

        def __arrow_c_stream__(self, requested_schema=None):
            raise ImportError("pyarrow is not installed")

    bare = Bare({name: frame[name] for name in frame})
    assert crank_rocker.compare(bare, MAP).verdict == "agree"


def test_names_of_channels_need_no_map(crank_rocker):
    solution = crank_rocker.solve()
    for own in [solution, solution.to_pandas(), dict(solution), pl.DataFrame(solution), crank_rocker]:
        found = crank_rocker.compare(own)
        assert found.verdict == "agree" and found.channels.rows == 57


def test_gaps_are_left_out_and_nan_is_a_fault(crank_rocker):
    times, angle = crank_rocker.solve().time, crank_rocker.solve()["link.rocker.angle_rad"]
    values = [None if row % 7 == 0 else value for row, value in enumerate(angle.tolist())]
    found = crank_rocker.compare(pl.DataFrame({"t_s": times, "link.rocker.angle_rad": values}))
    assert found.verdict == "agree" and found.channels["missing"].tolist() == [52]
    broken = np.where(np.arange(361) == 100, np.nan, angle)
    assert crank_rocker.compare({"t_s": times, "link.rocker.angle_rad": broken}).verdict == "disagree"


def test_single_precision_is_judged_as_such(crank_rocker):
    solution = crank_rocker.solve()
    table = {"t_s": solution.time, "link.rocker.angle_rad": solution["link.rocker.angle_rad"].astype(np.float32)}
    assert crank_rocker.compare(pa.table(table)).verdict == "agree"
    rounded = {**table, "link.rocker.angle_rad": table["link.rocker.angle_rad"].astype(np.float64)}
    assert crank_rocker.compare(rounded).verdict == "disagree"


def test_allowed_differences(crank_rocker):
    solution = crank_rocker.solve()
    off = {"t_s": solution.time, "point.B.x_m": solution["point.B.x_m"] + 1e-4}
    assert crank_rocker.compare(off).verdict == "disagree"
    assert crank_rocker.compare(off, absolute=2e-4).verdict == "agree"
    assert crank_rocker.compare(off, absolute={"point.B.x_m": 2e-4}).verdict == "agree"
    assert crank_rocker.compare(off, absolute=5e-5).verdict == "disagree"
    assert crank_rocker.compare(off, relative=0.01).verdict == "agree"
    assert crank_rocker.compare(off, of_value=0.01).verdict == "agree"
    for wrong in [{"absolute": -1.0}, {"relative": float("nan")}, {"absolute": {"point.Z": 1.0}}, {"by": "row"}]:
        with pytest.raises(linkproof.InputError) as caught:
            crank_rocker.compare(off, **wrong)
        assert caught.value.help


def test_files_and_their_maps(crank_rocker):
    place = TOP / "examples/foreign"
    found = crank_rocker.compare(place / "data/wrong_mujoco_late.csv", place / "mujoco_crank_rocker.map.toml")
    assert found.verdict == "disagree" and found.channels["second"].shape == found.channels["bound"].shape
    # The same table, read by pandas. Numbers of a data frame are taken as exact, those of a file as rounded.
    table = pd.read_csv(place / "data/mujoco_crank_rocker.csv", comment="#")
    told = crank_rocker.compare(place / "data/mujoco_crank_rocker.csv", place / "mujoco_crank_rocker.map.toml")
    again = crank_rocker.compare(table, place / "mujoco_crank_rocker.map.toml")
    assert again.channels["channel"] == told.channels["channel"]
    assert np.allclose(again.channels["rms"], told.channels["rms"], rtol=1e-3)


def test_faults_of_tables(crank_rocker, frame):
    for table, fault in [
        (3, "not a table"),
        ({"t_s": [0.0, 0.1], "point.B.x_m": [0.1]}, "length"),
        ({"name": ["a"]}, "no column of numbers"),
        ({}, "no column of numbers"),
    ]:
        with pytest.raises(linkproof.InputError, match=fault) as caught:
            crank_rocker.compare(table)
        assert caught.value.key == "other" and caught.value.help
    with pytest.raises(linkproof.InputError, match="phi3"):
        crank_rocker.compare(frame, {**MAP, "link.rocker.omega_rad_s": "phi3"})
    with pytest.raises(linkproof.InputError, match="channel"):
        crank_rocker.compare(frame.drop(columns="psi"), {"time_ms": "time [ms]", "link.rocker.psi": "torque"})


def test_any_byte_order_masked_values_and_none(crank_rocker):
    solution = crank_rocker.solve()
    x = solution["point.B.x_m"]
    for kind in (">f8", ">f4", "<f4", "longdouble"):
        assert crank_rocker.compare({"time_s": solution.time, "point.B.x_m": x.astype(kind)}).verdict == "agree", kind
    row = 3
    wrong = np.where(np.arange(len(x)) == row, 77.0, x)
    masked = np.ma.masked_array(wrong, mask=np.arange(len(x)) == row)
    assert crank_rocker.compare({"time_s": solution.time, "point.B.x_m": masked}).verdict == "agree"
    gap = [None if at == row else float(value) for at, value in enumerate(x)]
    assert crank_rocker.compare({"time_s": solution.time, "point.B.x_m": gap}).verdict == "agree"
    assert crank_rocker.compare({"time_s": solution.time, "point.B.x_m": wrong}).verdict == "disagree"
