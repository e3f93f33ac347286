# SPDX-License-Identifier: BSD-3-Clause
"""Fields in the form that the page draws: colours, levels, lines, in mm, nm and GPa."""

import math
from typing import NamedTuple

import contourpy
import numpy as np
import scipy
from numpy.typing import NDArray

from pyehl.app.answers import Film
from pyehl.plots.contact import fringe_colours, fringe_spacings
from pyehl.plots.outline import Outline
from pyehl.plots.style import Scales
from pyehl.prediction.result import Prediction
from pyehl.types import Array

# Half width of the pictures over that of the dry contact
VIEW = 1.3
# Minimum number of pixels of the longer side of the fringes
PIXELS = 240
# Number of contours from the minimum film to the maximum one
LEVELS = 20
MAX_FILM = 1.6
"""Maximum film of the colours and the contours, over the central film."""


class Map(NamedTuple):
    """The film around the contact: colours as RGBA, film (n, m) [nm], nodes x (m,), y (n,) [mm].

    The colours have one or more pixels per node, on a rectangle from left and bottom with a width
    and a height [mm].
    """

    colours: NDArray[np.uint32]
    film: Array
    central: float  # film at the centre [nm]
    left: float
    bottom: float
    width: float
    height: float
    x: Array
    y: Array
    caption: str


def _edge(result: Film) -> Outline:
    """Edge of the dry contact in Hertz radii."""
    angle = float(result.summary.get("angle_deg") or 0.0)
    return Outline(result.point.ellipse.ellipticity, angle)


def film_map(result: Film) -> Map:
    """Film of a solution as two-colour fringes and as numbers; rows are across the motion."""
    along, across = _edge(result).reach
    inside_x, inside_y = np.abs(result.x) <= VIEW * along, np.abs(result.y) <= VIEW * across
    film = result.film[np.ix_(inside_x, inside_y)] * result.point.film_scale * 1e9
    x = result.x[inside_x] * result.point.hertz_radius * 1e3
    y = result.y[inside_y] * result.point.hertz_radius * 1e3
    middle = int(np.argmin(np.abs(x))), int(np.argmin(np.abs(y)))
    central = float(film[middle])
    point = result.point
    scales = Scales(point.hertz_radius, point.hertz_pressure, point.film_scale, thin=True)
    red, green = fringe_spacings(central, scales)
    factor = math.ceil(PIXELS / max(film.shape))
    fine = scipy.ndimage.zoom(film, factor, order=1, grid_mode=True, mode="nearest")
    colours = (255.0 * fringe_colours(fine, red, green)).round().astype(np.uint8)
    rgba = np.full((*colours.shape[:2], 4), 255, dtype=np.uint8)
    rgba[..., :3] = colours
    packed = np.ascontiguousarray(rgba.transpose(1, 0, 2)).view(np.uint32)[..., 0]
    step_x, step_y = x[1] - x[0], y[1] - y[0]
    return Map(
        packed,
        np.ascontiguousarray(film.T),
        central,
        float(x[0] - 0.5 * step_x),
        float(y[0] - 0.5 * step_y),
        float(x[-1] - x[0] + step_x),
        float(y[-1] - y[0] + step_y),
        x,
        y,
        f"a fringe: {red:.3g} nm (red), {green:.3g} nm (green)",
    )


def contour_lines(made: Map) -> tuple[Array, Array]:
    """Lines of equal film as one line x, y [mm], interrupted by NaN."""
    low, high = float(made.film.min()), MAX_FILM * made.central
    step = _round((high - low) / LEVELS)
    levels = step * np.arange(math.ceil(low / step), math.floor(high / step) + 1)
    generator = contourpy.contour_generator(
        made.x, made.y, made.film, name="serial", line_type="ChunkCombinedNan"
    )
    result = [generator.lines(float(level))[0][0] for level in levels]
    lines = [line for line in result if line is not None]
    gap = np.full((1, 2), np.nan)
    whole = np.concatenate([part for line in lines for part in (line, gap)] or [gap])
    return np.ascontiguousarray(whole[:, 0]), np.ascontiguousarray(whole[:, 1])


def _round(value: float) -> float:
    """Round up to 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(s * power for s in (1.0, 2.0, 5.0, 10.0) if s * power >= value * (1 - 1e-12))


def centre_lines(result: Film) -> dict[str, dict[str, Array]]:
    """Pressure [GPa], film [nm] and Hertz pressure on the lines through the centre, over mm."""
    i, j = int(np.argmin(np.abs(result.x))), int(np.argmin(np.abs(result.y)))
    point = result.point
    half_x, half_y = _edge(result).chords
    lines = {}
    for name, axis, half, pressure, film in (
        ("x", result.x, half_x, result.pressure[:, j], result.film[:, j]),
        ("y", result.y, half_y, result.pressure[i, :], result.film[i, :]),
    ):
        dry = np.sqrt(np.maximum(0.0, 1.0 - (axis / half) ** 2))
        lines[name] = {
            "place": axis * point.hertz_radius * 1e3,
            "pressure": pressure * point.hertz_pressure * 1e-9,
            "hertz": dry * point.hertz_pressure * 1e-9,
            "film": film * point.film_scale * 1e9,
        }
    return lines


def outline(result: Film) -> tuple[Array, Array]:
    """Edge of the dry contact [mm]."""
    angle = np.linspace(0.0, 2.0 * np.pi, 181)
    a, b = result.point.hertz_radius * 1e3, result.point.semi_axis_y * 1e3
    turn = math.radians(_edge(result).angle)
    along, across = a * np.cos(angle), b * np.sin(angle)
    c, s = math.cos(turn), math.sin(turn)
    return c * along - s * across, s * along + c * across


def tiles(made: Prediction) -> tuple[Array, Array, float, float, float]:
    """Roughness before and in the contact (n, m) [nm], sizes [mm], maximum of the scale [nm]."""
    before = np.ascontiguousarray(made.surface.heights.T) * 1e9
    after = np.ascontiguousarray(made.friction.response.deformed.T) * 1e9
    top = max(1e-9, float(np.abs(before - before.mean()).max()))
    size = made.surface.length_x * 1e3, made.surface.length_y * 1e3
    return before - before.mean(), after - after.mean(), *size, top


def octaves(made: Prediction) -> dict[str, list[float]]:
    """Octaves of wavelengths [µm], and their contributions to mu_r/mu_s."""
    bands = [band for band in made.bands if math.isfinite(band.increase)]
    return {
        "left": [band.shortest * 1e6 for band in bands],
        "right": [band.longest * 1e6 for band in bands],
        "increase": [band.increase for band in bands],
    }
