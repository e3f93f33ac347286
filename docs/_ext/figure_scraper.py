# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx-Gallery: figures with the style sheet of pyehl.

A figure that is the value of the last line is shown, with or without pyplot.
"""

from typing import Any
from weakref import WeakSet

from matplotlib import rcParams
from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

from pyehl.plots.style import STYLE

SHOWN: WeakSet[Figure] = WeakSet()


def by_the_style_sheet(gallery_conf: dict[str, Any], file_name: str) -> None:
    """Set the style sheet for the figures of an example."""
    rcParams.update(STYLE | {"figure.dpi": 200})


def scrape(block: object, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Save the figure, and return the text that includes it."""
    value = block_vars["example_globals"].get("___")
    # the value of an earlier block is still defined
    if not isinstance(value, Figure) or value in SHOWN:
        return ""
    SHOWN.add(value)
    path = next(block_vars["image_path_iterator"])
    value.savefig(path, dpi=200)
    return figure_rst([path], gallery_conf["src_dir"])
