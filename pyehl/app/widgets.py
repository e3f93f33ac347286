# SPDX-License-Identifier: BSD-3-Clause
"""A knob as the page shows it: a slider, a field to type in, and room for what is wrong."""

from collections.abc import Callable
from html import escape
from typing import Any

from bokeh.layouts import column, row
from bokeh.models import Div, Select, Slider, TextInput

from pyehl.app.knobs import STEPS, Choice, Knob, Value
from pyehl.errors import InputError

WIDTH = 300
ERROR = {"color": "#b00020", "white-space": "pre-wrap", "font-size": "85%"}
NOTHING = {"display": "none"}


class KnobWidget:
    """A knob on the page; `turned` is called with its name and value when somebody turns it."""

    def __init__(
        self, knob: Knob | Choice, value: Value, turned: Callable[[str, Value], None]
    ) -> None:
        self.knob, self._turned = knob, turned
        # while the page itself moves the knob nobody has turned it
        self._quiet = False
        self.error = Div(
            text="", styles=NOTHING, width=WIDTH, margin=(0, 5, 0, 5), name=f"error_{knob.name}"
        )
        self.slider: Any = None
        if isinstance(knob, Choice):
            self.field: Any = Select(
                title=knob.label, options=list(knob.words), value=str(value), width=WIDTH
            )
            self.layout = column(self.field, self.error)
        else:
            unit = f" [{knob.unit}]" if knob.unit else ""
            self.slider = Slider(
                start=0, end=STEPS, step=1, value=knob.place(float(value)), show_value=False,
                title=f"{knob.label}{unit}", width=WIDTH - 100, name=f"slider_{knob.name}",
            )  # fmt: skip
            self.field = TextInput(value=_text(value), width=85)
            self.slider.on_change("value", self._slid)
            self.layout = column(row(self.slider, self.field), self.error)
        self.field.name = knob.name
        self.field.on_change("value", self._typed)

    def set(self, value: Value) -> None:
        """Move the knob, unheard."""
        self._quiet = True
        self.field.value = str(value) if isinstance(self.knob, Choice) else _text(value)
        if isinstance(self.knob, Knob):
            self.slider.value = self.knob.place(float(value))
        self._quiet = False
        self.say("")

    def say(self, text: str) -> None:
        """Say at the knob what is wrong with it; '' for nothing."""
        self.error.text = escape(text)
        # a model that becomes visible would take the focus from the field
        self.error.styles = {**ERROR, "display": "block"} if text else NOTHING

    def _slid(self, attribute: str, old: int, new: int) -> None:
        if self._quiet or not isinstance(self.knob, Knob):
            return
        value = self.knob.at(new)
        self._quiet = True
        self.field.value = _text(value)
        self._quiet = False
        self._turned(self.knob.name, value)

    def _typed(self, attribute: str, old: str, new: str) -> None:
        if self._quiet:
            return
        try:
            value = self.knob.read(new.strip())
        except InputError as error:
            self.say(str(error))
            return
        if isinstance(self.knob, Knob):
            self._quiet = True
            self.slider.value = self.knob.place(float(value))
            self._quiet = False
        self._turned(self.knob.name, value)


def _text(value: Value) -> str:
    return f"{value:.12g}" if isinstance(value, float) else str(value)
