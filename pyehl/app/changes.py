# SPDX-License-Identifier: BSD-3-Clause
"""Changes of many models that reach the browser in one message.

Bokeh sends a message for each property, and the browser paints between them: every picture several
times for one answer.
"""

from typing import Any

from bokeh.models import ColumnDataSource, CustomJS

APPLY = "source.data.model.forEach((m, k) => m.setv(source.data.values[k], {sync: false}))"


class Changes:
    """What is to change, collected and sent at once; models of the server keep what they had.

    Attributes
    ----------
    source
        Transmits the changes; it has to be in the document.
    """

    def __init__(self) -> None:
        self.source = ColumnDataSource({"model": [], "values": []})
        self.source.js_on_change("data", CustomJS(args={"source": self.source}, code=APPLY))
        self._collected: list[tuple[Any, dict[str, Any]]] = []

    def of(self, model: Any, **values: Any) -> None:  # noqa: ANN401 (Bokeh has no types)
        """Let properties of a model change."""
        self._collected.append((model, values))

    def send(self) -> None:
        """Send what was collected."""
        models = [model for model, _ in self._collected]
        self.source.data = {"model": models, "values": [values for _, values in self._collected]}
        self._collected = []
