# SPDX-License-Identifier: BSD-3-Clause
"""The frames of a transient run as a moving picture: fringes of the film, pressure and film."""

from __future__ import annotations

from pathlib import Path

import xarray as xr
from matplotlib import animation
from matplotlib.artist import Artist

from pyehl.destination import check_files, mark, new_file
from pyehl.errors import InputError
from pyehl.plots import contact
from pyehl.plots.figures import headline, scales_of
from pyehl.plots.outline import Outline
from pyehl.plots.style import film_unit, nearest, new_figure

__all__ = ["movie"]

SUFFIXES = ("gif", "mp4")
FRAMES_PER_SECOND, DPI = 12, 100


def movie(data: xr.Dataset, target: Path, suffix: str = "gif", units: str = "auto") -> Path:
    """Write the frames of a transient run as ``movie.gif`` or ``movie.mp4`` into a folder.

    `data` is of a run with ``output.frame_interval`` above 0. InputError if there are no frames,
    or no program ffmpeg for 'mp4', or another file has the name.
    """
    if "frame_H" not in data or data.sizes["T"] == 0:
        raise InputError(
            "there are no frames to make a movie of\n"
            "expected: the result of a transient run with output.frame_interval, such as 0.05"
        )
    if suffix == "mp4" and not animation.writers.is_available("ffmpeg"):
        raise InputError("an MP4 needs the program ffmpeg, which is not here\nexpected: GIF")
    scales = scales_of(data, units)
    x, y, times = (data[name].values for name in "XYT")
    row = nearest(y, 0.0)
    most = 1.05 * max(1.0, float(data.frame_P.max()))
    central = float(data["H_smooth"].values[nearest(x, 0.0), row]) * film_unit(scales)[0]
    fringes = contact.fringe_spacings(central, scales)
    figure = new_figure(8.0, 3.8)
    title = headline(data.attrs, scales)

    def draw(frame: int) -> list[Artist]:
        figure.clear()
        left, right = figure.subplots(1, 2)
        pressure, film = (data[name].values[:, :, frame] for name in ("frame_P", "frame_H"))
        contact.interferogram(
            x, y, film, scales, fringes=fringes, outline=Outline.of(data), ax=left
        )
        contact.pressure_and_film(x, pressure[:, row], film[:, row], scales, ax=right)
        right.set_ylim(0.0, most * (1.0 if scales is None else scales.pressure * 1e-9))
        right.set_xlim(left.get_xlim())
        figure.suptitle(f"{title}\n$T$ = {times[frame]:.2f}", fontsize="medium")
        return []

    path = target / f"movie.{suffix}"
    check_files([path], "plot")
    moving = animation.FuncAnimation(figure, draw, frames=times.size, blit=False)
    writer: animation.AbstractMovieWriter
    if suffix == "mp4":
        writer = animation.FFMpegWriter(fps=FRAMES_PER_SECOND, metadata={"comment": mark("plot")})
    else:
        writer = animation.PillowWriter(fps=FRAMES_PER_SECOND)
    with new_file(path) as partial:
        moving.save(partial, writer=writer, dpi=DPI)
        if suffix == "gif":
            # what follows the end of a GIF is passed over
            with partial.open("ab") as stream:
                stream.write(mark("plot").encode())
    return path
