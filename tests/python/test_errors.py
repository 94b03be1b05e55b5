"""Errors: place, key and advice."""

import pickle

import linkproof
import pytest
from conftest import TOP

TEXT = (TOP / "scenarios/pendulum.toml").read_text()


def test_a_fault_of_a_file_has_its_place_and_its_way_out(tmp_path):
    file = tmp_path / "pendulum.toml"
    file.write_text(TEXT.replace('joint = "O"', 'joint = "Q"'))
    with pytest.raises(linkproof.InputError) as caught:
        linkproof.Scenario.from_file(file)
    error = caught.value
    assert isinstance(error, ValueError) and isinstance(error, linkproof.LinkproofError)
    assert error.file == str(file) and error.key == "drive.joint" and '"Q"' in error.message
    assert file.read_text().splitlines()[error.line - 1] == 'joint = "Q"'
    assert '"O"' in error.help and error.way_out == error.help
    for part in [str(file), f":{error.line}:", 'joint = "Q"', error.message, error.help]:
        assert part in str(error), str(error)
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error)
    assert (again.file, again.line, again.key, again.help) == (error.file, error.line, error.key, error.help)


def test_all_faults_of_a_text_are_found():
    text = TEXT.replace("mass_kg", "mass_kgg").replace("speed", "sped")
    with pytest.raises(linkproof.InputError) as caught:
        linkproof.Scenario.from_text(text, path="mine.toml")
    assert len(caught.value.found) >= 2 and {error.file for error in caught.value.found} == {"mine.toml"}
    assert len({error.line for error in caught.value.found}) >= 2
    assert len(pickle.loads(pickle.dumps(caught.value)).found) == len(caught.value.found)


def refused(kind, call, *parts, key=None):
    with pytest.raises(kind) as caught:
        call()
    assert caught.value.help, caught.value
    assert key is None or caught.value.key == key, caught.value.key
    for part in parts:
        assert part in str(caught.value), caught.value


def test_kinds_of_faults(slider_crank, tmp_path):
    refused(linkproof.ReadError, lambda: linkproof.Scenario.from_file(tmp_path / "none.toml"), "none.toml")
    refused(linkproof.GeometryError, lambda: slider_crank.set(crank_mm=500).solve(), "crank angle", "reach")
    refused(linkproof.UnsupportedError, lambda: slider_crank.prove(engine="simbody"), "simbody")
    refused(linkproof.InputError, lambda: slider_crank.set(crnk_mm=5), "crank_mm", key="parameters")
    refused(linkproof.InputError, lambda: slider_crank.only("torque"), "torque", key="only")
    refused(linkproof.InputError, lambda: slider_crank.prove(engine="bullet"), "rapier", key="engine")
    refused(linkproof.InputError, lambda: slider_crank.prove(steps=1), "sweeps", key="steps")
    refused(linkproof.InputError, lambda: slider_crank.prove(tolerance=2.0), key="tolerance")
    refused(linkproof.InputError, lambda: slider_crank.prove(tolerance=float("nan")), key="tolerance")
    refused(linkproof.InputError, lambda: slider_crank.at(time=[1.0, 1.0]), "same", key="time")
    refused(linkproof.InputError, lambda: slider_crank.at(), key="input")
    refused(linkproof.InputError, lambda: slider_crank.at(input=[float("nan")]), key="input")
    refused(linkproof.InputError, lambda: slider_crank.draw("bmp"), "svg", key="medium")
    refused(linkproof.InputError, lambda: slider_crank.draw(colour=1), "traces", key="colour")
    refused(linkproof.InputError, lambda: slider_crank.draw(traces=["Z"]), "Z")
    refused(linkproof.InputError, lambda: linkproof.Scenario.new("five-bar"), "geared-five-bar")
    refused(linkproof.InputError, lambda: linkproof.Scenario.new("four-bar", crank=1), "crank_mm")
    refused(linkproof.InputError, lambda: slider_crank.check("crank", None), key="channel")


def test_wrong_types_are_no_crash(slider_crank):
    for call in [
        lambda: slider_crank.set(crank_mm="long"),
        lambda: slider_crank.prove(step="small"),
        lambda: slider_crank.prove(sweeps=-1),
        lambda: slider_crank.prove(extrapolated=1.5),
        lambda: slider_crank.draw("gif", frames=2.5),
        lambda: slider_crank.at(time=3),
        lambda: linkproof.Scenario.from_file(3),
        lambda: linkproof.Scenario(),
        lambda: linkproof.assert_proven(3),
    ]:
        with pytest.raises((TypeError, OverflowError)):
            call()


@pytest.mark.parametrize(
    ("method", "options"),
    [
        ("prove", {"extrapolated": 30}),
        ("prove", {"budget": -1}),
        ("prove", {"accuracy": float("nan")}),
        ("prove", {"step": float("nan")}),
        ("prove", {"engine": []}),
        ("draw", {"medium": "gif", "frames": 0}),
        ("draw", {"medium": "gif", "frames": -1}),
        ("draw", {"medium": "gif", "frames": 10**6}),
        ("draw", {"medium": "gif", "seconds": -1}),
        ("draw", {"medium": "png", "width": 50}),
        ("draw", {"input": 1.0, "time": 0.1}),
    ],
)
def test_options_have_the_limits_of_the_command(slider_crank, method, options):
    with pytest.raises(linkproof.InputError) as caught:
        getattr(slider_crank, method)(**options)
    assert caught.value.key in options
    assert caught.value.help
