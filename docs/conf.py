# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx: ``sphinx-build -W docs build/docs``, with pyehl installed."""

import html
import re
import sys
from collections import Counter
from importlib.metadata import version as version_of
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "pyehl"
author = "the pyehl developers"
project_copyright = "the pyehl developers"
release = version_of("pyehl")
version = release

extensions = [
    "mathml",
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.viewcode",
    "sphinx_gallery.gen_gallery",
]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
# ford.md becomes pages of FORD, see below
exclude_patterns = ["_build", "_ext", "_static", "examples", "ford.md"]
# The list of measurements may be empty; code blocks without a language are plain text
suppress_warnings = ["toc.empty_glob", "misc.highlighting_failure"]

myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 4

autodoc_member_order = "bysource"
autodoc_typehints = "none"
numpydoc_show_class_members = False

# Every script in examples/ is run; an error in one fails the build
sphinx_gallery_conf = {
    "examples_dirs": "examples",
    "gallery_dirs": "gallery",
    "filename_pattern": "/plot_",
    "image_scrapers": ("matplotlib", "figure_scraper.scrape"),
    "reset_modules": ("matplotlib", "figure_scraper.by_the_style_sheet"),
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "download_all_examples": False,
    "remove_config_comments": True,
    "capture_repr": ("_repr_html_", "__repr__"),
    "show_memory": False,
    "plot_gallery": True,
    "min_reported_time": 1,
    # its page loads scripts from a network
    "write_computation_times": False,
}

html_theme = "furo"
html_math_renderer = "mathml"
html_title = f"pyehl {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False

# Documents outside this folder, and the pages that include them
OUTSIDE = {
    "cases/README.md": "/reference/keys.md",
    "fortran/README.md": "/fortran.md",
    "tests/README.md": "/tests.md",
    "CHANGELOG.md": "/changelog.md",
    "CONTRIBUTING.md": "/contributing.md",
}


def lead_to_pages(app: Sphinx, name: str, source: list[str]) -> None:
    """Redirect links to documents outside this folder to the pages that include them."""
    for outside, page in OUTSIDE.items():
        source[0] = re.sub(rf"\]\((?:\.\./)+{re.escape(outside)}", f"]({page}", source[0])


ROOT = Path(__file__).parent.parent
PATHS = [
    path.relative_to(ROOT)
    for folder, kind in (("fortran", "*.f90"), ("pyehl", "*.py"))
    for path in sorted((ROOT / folder).rglob(kind))
]
NAMES = Counter(path.name for path in PATHS)
SOURCES = {
    name: path.as_posix()
    for path in PATHS
    for name in (path.as_posix(), path.relative_to(path.parts[0]).as_posix(), path.name)
    if name != path.name or NAMES[name] == 1
}
"""Source files by their paths and by their names in the chapters."""


def lead_to_sources(app: Sphinx, name: str, source: list[str]) -> None:
    """Link the file names in the tables of a chapter to the files."""
    if not name.startswith("theory/"):
        return

    def link(result: re.Match[str]) -> str:
        path = SOURCES.get(result[1])
        return result[0] if path is None else f"[{result[0]}](../../{path})"

    source[0] = "\n".join(
        re.sub(r"(?<!\[)`([\w/]+\.(?:f90|py))`", link, line) if line.startswith("|") else line
        for line in source[0].split("\n")
    )


LONGEST = 155
"""Characters of a description that search engines show."""


def describe(
    app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: nodes.document | None
) -> None:
    """Take the first paragraph as the description of a page; name the examples' thumbnails."""
    if doctree is None:
        return
    first = next(iter(doctree.findall(nodes.paragraph)), None)
    words = context["title"] if first is None else " ".join(first.astext().split())
    if len(words) > LONGEST:
        words = words[:LONGEST].rpartition(" ")[0] + " …"
    tag = f'<meta name="description" content="{html.escape(words)}" />'
    context["metatags"] = context.get("metatags", "") + tag
    context["body"] = re.sub(
        r'(tooltip="([^"]*)">\s*<img )alt=""', r'\1alt="\2"', context.get("body", "")
    )


def setup(app: Sphinx) -> None:
    """Register the functions that change the sources and the pages."""
    app.connect("source-read", lead_to_pages)
    app.connect("source-read", lead_to_sources)
    app.connect("html-page-context", describe)
