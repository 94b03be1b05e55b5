"""The documents as a site: Sphinx with MyST, which reads Markdown as the repository's web page does and checks every link and anchor.

docs/site/build makes the site from the original files, so that each link works in the repository and on the site.
"""

import re
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]

project = "linkproof"
html_title = "linkproof"
extensions = ["myst_parser"]
html_theme = "furo"
html_copy_source = False
html_static_path = ["static"]
html_extra_path = ["extra"]
templates_path = ["templates"]
html_css_files = ["site.css"]
# The theme's sidebar, and below it a link to the pages of the API. docs/site/build adds these pages to the site.
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "sidebar/search.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "api.html",
        "sidebar/scroll-end.html",
    ]
}
root_doc = "README"
include_patterns = ["*.md", "docs/*.md", "docs/*/*.md", "crates/*/README.md", "examples/*/README.md", "benches/peers/README.md"]
exclude_patterns = ["target", "**/.*"]
# Anchors with the same names as on the repository's web page.
myst_heading_anchors = 4
# Pictures may have a width.
myst_enable_extensions = ["html_image"]
# A code block with "..." is not valid TOML or shell; this is not a fault of the document.
suppress_warnings = ["misc.highlighting_failure"]

CONTENTS = {
    "Start": ["docs/tutorial", "docs/machines", "docs/course", "docs/guide", "docs/gallery", "docs/scenario", "docs/formulas"],
    "Proofs": ["docs/report", "docs/recording", "docs/compare", "docs/python", "docs/testing", "docs/mutate", "docs/findings", "docs/authors", "docs/foreign", "docs/stories", "docs/skip"],
    "Design": ["docs/synthesis", "docs/sweep", "docs/scale", "docs/draw", "docs/graph", "docs/plans", "docs/clearance", "docs/sensitivity", "docs/variants60", "docs/import", "docs/exercise", "docs/teaching"],
    "Engines": ["docs/engines", "docs/rapier", "docs/mjcf", "docs/formats", "docs/golden", "docs/peers", "docs/bench", "docs/stress"],
    "Numerics": [f"docs/numerics/{page}" for page in ("bounds", "settings", "forces", "change_points", "given", "friction", "twins", "diagnosis", "laboratory")],
    "Reference": ["docs/verification", "docs/notation", "ARCHITECTURE", "docs/extending", "CHANGELOG", "CONTRIBUTING", "SECURITY"],
}


def contents():
    """Tables of contents, which only the site has; pages not listed in CONTENTS form the last table."""
    named = [page for pages in CONTENTS.values() for page in pages]
    others = sorted(str(path.relative_to(TOP).with_suffix("")) for pattern in include_patterns[1:] for path in TOP.glob(pattern))
    groups = {**CONTENTS, "Crates and examples": [page for page in others if page not in named]}
    for caption, pages in groups.items():
        there = "\n".join(page for page in pages if (TOP / page).with_suffix(".md").exists())
        yield f"```{{toctree}}\n:hidden:\n:caption: {caption}\n\n{there}\n```\n"


def read(_app, page, source):
    """Adds the contents to the first page, and redirects links to folders to the README or manifest in them."""
    folder = (TOP / page).parent

    def opened(match):
        path = folder / match[1]
        inside = next((name for name in ("README.md", "Cargo.toml") if (path / name).exists()), None)
        return f"]({match[1].rstrip('/')}/{inside})" if path.is_dir() and inside else match[0]

    text = re.sub(r"\]\(([\w./-]+)\)", opened, source[0])
    source[0] = text + "\n\n" + "\n".join(contents()) if page == root_doc else text


def setup(app):
    """Called by Sphinx."""
    app.connect("source-read", read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
