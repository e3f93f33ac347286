# SPDX-License-Identifier: BSD-3-Clause
"""Downloads of a page: the report, and the figures with the width of a journal."""

import io
import tempfile
import threading
import zipfile
from pathlib import Path

from pyehl import api
from pyehl.app.position import Position
from pyehl.plots.folder import plot
from pyehl.reports.folder import report

# The settings of matplotlib belong to the process: one thread draws at a time
_DRAWING = threading.Lock()


def _results(position: Position, points: int, folder: Path) -> Path:
    """Write the result folder of a position: the prediction of a rough contact, else the film."""
    case, place = position.case(points), folder / "result"
    if position.rough:
        api.predict(case, output=place, plots=False)
    else:
        api.solve(case, output=place, check=False)
    return place


def report_page(position: Position, points: int) -> bytes:
    """Make the report of a position, as ``pyehl report``. EhlError if that fails."""
    with tempfile.TemporaryDirectory(prefix="pyehl-") as name:
        place = _results(position, points, Path(name))
        with _DRAWING:
            return report(place).read_bytes()


def figures(position: Position, points: int, suffix: str, width: float) -> bytes:
    """Make the figures of a position as a ZIP file, with a width [m] or their own (0)."""
    with tempfile.TemporaryDirectory(prefix="pyehl-") as name:
        place = _results(position, points, Path(name))
        made = Path(name) / "figures"
        with _DRAWING:
            plot(place, made, format=suffix, width=width)
        return _zipped(made)


def _zipped(folder: Path) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(folder.iterdir()):
            archive.write(path, path.name)
    return stream.getvalue()
