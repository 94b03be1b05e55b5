"""Proofs, pictures, and what a notebook shows."""

import base64
import io
import re

import linkproof
import pytest
from conftest import TOP
from PIL import Image


@pytest.fixture(scope="module")
def proof(crank_rocker):
    return crank_rocker.prove(engine=["rapier", "impulse"])


def test_a_proof_has_verdict_margin_and_channels(proof, crank_rocker):
    assert proof.verdict == "agree" and proof.is_proven and proof.margin > 1 and proof.reason is None
    assert proof.engines == ["rapier", "impulse"] and proof.scenario == "crank_rocker" and 0 < proof.resolution < 0.1
    channels = proof.channels
    assert channels.rows == 2 * 57 and set(channels["verdict"]) <= {"agree", "inconclusive"}
    assert all(channels["residual"][channels["residual"] > channels["bound"]] == [])
    assert set(channels["channel"]) == set(crank_rocker.channels)
    assert proof.checks.rows > 50 and "unit" in proof.checks
    assert proof.reference["link.rocker.angle_rad"].tobytes() == crank_rocker.solve()["link.rocker.angle_rad"].tobytes()
    engine, other = proof.solution("rapier"), proof.solution("impulse")
    gap = abs(engine["link.rocker.angle_rad"] - proof.reference["link.rocker.angle_rad"]).max()
    assert 0 < gap < 1e-3 and list(engine) == list(other)
    assert proof.solution()["t_s"].tolist() == engine["t_s"].tolist()
    with pytest.raises(linkproof.InputError, match="rapier"):
        proof.solution("bullet")
    assert "AGREE" in proof.report() and "crank_rocker" in repr(proof)


def test_a_proof_that_fails_says_why():
    scenario = linkproof.Scenario.from_file(TOP / "scenarios/pendulum.toml")
    coarse = scenario.prove(step=0.05)
    assert coarse.verdict == "inconclusive" and not coarse.is_proven and coarse.margin is None
    assert "step" in coarse.reason and "INCONCLUSIVE" in coarse._repr_html_()
    assert scenario.prove(step=0.05, tolerance=0.9).verdict != coarse.verdict or coarse.reason


def test_options_of_a_proof_matter(slider_crank):
    assert slider_crank.prove(step=5e-4).resolution == 5e-4
    assert slider_crank.prove(reference="newton").reference["t_s"].shape == slider_crank.solve().time.shape
    with pytest.raises(linkproof.UnsupportedError, match="memory|GB"):
        slider_crank.prove(memory=1e3)


def test_a_notebook_shows_the_verdict_and_escapes_texts(proof):
    shown = proof._repr_html_()
    assert "AGREE" in shown and "<pre" in shown
    text = linkproof.Scenario.new("four-bar").text.replace('title = "', 'title = "<b>&amp; ')
    html = linkproof.Scenario.from_text(text)._repr_html_()
    assert "<b>" not in html and "&lt;b&gt;&amp;amp;" in html


def frames(data):
    picture = Image.open(io.BytesIO(data))
    found = []
    for index in range(picture.n_frames):
        picture.seek(index)
        found.append(picture.convert("RGB").tobytes())
    return found


def test_a_notebook_shows_the_mechanism_moving(slider_crank):
    html = slider_crank._repr_html_()
    [data] = re.findall(r'src="data:image/webp;base64,([^"]+)"', html)
    assert "http" not in html and len(html) < 2_000_000
    shown = frames(base64.b64decode(data))
    assert len(shown) == 36 and len(set(shown)) > 30


def test_pictures(slider_crank):
    picture = slider_crank.draw()
    assert picture.kind == "image/svg+xml" and picture.data.startswith(b"<svg") and "<img" in picture._repr_html_()
    assert slider_crank.draw("pdf").data.startswith(b"%PDF")
    assert Image.open(io.BytesIO(slider_crank.draw("png", width=320).data)).width == 320
    assert len(frames(slider_crank.draw("gif", frames=5, width=200).data)) == 5
    at = [slider_crank.draw(input=angle, loads=True, traces=["B"]).data for angle in (0.2, 1.2)]
    assert at[0] != at[1]
    assert slider_crank.draw(time=0.01).data != slider_crank.draw(time=0.02).data
    assert slider_crank.draw(positions=8).data != slider_crank.draw(groups=True).data


def test_templates_move():
    assert len(linkproof.templates()) >= 18
    for name in linkproof.templates():
        scenario = linkproof.Scenario.new(name)
        assert scenario.solve().rows > 1 and scenario.title == linkproof.templates()[name]
