"""Proofs in tests."""

from collections.abc import Iterable
from os import PathLike, fspath
from typing import Any

from linkproof._linkproof import Proof, Scenario


def assert_proven(
    subject: str | PathLike[str] | Scenario | Proof,
    /,
    *,
    set: dict[str, float] | None = None,
    only: str | Iterable[str] = (),
    **options: Any,
) -> Proof:
    """Prove a scenario, and return the proof if it agrees.

    `subject` is a path, a scenario or a proof. `set` contains parameters by their keys, each in the unit of its key.
    `only` contains words that select the requested channels. All other keywords are those of `Scenario.prove`.

    Raises `AssertionError` with the report if the proof disagrees or is inconclusive.
    """
    __tracebackhide__ = True
    if isinstance(subject, (str, PathLike)):
        subject = Scenario.from_file(fspath(subject))
    if isinstance(subject, Scenario):
        if set:
            subject = subject.set(set)
        words = [only] if isinstance(only, str) else list(only)
        if words:
            subject = subject.only(*words)
        subject = subject.prove(**options)
    elif not isinstance(subject, Proof):
        raise TypeError(f"expected a path, a scenario or a proof, found {type(subject).__name__}")
    if not subject.is_proven:
        raise AssertionError(f"{subject.scenario} is not proven: {subject.verdict}\n\n{subject.report()}")
    return subject
