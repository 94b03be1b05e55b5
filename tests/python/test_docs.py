"""The examples of the documents, and the docstrings."""

import doctest
import inspect
import json
import re
import runpy
import subprocess
import sys

import linkproof.dask
import pytest
from conftest import TOP

PAGE = (TOP / "docs/python.md").read_text()


def test_the_examples_of_the_page_give_what_the_page_shows(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", PAGE, re.M | re.S)
    examples = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "docs/python.md", "docs/python.md", 0)
    assert len(examples.examples) > 25
    told = []
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    found = doctest.DocTestRunner(optionflags=flags).run(examples, out=told.append)
    assert found.failed == 0, "".join(told)


def test_the_test_of_the_page_passes(pytester):
    [test] = re.findall(r"^```py\n(.*?)^```", PAGE, re.M | re.S)
    pytester.makepyfile(test)
    (pytester.path / "four_bar.toml").write_text(linkproof.Scenario.new("four-bar").text)
    pytester.runpytest_subprocess().assert_outcomes(passed=1)


def test_the_plan_of_large_sweeps_is_what_its_program_gives():
    [shown] = re.findall(r"^\$ python (examples/python/scale_plan.py) (.*)\n((?:.+\n)*)```", (TOP / "docs/scale.md").read_text(), re.M)
    told = subprocess.run([sys.executable, TOP / shown[0], *shown[1].split()], capture_output=True, encoding="utf-8", check=True)
    assert told.stdout == shown[2]
    # The plan has the parts of the program; the numbers are those of the program's test.
    source = (TOP / "crates/sweep/src/plan.rs").read_text()
    [[cases, parts]] = re.findall(r"let parts = \[(.*)\]\.map\(usual_part\);\n.*\(parts, \[(.*)\]\);", source)
    plan = runpy.run_path(str(TOP / shown[0]))
    assert [plan["usual_part"](eval(own)) for own in cases.split(", ")] == [int(own) for own in parts.split(", ")]


def test_the_docstring_of_the_package_is_right():
    assert doctest.testmod(linkproof).failed == 0 and doctest.testmod(linkproof).attempted >= 5


@pytest.mark.parametrize("name", [name for name in linkproof.__all__ if not name.startswith("_")])
def test_everything_public_has_a_docstring(name):
    thing = getattr(linkproof, name)
    assert inspect.getdoc(thing), name
    if inspect.isclass(thing):
        for own, part in vars(thing).items():
            assert own.startswith("_") or inspect.getdoc(part), f"{name}.{own}"


def test_docstrings_state_units():
    for method in ["solve", "prove", "check", "compare", "at", "start", "draw", "set", "sweep", "sensitivity"]:
        text = inspect.getdoc(getattr(linkproof.Scenario, method))
        assert re.search(r"\bunit|\bin (s|rad|m)\b", text), method
    assert "shape (rows,)" in linkproof.Solution.__doc__ and "units" in linkproof.dask.sweep.__doc__


def test_the_notebook_is_clean():
    book = json.loads((TOP / "docs/python/student_task.ipynb").read_text())
    for cell in book["cells"]:
        assert not cell.get("outputs") and cell.get("execution_count") is None and cell["metadata"] == {}
    assert set(book["metadata"]) <= {"kernelspec", "language_info"}
    assert book["metadata"]["language_info"] == {"name": "python"}
