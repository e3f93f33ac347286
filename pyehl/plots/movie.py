# SPDX-License-Identifier: BSD-3-Clause
"""The frames of a transient run as a movie: film, pressure and deformed roughness."""

import math
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib import animation
from matplotlib.artist import Artist

from pyehl.destination import check_files, mark, new_file
from pyehl.errors import InputError
from pyehl.plots import contact, transient
from pyehl.plots.figures import scales_of
from pyehl.plots.outline import Outline
from pyehl.plots.panels import headline
from pyehl.plots.style import PAGE, film_unit, nearest, new_figure, styled
from pyehl.results import settings_of
from pyehl.schema import summary_of
from pyehl.theory.line_contact import scaling_contact

SUFFIXES = ("gif", "mp4")
FRAME_SECONDS, DPI = 0.08, 150
# A GIF counts hundredths of a second, and viewers slow down shorter frames
MIN_SECONDS, MAX_SECONDS = 0.02, 10.0


def _pace(data: xr.Dataset, seconds: float, *, si: bool) -> str:
    """State the duration of a frame, and the time in the contact between frames."""
    times = data["T"].values
    between = float(np.median(np.diff(times))) if times.size > 1 else 0.0
    text = f"{between:.3g} a/u"
    if si:
        unit = scaling_contact(settings_of(data)).time_scale
        text += f" = {between * unit * 1e6:.3g} µs"
    return f"{seconds:.3g} s per frame, which is {text} in the contact"


def movie(
    data: xr.Dataset,
    target: Path,
    suffix: str = "gif",
    units: str = "auto",
    seconds: float = FRAME_SECONDS,
) -> Path:
    """Write the frames of a transient run as ``movie.gif`` or ``movie.mp4`` into a folder.

    `data` is from a run with ``output.frame_interval`` above 0; each frame is shown for `seconds`,
    which the title states with the time between frames in the contact. The panels are the film as
    fringes, pressure and film on the centre line, and the deformed roughness if there is one.
    InputError if there are no frames, the contact is a line, `seconds` are out of range, there is
    no program ffmpeg for 'mp4', or another file has the name.
    """
    if "frame_H" not in data or data.sizes["T"] == 0:
        raise InputError(
            "there are no frames to make a movie of\n"
            "expected: the result of a transient run with output.frame_interval, such as 0.05"
        )
    if data.attrs.get("shape") == "line":
        raise InputError(
            "contact.shape = 'line': a movie shows maps, which a line does not have\n"
            "expected: 'pyehl plot' of its result"
        )
    if not (math.isfinite(seconds) and MIN_SECONDS <= seconds <= MAX_SECONDS):
        raise InputError(
            f"frame_seconds = {seconds:g}: expected {MIN_SECONDS:g} ... {MAX_SECONDS:g} s"
        )
    if suffix == "mp4" and not animation.writers.is_available("ffmpeg"):
        raise InputError("an MP4 needs the program ffmpeg, which is not installed\nexpected: GIF")
    # a GIF has whole hundredths of a second
    seconds = round(100.0 * seconds) / 100.0 if suffix == "gif" else seconds
    scales = scales_of(data, units)
    outline = Outline.of(data)
    x, y, times = (data[name].values for name in "XYT")
    row = nearest(y, 0.0)
    top_pressure = 1.05 * max(1.0, float(data.frame_P.max()))
    # a duty of smooth surfaces has no deformed roughness
    rough = "H_smooth" in data
    smooth = data["H_smooth" if rough else "H"].values
    central = float(smooth[nearest(x, 0.0), row]) * film_unit(scales)[0]
    fringes = contact.fringe_spacings(central, scales)
    deformed = smooth[:, :, np.newaxis] - data["frame_H"].values
    top = 0.0
    if rough:
        top = transient.roughness_top(x, y, *np.moveaxis(deformed, 2, 0), outline=outline)
    figure = new_figure(PAGE, 2.6)
    title = f"{headline(summary_of(data), scales)}\n{_pace(data, seconds, si=scales is not None)}"

    @styled()
    def draw(frame: int) -> list[Artist]:
        figure.clear()
        left, middle, *others = figure.subplots(1, 3 if rough else 2)
        pressure, film = (data[name].values[:, :, frame] for name in ("frame_P", "frame_H"))
        contact.interferogram(x, y, film, scales, fringes=fringes, outline=outline, ax=left)
        contact.pressure_and_film(
            x, pressure[:, row], film[:, row], scales, half=outline.chords[0], ax=middle
        )
        middle.set_ylim(0.0, top_pressure * (1.0 if scales is None else scales.pressure * 1e-9))
        middle.set_xlim(left.get_xlim())
        for right in others:
            transient.roughness(
                x, y, deformed[:, :, frame], scales,
                top=top, name="deformed,", bar=True, outline=outline, ax=right,
            )  # fmt: skip
        figure.suptitle(f"{title};  T = {times[frame]:.2f}")
        return []

    path = target / f"movie.{suffix}"
    check_files([path], "plot")
    moving = animation.FuncAnimation(figure, draw, frames=times.size, blit=False)
    writer: animation.AbstractMovieWriter
    if suffix == "mp4":
        about = {"comment": mark("plot")}
        writer = animation.FFMpegWriter(fps=1.0 / seconds, metadata=about)  # type: ignore[arg-type]
    else:
        # whole milliseconds, because the writer truncates them
        rate = 1000.0 / (round(1000.0 * seconds) + 0.25)
        writer = animation.PillowWriter(fps=rate)  # type: ignore[arg-type]
    with new_file(path) as partial:
        moving.save(partial, writer=writer, dpi=DPI)
        if suffix == "gif":
            # bytes after the end of a GIF are ignored
            with partial.open("ab") as stream:
                stream.write(mark("plot").encode())
    return path
