"""The exceptions of linkproof: the fault, its place, and advice."""

from typing import Any


class LinkproofError(ValueError):
    """A fault of a scenario, an argument or a computation.

    The text of the exception contains the place in the file and the advice, as in the terminal.
    The attributes contain the same information separately.
    """

    #: The fault, in one sentence.
    message: str
    #: Path of the file as it was given; None if the fault is in no file.
    file: str | None
    #: Number of the line, from 1.
    line: int | None
    #: Path of the key at fault, such as "links.crank.mass_kg", or the name of an argument.
    key: str | None
    #: Advice.
    help: str | None
    #: Time (s) of a fault during the motion.
    time_s: float | None
    #: All faults that were found together, this one first.
    found: list["LinkproofError"]

    def __init__(
        self,
        told: str = "",
        *,
        message: str | None = None,
        file: str | None = None,
        line: int | None = None,
        key: str | None = None,
        help: str | None = None,
        time_s: float | None = None,
    ) -> None:
        super().__init__(told)
        self.message = told if message is None else message
        self.file = file
        self.line = line
        self.key = key
        self.help = help
        self.time_s = time_s
        self.found = [self]

    @property
    def way_out(self) -> str | None:
        """Advice; the same as `help`."""
        return self.help

    def __reduce__(self) -> Any:
        # For exceptions that are sent to another process. The default method would lose the keywords.
        state = {name: value for name, value in self.__dict__.items() if name != "found"}
        others = [other for other in self.found[1:]]
        return _again, (type(self), self.args, state, others)


def _again(
    kind: type[LinkproofError], args: tuple[str, ...], state: dict[str, Any], others: list[LinkproofError]
) -> LinkproofError:
    made = kind(*args)
    made.__dict__.update(state)
    made.found = [made, *others]
    return made


class InputError(LinkproofError):
    """The scenario or an argument is wrong."""


class GeometryError(LinkproofError):
    """The mechanism cannot reach the requested pose."""


class NumericError(LinkproofError):
    """A solver could not finish: a dead point, no convergence, a number that is not finite; or a proof of a sweep disagrees."""


class UnsupportedError(LinkproofError):
    """The input is well-formed, but this version does not support it."""


class ReadError(LinkproofError):
    """A file could not be read or written."""
