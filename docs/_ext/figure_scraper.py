# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx-Gallery: a figure that is the value of the last line is shown, with or without pyplot."""

from typing import Any
from weakref import WeakSet

from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

SHOWN: WeakSet[Figure] = WeakSet()


def scrape(block: object, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Save the figure, and give the text that shows it."""
    value = block_vars["example_globals"].get("___")
    # the value of an earlier block stays there
    if not isinstance(value, Figure) or value in SHOWN:
        return ""
    SHOWN.add(value)
    path = next(block_vars["image_path_iterator"])
    value.savefig(path, dpi=100)
    return figure_rst([path], gallery_conf["src_dir"])
