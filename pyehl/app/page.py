# SPDX-License-Identifier: BSD-3-Clause
"""One page, a tab of the browser: its controls, workers and pictures."""

import base64
import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from html import escape
from typing import Any

from bokeh.core.templates import get_env
from bokeh.document import Document
from bokeh.events import DocumentReady

from pyehl.app import answers, downloads, words
from pyehl.app.answers import COARSE, CURVES, FINE, Film, Rough
from pyehl.app.controls import CONTROLS, Value
from pyehl.app.figures import Pictures
from pyehl.app.layout import PICTURES, TEMPLATE, Layout
from pyehl.app.position import Position, from_case
from pyehl.app.uploads import Uploads
from pyehl.app.worker import JobContext, Worker
from pyehl.case import Case
from pyehl.errors import EhlError, InputError

# Nodes per side of the case file, the report and the figures
POINTS = FINE[-1]
CURVE_POINTS = 9
REPORT = "report.html"
DOWNLOADS = (REPORT, "figures.zip")
NO_MAP = "there is no height map yet: expected an upload; the contact is smooth until then"


class Page:
    """The page of one tab, from the start to the end of its session."""

    def __init__(self, document: Document, start: Position, note: str = "") -> None:
        self.document, self.position = document, start
        # state of the controls: that of the position, except for a map that is still missing
        self._wish = start
        self.uploads = Uploads()
        # an uploaded file that could not be read yet, because its size is missing
        self._pending: tuple[str, bytes] | None = None
        self.pictures = Pictures()
        self.layout = Layout(self, self.pictures, start)
        self._shown = 0
        # results shown of both contacts
        self._rough: Rough | None = None
        self._film: Film | None = None
        self._films: dict[int, Film] = {}
        self.worker = Worker(partial(self._later, self._answered), "pyehl-page")
        self.curves = Worker(partial(self._later, self._drawn), "pyehl-curve")
        self.downloads = {
            name: Worker(partial(self._later, partial(self._fetched, name)), "pyehl-download")
            for name in DOWNLOADS
        }
        self._making: list[str] = []
        document.title = "pyehl"
        document.template = get_env().from_string("{% extends base %}" + TEMPLATE)
        document.template_variables["pictures"] = PICTURES
        # without freezing, Bokeh would traverse all models again for each root
        with document.models.freeze():
            for root in self.layout.roots.values():
                document.add_root(root)
        document.on_session_destroyed(self._ended)
        self.layout.note.text = escape(note)
        self._show_case()
        # the browser does not receive earlier messages
        document.on_event(DocumentReady, self._ready)

    def _ready(self, event: object) -> None:
        self._moved()

    def _ended(self, context: object) -> None:
        # in a thread, so that other pages are served meanwhile
        threading.Thread(target=self.close, daemon=True).start()

    def close(self) -> None:
        """End the threads, free the solvers, then remove the uploads."""
        for worker in self.workers:
            worker.close()
        self.uploads.close()

    @property
    def workers(self) -> tuple[Worker, ...]:
        """All threads of the page."""
        return self.worker, self.curves, *self.downloads.values()

    def _later(self, show: Any, generation: int, answer: Any) -> None:  # noqa: ANN401
        """Show what a worker reports when the page has time; called in its thread."""
        self.document.add_next_tick_callback(partial(show, generation, answer))

    def soon(self, do: Callable[[], None]) -> None:
        """Call a function once all parts of the present message have arrived."""
        self.document.add_next_tick_callback(do)

    def changed(self, name: str, value: Value) -> None:
        """Apply a changed control; an error is shown there, and the results stay."""
        wish = self._wish.changed(name, value)
        self.layout.show_controls(wish.values)
        if name in ("map_x", "map_y") and self._pending is not None:
            self._wish = wish
            self.upload(*self._pending)
            return
        # the contact is smooth until there is a map
        missing = wish.values["surface"] == "map" and not wish.file
        tried = wish.changed("surface", "smooth") if missing else wish
        try:
            tried.case(COARSE)
            if tried.values["surface"] == "map" and name in ("surface", "map_x", "map_y"):
                self.uploads.check(tried.file, tried.map_message())
        except InputError as error:
            self.layout.controls[name].say(self.uploads.without_folders(str(error)))
            return
        self.layout.controls[name].say("")
        self.layout.controls["surface"].say(NO_MAP if missing else "")
        self._wish, self.position = wish, tried
        self._moved()

    def _moved(self) -> None:
        """Compute the position, and update the case file."""
        generation = self.worker.submit(answers.follow(self.position, self._films))
        self._show_case()
        if self._rough is not None and not self.position.rough:
            self._rough = None
            self.layout.show_rough([])
            self.pictures.show_rough(Rough(None))
        self.layout.stamp.data = {**self.layout.stamp.data, "asked": [generation]}

    def _show_case(self) -> None:
        self.layout.show_case(self.position.text(POINTS), words.python_lines(self.position, POINTS))
        self.layout.busy(COARSE)

    def _answered(self, generation: int, answer: Film | Rough | Exception) -> None:
        """Show an answer, unless a newer one is shown."""
        if generation < self._shown or self.worker.closed:
            return
        if isinstance(answer, Rough) and not self.position.rough:
            # the surface has been set to smooth since
            return
        self._shown = generation
        self.document.hold("combine")
        if isinstance(answer, Film):
            self.pictures.show_film(answer)
            rows, status = words.film_rows(answer), words.status_line(answer)
            self.layout.show_film(rows, status, converged=answer.converged)
            self._film = answer
            self._show_rough()
        elif isinstance(answer, Rough):
            self._rough = answer
            self.pictures.show_rough(answer)
            self._show_rough()
        else:
            self.layout.failed(self.uploads.without_folders(str(answer)))
        points = answer.points if isinstance(answer, Film) else 0
        stamp = self.layout.stamp.data
        self.layout.stamp.data = {
            **stamp,
            "generation": [generation],
            "points": [points or stamp["points"][0]],
        }
        self.document.unhold()

    def _show_rough(self) -> None:
        """Show the numbers of the rough contact beside those of the smooth one."""
        if self._rough is not None:
            rows = words.rough_rows(self._rough, self._film)
            self.layout.show_rough([(a, self.uploads.without_folders(b)) for a, b in rows])

    def open_case(self, name: str, data: bytes) -> None:
        """Set the controls by an uploaded case file."""
        try:
            text = data.decode("utf-8-sig")
            case = Case.from_text(text, origin=name)
            self._wish, note = from_case(case, self.uploads.files)
            self.position = self._wish
        except (InputError, UnicodeDecodeError) as error:
            self.layout.open_error.text = escape(self.uploads.without_folders(str(error)))
            return
        self.layout.open_error.text = ""
        self.layout.note.text = escape(note)
        for control, value in self.position.values.items():
            self.layout.controls[control].set(value)
        self.layout.show_controls(self.position.values)
        self._moved()

    def upload(self, name: str, data: bytes) -> None:
        """Add a height map, or show the error of its reader."""
        try:
            path = self.uploads.add(name, data, self._wish.map_message())
            wish = replace(self._wish.changed("surface", "map"), file=path)
            wish.case(COARSE)
        except InputError as error:
            self._pending = name, data
            self.layout.upload_error.text = escape(self.uploads.without_folders(str(error)))
            return
        self._pending = None
        self.layout.upload_error.text = ""
        self._wish = self.position = wish
        self.layout.controls["surface"].set("map")
        self.layout.show_controls(wish.values)
        self._moved()

    def draw_curve(self, over: str) -> None:
        """Compute a curve over a control, point by point."""
        control = CURVES[over]
        here = self.position
        unit = CONTROLS[control].unit  # type: ignore[union-attr]
        label = f"{over} [{unit}]" if unit else over
        about = ", ".join(
            f"{name} = {here.values[key]:g} {unit}".strip()
            for name, key, unit in (
                ("w", "load", "N"),
                ("u", "velocity", "m/s"),
                ("SRR", "slide_to_roll", ""),
            )
            if key != control
        )
        values = answers.places(here, control, CURVE_POINTS)

        def job(context: JobContext) -> None:
            for points in answers.curve(here, control, values, context.newest):
                context.answer_with((points, values, label, about))

        self.curves.submit(job)

    def fetch(self, what: str) -> None:
        """Make a file to download, one of `DOWNLOADS`."""
        here, layout = self.position, self.layout
        suffix, width = layout.figure_format.value, float(layout.figure_width.value) * 1e-3

        def job(context: JobContext) -> None:
            if what == REPORT:
                data = downloads.report_page(here, POINTS)
            else:
                data = downloads.figures(here, POINTS, suffix, width)
            context.answer_with(data)

        self._making.append(what)
        self._say_making()
        self.downloads[what].submit(job)

    def _say_making(self, why: str = "") -> None:
        names = ", ".join(dict.fromkeys(self._making))
        self.layout.fetched(why or (f"making {names} …" if names else ""))

    def _fetched(self, what: str, generation: int, answer: bytes | Exception) -> None:
        """Send a file to the browser, or show why there is none."""
        if self.worker.closed:
            return
        why = ""
        if isinstance(answer, Exception):
            text = str(answer) if isinstance(answer, EhlError | OSError) else repr(answer)
            why = self.uploads.without_folders(text)
        else:
            data = base64.b64encode(answer).decode()
            self.layout.download.data = {"name": [what], "data": [data]}
        if generation == self.downloads[what].generation:
            self._making = [name for name in self._making if name != what]
        self._say_making(why)

    def _drawn(self, generation: int, answer: Any) -> None:  # noqa: ANN401
        """Show the finished points of a curve, or why there are none."""
        if self.curves.closed:
            return
        if isinstance(answer, Exception):
            self.layout.fetched(self.uploads.without_folders(str(answer)))
        else:
            self.pictures.show_curve(*answer)
