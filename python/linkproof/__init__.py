"""Planar mechanisms, solved analytically and proven against a physics engine.

A scenario is read from a file, made from a template or built link by link. Its solution consists of NumPy arrays.
A proof compares the solution with an engine; formulas and tables are compared with the solution:

>>> import linkproof
>>> scenario = linkproof.Scenario.new("four-bar")
>>> solution = scenario.solve()
>>> solution["link.rocker.angle_rad"].shape
(181,)
>>> scenario.check("phi", "link.crank.angle_rad").verdict
'agree'

All numbers are in SI units and world axes: x right, y up, angles counter-clockwise from +x.
"""

from collections.abc import Mapping as _Mapping

from linkproof._linkproof import (
    Builder,
    Comparison,
    FormulaCheck,
    Picture,
    Proof,
    Scenario,
    Sensitivity,
    Solution,
    Sweep,
    Table,
    __version__,
    merge,
    resume,
    templates,
)
from linkproof.errors import (
    GeometryError,
    InputError,
    LinkproofError,
    NumericError,
    ReadError,
    UnsupportedError,
)
from linkproof.testing import assert_proven

# A table is a mapping from names to columns.
_Mapping.register(Table)

__all__ = [
    "Builder",
    "Comparison",
    "FormulaCheck",
    "GeometryError",
    "InputError",
    "LinkproofError",
    "NumericError",
    "Picture",
    "Proof",
    "ReadError",
    "Scenario",
    "Sensitivity",
    "Solution",
    "Sweep",
    "Table",
    "UnsupportedError",
    "__version__",
    "assert_proven",
    "merge",
    "resume",
    "templates",
]
