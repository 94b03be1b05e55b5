"""Formulas as texts and as expressions of SymPy."""

import linkproof
import pytest
import sympy as sp
from conftest import TOP
from linkproof._sympy import formula

phi, crank, rod, y, t = sp.symbols("phi crank rod y t")
POSITION = crank * sp.cos(phi) + sp.sqrt(rod**2 - (crank * sp.sin(phi)) ** 2)


def test_an_expression_of_sympy_agrees(slider_crank):
    found = slider_crank.check(POSITION, "point.B.x_m")
    assert found.verdict == "agree" and found.margin > 1 and found.reason is None and found.causes == {}
    rows = found.formulas
    # Both analytic sides: the value and two derivatives.
    assert rows.rows == 6 and set(rows["verdict"]) == {"agree"} and rows["derivative"].tolist() == [0, 1, 2] * 2
    assert set(rows["side"]) == {"assur", "newton"} and all(abs(rows["difference"]) <= rows["bound"])
    # The same formula as a text.
    assert slider_crank.check("crank*cos(phi) + sqrt(rod^2 - (crank*sin(phi))^2)", "point.B.x_m").verdict == "agree"
    # A derivative by SymPy is judged too.
    omega = slider_crank.solve()["link.crank.omega_rad_s"][0]
    assert slider_crank.check(sp.diff(POSITION, phi) * sp.Float(omega), "point.B.vx_m_s").verdict == "agree"


def test_a_wrong_expression_disagrees_with_its_cause(slider_crank):
    wrong = crank * sp.cos(phi) + sp.sqrt(rod**2 + (crank * sp.sin(phi)) ** 2)
    found = slider_crank.check(wrong, "point.B.x_m")
    assert found.verdict == "disagree" and found.margin is None
    assert "beyond the bound" in found.reason and found.causes.keys() == {"formula"}
    assert "a sign" in found.causes["formula"] and "-(crank^2*sin(phi)^2)" in found.causes["formula"]
    assert "DISAGREE" in found._repr_html_() and "<table>" in found._repr_html_()


def test_steps_limits_and_errors_of_a_claim(slider_crank):
    steps = {"height": crank * sp.sin(phi), "s": "crank*cos(phi)"}
    found = slider_crank.check(sp.Symbol("s") + sp.sqrt(rod**2 - sp.Symbol("height") ** 2), "point.B.x_m", steps=steps)
    assert found.verdict == "agree"
    series = crank * sp.cos(phi) + rod - (crank * sp.sin(phi)) ** 2 / (2 * rod)
    assert slider_crank.check(series, "point.B.x_m").verdict == "disagree"
    assert slider_crank.check(series, "point.B.x_m", error=1e-3).verdict == "agree"
    # acos of the crank's direction is its angle only in the first half turn.
    assert slider_crank.check(sp.acos(sp.cos(phi)), "link.crank.angle_rad", valid=(0.1, 3.0)).verdict == "agree"
    assert slider_crank.check(sp.acos(sp.cos(phi)), "link.crank.angle_rad").verdict == "disagree"


def test_formulas_of_a_file_are_judged():
    scenario = linkproof.Scenario.from_file(TOP / "scenarios/formulas/slider_crank_centric.toml")
    assert scenario.check().verdict == "agree"
    with pytest.raises(linkproof.InputError, match="formula"):
        linkproof.Scenario.from_file(TOP / "scenarios/pendulum.toml").only("positions").check()


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        (-(y**2), "-y^2"),
        (sp.Rational(1, 3) * y, "y/3"),
        (1 / sp.sqrt(y), "1/sqrt(y)"),
        (y ** sp.Rational(2, 3), "y^(2/3)"),
        ((y + 1) ** (-2), "(y + 1)^(-2)"),
        (2**-y, "2^(-y)"),
        (sp.Float("0.1", 30) * y, "0.1*y"),
        (sp.pi * y, "pi*y"),
        (sp.E * y, "exp(1)*y"),
        (sp.exp(-(y**2) / 2), "exp(-y^2/2)"),
        (sp.log(y, 2), "ln(y)/ln(2)"),
        (sp.sec(y), "1/cos(y)"),
        (sp.sinh(y), "exp(y)/2 - exp(-y)/2"),
        (sp.Abs(y), "abs(y)"),
        (sp.sign(y), "sign(y)"),
        (sp.Function("phi")(t) * 2, "2*phi"),
        (sp.Integral(sp.cos(y), y), "sin(y)"),
        (3, "3"),
        (0.1, "0.1"),
    ],
)
def test_expressions_become_formulas(expression, text):
    assert formula(expression) == text


@pytest.mark.parametrize("seed", range(6))
def test_numbers_of_formulas_equal_those_of_sympy(slider_crank, seed):
    """The mechanism judges the text against the number of SymPy at one crank angle."""
    at, size = 0.3 + seed, 0.2 + 0.1 * seed
    parts = [POSITION, sp.sin(phi) ** 3 / (2 + sp.cos(phi)), sp.exp(-phi / 7) * sp.atan2(phi, 2), -(phi**2) ** size]
    expression = sp.expand(parts[seed % 4] * (phi - parts[(seed + 1) % 4]) / (1 + phi**2) - sp.pi / 3)
    numbers = {crank: 0.04, rod: 0.16}
    value = float(expression.subs(numbers).subs(phi, at).evalf(25))
    one = slider_crank.at(input=[at])
    claim = f"link.crank.angle_rad*0 + ({value!r})"
    assert one.check(expression, claim, error=1e-12).verdict == "agree"
    assert one.check(expression + 1e-9, claim, error=1e-12).verdict == "disagree"


@pytest.mark.parametrize("wrong", [sp.oo * 1, sp.I * y, sp.Piecewise((y, y > 0), (0, True)), sp.gamma(y), sp.Max(y, 1), sp.Symbol("θ")])
def test_expressions_without_a_formula_are_refused(slider_crank, wrong):
    with pytest.raises(linkproof.LinkproofError) as caught:
        slider_crank.check(wrong, "point.B.x_m")
    assert caught.value.key == "expression" and caught.value.help


def test_other_objects_are_no_formulas(slider_crank):
    for wrong in [[1], object(), sp.Eq(y, 1), True]:
        with pytest.raises(linkproof.InputError, match="instead of a formula"):
            slider_crank.check(wrong, "point.B.x_m")
    with pytest.raises(linkproof.InputError) as caught:
        slider_crank.check("crank*cos(phi", "point.B.x_m")
    assert "not closed" in caught.value.message and caught.value.line == 1
    with pytest.raises(linkproof.InputError, match="lengths|crank"):
        slider_crank.check(sp.Symbol("r") * sp.cos(phi), "point.B.x_m")
