"""Common parts of the checks of pages."""

# Tolerance, as a fraction of the mechanism's size or of the largest number of the kind.
WITHIN = 1e-6
GO_TO = """
(row) => { const slider = document.getElementById('slider'); slider.value = row; slider.dispatchEvent(new Event('input')); }
"""


class Wrong(Exception):
    """A fault of a page."""


def need(holds, what):
    if not holds:
        raise Wrong(what)
