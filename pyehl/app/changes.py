# SPDX-License-Identifier: BSD-3-Clause
"""Changes of many models in one message to the browser.

If properties are set one by one, Bokeh sends a message for each, and the browser repaints after
each message: a result would repaint every picture several times.
"""

from typing import Any

from bokeh.models import ColumnDataSource, CustomJS

APPLY = "source.data.model.forEach((m, k) => m.setv(source.data.values[k], {sync: false}))"


class Changes:
    """Changes that are collected and sent together; the models of the server stay unchanged.

    Attributes
    ----------
    source
        Transmits the changes; it must be in the document.
    """

    def __init__(self) -> None:
        self.source = ColumnDataSource({"model": [], "values": []})
        self.source.js_on_change("data", CustomJS(args={"source": self.source}, code=APPLY))
        self._collected: list[tuple[Any, dict[str, Any]]] = []

    def of(self, model: Any, **values: Any) -> None:  # noqa: ANN401 (Bokeh has no types)
        """Collect changes of properties of a model."""
        self._collected.append((model, values))

    def send(self) -> None:
        """Send the collected changes."""
        models = [model for model, _ in self._collected]
        self.source.data = {"model": models, "values": [values for _, values in self._collected]}
        self._collected = []
