"""Mechanisms that are built link by link."""

import linkproof
import numpy as np
import pytest

TEXT = """
format = 1
name = "four_bar"
title = "Four-bar"
[ground.points]
O = { x_m = 0, y_m = 0 }
C = { x_m = 0.4, y_m = 0 }
[links.crank.points]
O = { x_m = 0, y_m = 0 }
A = { x_m = 0.1, y_m = 0 }
[links.coupler]
mass_kg = 2
inertia_kg_m2 = 0.02
mass_centre = { x_m = 0.175, y_m = 0 }
[links.coupler.points]
A = { x_m = 0, y_m = 0 }
B = { x_m = 0.35, y_m = 0 }
[links.rocker.points]
C = { x_m = 0, y_m = 0 }
B = { x_m = 0.25, y_m = 0 }
[[joints]]
name = "O"
type = "revolute"
links = ["ground", "crank"]
[[joints]]
name = "A"
type = "revolute"
links = ["crank", "coupler"]
[[joints]]
name = "B"
type = "revolute"
links = ["coupler", "rocker"]
[[joints]]
name = "C"
type = "revolute"
links = ["ground", "rocker"]
[drive]
joint = "O"
speed_rad_s = 10
[gravity]
x_m_s2 = 0
y_m_s2 = -9.81
[[loads]]
type = "moment"
link = "rocker"
moment_N_m = -3
[[loads]]
type = "force"
link = "coupler"
point = "B"
x_N = 5
y_N = -7
[start]
crank_rad = 0
[[start.groups]]
links = ["coupler", "rocker"]
mode = "left"
[grid]
from_rad = 0
to_rad = 6
step_rad = 0.5
"""


def four_bar():
    return (
        linkproof.Scenario.builder("four_bar")
        .ground({"O": (0, 0), "C": (0.4, 0)})
        .link("crank", {"O": (0, 0), "A": (0.1, 0)})
        .link("coupler", {"A": (0, 0), "B": (0.35, 0)})
        .link("rocker", {"C": (0, 0), "B": (0.25, 0)})
        .mass("coupler", 2.0, (0.175, 0), 0.02)
        .pin("O", "ground", "crank")
        .pin("A", "crank", "coupler")
        .pin("B", "coupler", "rocker")
        .pin("C", "ground", "rocker")
        .crank("O", 10.0)
        .mode("coupler", "rocker", mode="left")
    )


def test_a_built_mechanism_equals_that_of_its_file():
    built = four_bar().gravity().moment("rocker", -3.0).force("coupler", (0.35, 0), (5.0, -7.0)).build()
    written = linkproof.Scenario.from_text(TEXT)
    angles = np.linspace(0.0, 6.0, 25)
    own, other = built.at(input=angles).solve(), written.at(input=angles).solve()
    assert list(own) == list(other) and own.rows == 25
    for name in own:
        assert own[name].tobytes() == other[name].tobytes(), name
    # The loads change the torque.
    light = four_bar().build().at(input=angles).solve()
    assert not np.allclose(light["drive.torque_N_m"], own["drive.torque_N_m"])
    assert built.structure == written.structure and built.links == written.links and built.joints == written.joints


def test_a_built_mechanism_can_do_what_a_file_can():
    scenario = four_bar().instants(72).build()
    assert scenario.name == "four_bar" and scenario.text == "" and scenario.solve().rows == 73
    assert scenario.prove().verdict == "agree"
    assert scenario.only("link.rocker").solve().keys()[2:] == [name for name in scenario.channels if "link.rocker" in name]
    assert scenario.check("phi", "link.crank.angle_rad").verdict == "agree"
    assert scenario.draw().data.startswith(b"<svg") and "data:image/webp" in scenario._repr_html_()
    with pytest.raises(linkproof.InputError, match="built in code"):
        scenario.set(a_mm=3)


def test_a_slider_a_ramp_and_a_free_pendulum_are_built():
    slider = (
        linkproof.Scenario.builder("slider_crank")
        .ground({"O": (0, 0), "D": (0, 0)})
        .link("crank", {"O": (0, 0), "A": (0.1, 0)})
        .link("rod", {"A": (0, 0), "B": (0.4, 0)})
        .link("piston", {"B": (0, 0)})
        .pin("O", "ground", "crank")
        .pin("A", "crank", "rod")
        .pin("B", "rod", "piston")
        .slider("D", ("ground", "D"), ("piston", "B"))
        .ramp("O", 10.0, 0.5)
        .mode("rod", "piston", mode="ahead")
        .start(0.3)
        .build()
    )
    solution = slider.at(time=[0.0, 0.5]).solve()
    assert solution["link.crank.omega_rad_s"].tolist() == [0.0, 10.0] and solution.input[0] == 0.3
    x = 0.1 * np.cos(0.3) + np.sqrt(0.4**2 - (0.1 * np.sin(0.3)) ** 2)
    assert solution["joint.D.slide_m"][0] == pytest.approx(x, abs=1e-14)
    pendulum = (
        linkproof.Scenario.builder("pendulum")
        .ground({"O": (0, 0)})
        .link("rod", {"O": (0, 0)})
        .mass("rod", 1.0, (0.5, 0), 0.1)
        .pin("O", "ground", "rod")
        .free("O", initial_speed=0.0, nominal_speed=1.0)
        .gravity()
        .build()
        .at(time=[0.0, 1e-3])
    )
    start = pendulum.solve()["link.rod.alpha_rad_s2"][0]
    assert start == pytest.approx(-9.81 * 0.5 / (0.1 + 0.25), rel=1e-12)


def test_faults_of_a_built_mechanism_are_told():
    with pytest.raises(linkproof.InputError, match="rocker") as caught:
        four_bar().mass("lever", 1.0, (0, 0), 0.1).build()
    assert "lever" in str(caught.value) and caught.value.help
    for wrong in [lambda: four_bar().mode("a", mode="up"), lambda: four_bar().moment("lever", 1.0)]:
        with pytest.raises(linkproof.InputError) as caught:
            wrong()
        assert caught.value.help
    with pytest.raises(linkproof.InputError, match="ground"):
        linkproof.Scenario.builder("empty").build()
    with pytest.raises(linkproof.InputError, match="name"):
        rotor = linkproof.Scenario.builder("Not a name").ground({"O": (0, 0)}).link("rotor", {"O": (0, 0)})
        rotor.pin("O", "ground", "rotor").crank("O", 1.0).build()


def test_too_many_instants_are_refused():
    with pytest.raises(linkproof.UnsupportedError, match="1000000000000 intervals"):
        four_bar().instants(10**12).build()
