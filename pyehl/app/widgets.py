# SPDX-License-Identifier: BSD-3-Clause
"""A control on the page: a slider, a text field, and an error message."""

from collections.abc import Callable
from html import escape
from typing import Any

from bokeh.layouts import column, row
from bokeh.models import Div, Select, Slider, TextInput

from pyehl.app.controls import STEPS, Choice, Control, Value
from pyehl.errors import InputError

WIDTH = 300
ERROR = {"color": "#b00020", "white-space": "pre-wrap", "font-size": "85%"}
NOTHING = {"display": "none"}


class ControlWidget:
    """A control on the page; a change by the user calls `changed` with its name and value."""

    def __init__(
        self, control: Control | Choice, value: Value, changed: Callable[[str, Value], None]
    ) -> None:
        self.control, self._changed = control, changed
        # set while the page itself changes the control
        self._quiet = False
        self.error = Div(
            text="", styles=NOTHING, width=WIDTH, margin=(0, 5, 0, 5), name=f"error_{control.name}"
        )
        self.slider: Any = None
        if isinstance(control, Choice):
            self.field: Any = Select(
                title=control.label, options=list(control.words), value=str(value), width=WIDTH
            )
            self.layout = column(self.field, self.error)
        else:
            unit = f" [{control.unit}]" if control.unit else ""
            self.slider = Slider(
                start=0, end=STEPS, step=1, value=control.place(float(value)), show_value=False,
                title=f"{control.label}{unit}", width=WIDTH - 100, name=f"slider_{control.name}",
            )  # fmt: skip
            self.field = TextInput(value=_text(value), width=85)
            self.slider.on_change("value", self._slid)
            self.layout = column(row(self.slider, self.field), self.error)
        self.field.name = control.name
        self.field.on_change("value", self._typed)

    def set(self, value: Value) -> None:
        """Set the control without calling `changed`."""
        self._quiet = True
        self.field.value = str(value) if isinstance(self.control, Choice) else _text(value)
        if isinstance(self.control, Control):
            self.slider.value = self.control.place(float(value))
        self._quiet = False
        self.say("")

    def say(self, text: str) -> None:
        """Show an error at the control; '' for none."""
        self.error.text = escape(text)
        # a model that becomes visible would take the focus from the field
        self.error.styles = {**ERROR, "display": "block"} if text else NOTHING

    def _slid(self, attribute: str, old: int, new: int) -> None:
        if self._quiet or not isinstance(self.control, Control):
            return
        value = self.control.at(new)
        self._quiet = True
        self.field.value = _text(value)
        self._quiet = False
        self._changed(self.control.name, value)

    def _typed(self, attribute: str, old: str, new: str) -> None:
        if self._quiet:
            return
        try:
            value = self.control.read(new.strip())
        except InputError as error:
            self.say(str(error))
            return
        if isinstance(self.control, Control):
            self._quiet = True
            self.slider.value = self.control.place(float(value))
            self._quiet = False
        self._changed(self.control.name, value)


def _text(value: Value) -> str:
    return f"{value:.12g}" if isinstance(value, float) else str(value)
