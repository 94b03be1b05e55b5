"""The plugin of pytest, and `assert_proven`."""

import linkproof
import pytest
from conftest import TOP

PENDULUM = (TOP / "scenarios/pendulum.toml").read_text()
WRONG = PENDULUM + '\n[[formula]]\nname = "w"\nexpression = "phi"\nchannel = "link.rod.omega_rad_s"\n'


@pytest.fixture
def suite(pytester):
    """A directory with a scenario that agrees, two that do not, and a file that is no scenario."""
    pytester.mkdir("scenarios")
    files = {
        "right": PENDULUM,
        "wrong": WRONG,
        "broken": PENDULUM.replace('joint = "O"', 'joint = "Q"'),
        "other": "[tool]\nname = 'no scenario'\n",
    }
    for name, text in files.items():
        (pytester.path / "scenarios" / f"{name}.toml").write_text(text)
    return pytester


def test_scenario_files_are_tests(suite):
    result = suite.runpytest_subprocess("--linkproof", "scenarios", "-rA")
    result.assert_outcomes(passed=1, failed=2)
    told = result.stdout.str()
    assert "scenarios/right.toml::proven" in told and "wrong.toml::proven" in told and "other.toml" not in told
    assert "DISAGREE" in told and "is not link.rod.omega_rad_s" in told
    assert "broken.toml:" in told and '"Q"' in told and "help:" in told
    assert "pytest_plugin.py" not in told


def test_files_are_tests_only_if_asked_for(suite):
    assert suite.runpytest_subprocess("scenarios").ret == pytest.ExitCode.NO_TESTS_COLLECTED
    suite.makeini("[pytest]\nlinkproof = true\nlinkproof_only = positions\n")
    suite.runpytest_subprocess("scenarios/right.toml").assert_outcomes(passed=1)


def test_a_malformed_file_fails(pytester):
    (pytester.path / "bad.toml").write_text("[links")
    result = pytester.runpytest_subprocess("--linkproof", "bad.toml")
    result.assert_outcomes(failed=1)
    assert "bad.toml:1" in result.stdout.str()


def test_a_file_in_another_encoding_fails_alone(suite):
    latin = PENDULUM.replace("title", "# \u00fc\ntitle").encode("latin-1")
    (suite.path / "scenarios" / "latin.toml").write_bytes(latin)
    result = suite.runpytest_subprocess("--linkproof", "scenarios")
    result.assert_outcomes(passed=1, failed=3)
    assert "latin.toml" in result.stdout.str() and "UTF-8" in result.stdout.str()


def test_the_fixture_proves_scenarios(pytester):
    (pytester.path / "pendulum.toml").write_text(PENDULUM)
    pytester.makepyfile(
        """
        def test_right(assert_proven):
            assert assert_proven("pendulum.toml", only="positions").verdict == "agree"

        def test_coarse(assert_proven):
            assert_proven("pendulum.toml", step=0.05)
        """
    )
    result = pytester.runpytest_subprocess()
    result.assert_outcomes(passed=1, failed=1)
    assert "is not proven: inconclusive" in result.stdout.str()


def test_assert_proven_takes_paths_scenarios_and_proofs(slider_crank, tmp_path):
    proof = linkproof.assert_proven(slider_crank, only=["link.piston", "drive.torque_N_m"], set={"crank_mm": 35})
    assert proof.verdict == "agree" and linkproof.assert_proven(proof) is proof and proof.channels.rows == 10
    file = tmp_path / "wrong.toml"
    file.write_text(WRONG)
    with pytest.raises(AssertionError, match="pendulum is not proven: disagree"):
        linkproof.assert_proven(file)
