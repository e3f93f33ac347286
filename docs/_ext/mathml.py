# SPDX-License-Identifier: BSD-3-Clause
"""Formulas as MathML, which browsers render themselves: the pages need no network."""

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.util.math import wrap_displaymath
from sphinx.writers.html import HTMLTranslator


def _inline(self: HTMLTranslator, node: nodes.math) -> None:
    self.body.append(convert(node.astext(), display="inline"))
    raise nodes.SkipNode


def _block(self: HTMLTranslator, node: nodes.math_block) -> None:
    text = node.astext()
    # several lines are aligned as in LaTeX
    if "\\\\" in text and "\\begin" not in text:
        text = wrap_displaymath(text, None, numbering=False)
    self.body.append(self.starttag(node, "div", style="overflow: auto hidden; padding: 0.3em 0"))
    self.body.append(convert(text, display="block"))
    self.body.append("</div>")
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer ``mathml``."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
