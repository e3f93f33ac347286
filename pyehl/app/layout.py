# SPDX-License-Identifier: BSD-3-Clause
"""Layout of the page, and its texts."""

import base64
from collections.abc import Callable, Mapping, Sequence
from html import escape
from typing import Any, Protocol

from bokeh.layouts import column, row
from bokeh.models import (
    Button,
    ColumnDataSource,
    CustomJS,
    Div,
    FileInput,
    RadioButtonGroup,
    Select,
    TextAreaInput,
)

from pyehl.app.answers import CURVES
from pyehl.app.controls import GROUPS, Value, shown
from pyehl.app.figures import Pictures
from pyehl.app.position import Position
from pyehl.app.widgets import ERROR, WIDTH, ControlWidget

SAVE = """
const bytes = Uint8Array.from(atob(source.data.data[0]), c => c.charCodeAt(0));
const link = document.createElement('a');
link.href = URL.createObjectURL(new Blob([bytes]));
link.download = source.data.name[0];
link.click();
setTimeout(() => URL.revokeObjectURL(link.href), 1000);
"""
SAVE_TEXT = """
const link = document.createElement('a');
link.href = URL.createObjectURL(new Blob([area.value], {type: 'text/plain'}));
link.download = 'case.nml';
link.click();
setTimeout(() => URL.revokeObjectURL(link.href), 1000);
"""
COPY = "navigator.clipboard.writeText(area.value);"
FORMATS = ("png", "svg", "pdf")
WIDTHS = {"0": "as they are", "84": "84 mm (one column)", "174": "174 mm (two columns)"}
MAPS = ".npy,.txt,.csv,.dat,.asc,.x3p,.sdf,.al3d,.opd,.plux,.sur,.gwy,.nc,.h5"

# Each part and each picture is its own root: after a change of size, even of a text, the browser
# lays out the root again and repaints all pictures in it
TEMPLATE = """
{% block contents %}
<div style="display: flex">
<div>{{ embed(roots.controls) }}</div>
<div>
{{ embed(roots.tabs) }}
{% for picture in pictures %}
<div class="picture" {{ "hidden" if loop.index0 }}>{{ embed(roots[picture.head]) if picture.head }}
{% for row in picture.rows %}
<div style="display: flex">
{% for name in row %}<div>{{ embed(roots[name]) }}</div>{% endfor %}
</div>
{% endfor %}
</div>
{% endfor %}
</div>
<div>{% for part in ("state", "film", "surface", "files") %}
<div>{{ embed(roots[part]) }}</div>
{% endfor %}</div>
</div>
{% endblock %}
"""
PICTURES = (
    {"title": "Film", "rows": (("fringes", "contour"), ("along", "across"))},
    {"title": "Roughness", "rows": (("rough_hint",), ("before", "after"), ("bands", "over"))},
    {"title": "Curve", "head": "curves", "rows": (("curve_hint",), ("curve_film", "curve_ratio"))},
)
SHOW = """
document.querySelectorAll('.picture').forEach((part, k) => part.hidden = k !== tabs.active)
"""


class _Handlers(Protocol):
    """Handlers of the page for events."""

    def changed(self, name: str, value: Value) -> None: ...
    def open_case(self, name: str, data: bytes) -> None: ...
    def upload(self, name: str, data: bytes) -> None: ...
    def draw_curve(self, over: str) -> None: ...
    def fetch(self, what: str) -> None: ...
    def soon(self, do: Callable[[], None]) -> None: ...


def _table(rows: Sequence[tuple[str, str]]) -> str:
    cells = "".join(
        f"<tr><td style='padding-right:1em;vertical-align:top'>{escape(name)}</td>"
        f"<td><b>{escape(value)}</b></td></tr>"
        for name, value in rows
    )
    return f"<table>{cells}</table>"


class Layout:
    """All elements of the page except the pictures."""

    def __init__(self, handlers: _Handlers, pictures: Pictures, start: Position) -> None:
        self.controls = {
            control.name: ControlWidget(control, start.values[control.name], handlers.changed)
            for group in GROUPS.values()
            for control in group
        }
        self.status = Div(text="", name="status", width=350)
        self.note = Div(text="", name="note", width=WIDTH, styles={"font-size": "85%"})
        self.numbers = Div(text="", name="numbers", width=350)
        self.rough = Div(text="", name="rough", width=350)
        # generation requested, generation shown, and its nodes per side
        self.stamp = ColumnDataSource(
            {"asked": [0], "generation": [0], "points": [0]}, name="stamp"
        )
        self.download = ColumnDataSource({"name": [""], "data": [""]}, name="download")
        self.download.js_on_change("data", CustomJS(args={"source": self.download}, code=SAVE))
        self.case = TextAreaInput(
            title="case file", rows=14, width=350, name="case", disabled=True,
            stylesheets=["textarea{font-family:monospace;font-size:80%}"],
        )  # fmt: skip
        self.python = TextAreaInput(
            title="the same in Python", rows=14, width=350, name="python", disabled=True,
            stylesheets=["textarea{font-family:monospace;font-size:80%}"],
        )  # fmt: skip
        self.open_error = Div(text="", name="open_error", styles=ERROR, width=350)
        self.upload_error = Div(text="", name="upload_error", styles=ERROR, width=WIDTH)
        self.download_progress = Div(text="", name="download_progress", width=350)
        self.figure_format = Select(options=list(FORMATS), value="png", width=80)
        self.figure_width = Select(options=list(WIDTHS.items()), value="0", width=170)
        self.upload = FileInput(accept=MAPS, name="upload", title="height map")
        self.upload.on_change("value", self._file(handlers, self.upload, handlers.upload))
        self.map_box = column(self.upload, self.upload_error, visible=False)
        self.tabs = RadioButtonGroup(labels=[part["title"] for part in PICTURES], active=0)
        self.tabs.js_on_change("active", CustomJS(args={"tabs": self.tabs}, code=SHOW))
        self.roots = {
            "controls": self._left(start),
            "tabs": self.tabs,
            "curves": self._curves(handlers),
            **pictures.figures,
            "state": column(self.status),
            "film": column(self.numbers),
            "surface": column(self.rough),
            "files": self._right(handlers),
        }
        for name, root in self.roots.items():
            root.name = name
        # invisible models must be in the document to reach the browser
        self.roots["files"].tags = [self.stamp, self.download, pictures.changes.source]

    def _file(
        self,
        handlers: _Handlers,
        widget: Any,  # noqa: ANN401
        take: Callable[[str, bytes], None],
    ) -> Callable[[str, object, object], None]:
        """Handle a chosen file; its name and its content arrive one after the other."""
        waits = False

        def chosen() -> None:
            nonlocal waits
            waits = False
            take(str(widget.filename), base64.b64decode(widget.value))

        def heard(attribute: str, old: object, new: object) -> None:
            nonlocal waits
            if not waits:
                waits = True
                handlers.soon(chosen)

        widget.on_change("filename", heard)
        return heard

    def _left(self, start: Position) -> Any:  # noqa: ANN401
        parts: list[Any] = [self.note]
        for title, group in GROUPS.items():
            parts.append(Div(text=f"<b>{escape(title)}</b>"))
            parts += [self.controls[control.name].layout for control in group]
        parts.append(self.map_box)
        self.show_controls(start.values)
        return column(*parts, width=WIDTH + 20)

    def _curves(self, handlers: _Handlers) -> Any:  # noqa: ANN401
        buttons = []
        for name in CURVES:
            button = Button(label=f"curve over {name}", name=f"curve_{CURVES[name]}")
            button.on_click(lambda name=name: handlers.draw_curve(name))
            buttons.append(button)
        return row(*buttons)

    def _right(self, handlers: _Handlers) -> Any:  # noqa: ANN401
        copy, save = Button(label="Copy", name="copy"), Button(label="Save", name="save")
        copy.js_on_click(CustomJS(args={"area": self.case}, code=COPY))
        save.js_on_click(CustomJS(args={"area": self.case}, code=SAVE_TEXT))
        opened = FileInput(accept=".nml,.txt", name="open", title="open a case file")
        opened.on_change("value", self._file(handlers, opened, handlers.open_case))
        copy_python = Button(label="Copy", name="copy_python")
        copy_python.js_on_click(CustomJS(args={"area": self.python}, code=COPY))
        report = Button(label="Report", name="fetch_report")
        report.on_click(lambda: handlers.fetch("report.html"))
        figures = Button(label="Figures", name="fetch_figures")
        figures.on_click(lambda: handlers.fetch("figures.zip"))
        return column(
            self.case, row(copy, save), opened,
            self.open_error, self.python, copy_python,
            row(report, figures, self.figure_format, self.figure_width), self.download_progress,
        )  # fmt: skip

    def show_controls(self, values: Mapping[str, Value]) -> None:
        """Show the controls that apply."""
        for name, control in self.controls.items():
            control.layout.visible = shown(name, values)
        self.map_box.visible = values["surface"] == "map"

    def show_case(self, case: str, python: str) -> None:
        """Show the case file and the Python lines of the position."""
        self.case.value, self.python.value = case, python

    def busy(self, points: int) -> None:
        """Show that the numbers belong to an earlier position."""
        self._say(f"computing on {points} × {points} nodes …", "color:#666666")

    def failed(self, text: str) -> None:
        """Show why there is no result."""
        self._say(text, "color:#b00020;font-weight:bold")

    def _say(self, text: str, style: str) -> None:
        # text and colour in one change for the browser
        self.status.text = f'<span style="{style}">{escape(text)}</span>'

    def show_film(self, rows: Sequence[tuple[str, str]], status: str, *, converged: bool) -> None:
        """Show the numbers of the smooth contact, and whether there is a solution."""
        self.numbers.text = _table(rows)
        if converged:
            self._say(status, "color:#006e4e")
        else:
            self.failed(status)

    def show_rough(self, rows: Sequence[tuple[str, str]]) -> None:
        """Show the numbers of the rough contact; none for a smooth one."""
        self.rough.text = f"<b>Rough contact</b>{_table(rows)}" if rows else ""

    def fetched(self, text: str) -> None:
        """Show the progress of a download."""
        self.download_progress.text = escape(text)
