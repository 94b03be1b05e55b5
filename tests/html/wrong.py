"""What the checks of pages share."""

# Of the mechanism's size, or of the largest number of its kind.
WITHIN = 1e-6
GO_TO = """
(row) => { const slider = document.getElementById('slider'); slider.value = row; slider.dispatchEvent(new Event('input')); }
"""


class Wrong(Exception):
    """A page that is not as it must be."""


def need(holds, what):
    if not holds:
        raise Wrong(what)
