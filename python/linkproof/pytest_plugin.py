"""Scenario files as tests of pytest.

`pytest --linkproof scenarios/` proves every scenario file (`*.toml` with links and joints) below `scenarios/`.
In `pyproject.toml`, `linkproof = true` in `[tool.pytest.ini_options]` has the effect of the option.
The fixture `assert_proven` is the function `linkproof.assert_proven`.
"""

import tomllib
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    """The option and the setting that turn files into tests."""
    text = "prove every scenario file (*.toml) among the arguments"
    parser.getgroup("linkproof").addoption("--linkproof", action="store_true", help=text)
    parser.addini("linkproof", text, type="bool", default=False)
    parser.addini("linkproof_only", "words that select the channels to prove; all by default", type="args", default=[])


def _is_scenario(path: Path) -> bool:
    """Whether a TOML file describes a mechanism. An unreadable file counts too, so that its error is reported."""
    try:
        with path.open("rb") as file:
            return {"links", "joints"} <= tomllib.load(file).keys()
    except (OSError, ValueError):
        return True


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> "ScenarioFile | None":
    """A test for a scenario file, if the option or the setting is on."""
    is_asked = parent.config.getoption("linkproof") or parent.config.getini("linkproof")
    if is_asked and file_path.suffix == ".toml" and file_path.name != "pyproject.toml" and _is_scenario(file_path):
        return ScenarioFile.from_parent(parent, path=file_path)
    return None


class ScenarioFile(pytest.File):
    """A scenario file among the tests."""

    def collect(self) -> Iterable["ScenarioItem"]:
        """The proof as the only test."""
        yield ScenarioItem.from_parent(self, name="proven")


class ScenarioItem(pytest.Item):
    """The proof of a scenario file."""

    def runtest(self) -> None:
        """Prove the file."""
        from linkproof import assert_proven

        assert_proven(self.path, only=self.config.getini("linkproof_only"))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """The report or the fault. A traceback would show only this plugin."""
        from linkproof import LinkproofError

        if isinstance(excinfo.value, (AssertionError, LinkproofError)):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Place of the test."""
        return self.path, 0, f"linkproof: {self.path.name}"


@pytest.fixture(name="assert_proven", scope="session")
def _assert_proven() -> Callable[..., Any]:
    """The function `linkproof.assert_proven`."""
    from linkproof import assert_proven

    return assert_proven
