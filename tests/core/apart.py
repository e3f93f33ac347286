# SPDX-License-Identifier: BSD-3-Clause
"""Check that the texts of a picture do not overlap."""

import itertools

from matplotlib.axis import Axis
from matplotlib.text import Text


def written(figure):
    """Boxes of all visible texts, with the texts."""
    figure.draw_without_rendering()
    numbers = {}
    # also those of second axes, which are no `Axes`
    for axis in figure.findobj(Axis):
        low, high = sorted(axis.get_view_interval())
        margin = 1e-6 * (high - low)
        for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
            inside = low - margin <= tick.get_loc() <= high + margin
            for label in (tick.label1, tick.label2):
                numbers[label] = inside and axis.axes.get_visible() and label.get_visible()
    return [
        (text.get_text(), text.get_window_extent())
        for text in figure.findobj(Text)
        if text.get_text().strip() and text.get_visible() and numbers.get(text, True)
    ]


def assert_apart(figure, name):
    """No two texts overlap, and all are inside the picture."""
    result = written(figure)
    assert len(result) > 5, name
    for (one, box), (other, other_box) in itertools.combinations(result, 2):
        assert not box.shrunk(0.98, 0.8).overlaps(other_box.shrunk(0.98, 0.8)), (name, one, other)
    for text, box in result:
        inside = figure.bbox.x0 - 1 <= box.x0 and box.x1 <= figure.bbox.x1 + 1
        assert inside, (name, text)
        assert figure.bbox.y0 - 1 <= box.y0, (name, text)
        assert box.y1 <= figure.bbox.y1 + 1, (name, text)
