# SPDX-License-Identifier: BSD-3-Clause
"""Place of the film breakdown on rough surfaces, and a cut-off with which the film is full.

On a measured surface the film nearly always breaks down at some pixel. Its place, its height and
the fraction of the contact without a film are reported, and the film is never clipped. A cut-off
wavelength or a threshold of spikes with which the film is full is suggested; if mu_r/mu_s is
outside the range of the model, a cut-off with which it is inside.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyehl import lengths
from pyehl.prediction.bands import LongerWaves
from pyehl.prediction.friction import mean, run
from pyehl.prediction.model import KNOWN_RATIO, Model, model_error
from pyehl.prediction.relative_positions import RelativePositions
from pyehl.prediction.response import FILM_ENDS
from pyehl.surfaces.map_steps import cropped, prominence
from pyehl.surfaces.prepare import Preparation
from pyehl.surfaces.tile import Topography
from pyehl.types import Array, Indices

Sustained = Callable[[Array, Array], Array]
"""Deformed roughness that the smooth film sustains [m] at x (m,) and y (n,) [m] from the centre of
the contact, (m, n): where the roughness is higher there is no film."""

PLACES = 64
"""Positions along a row at which the smooth film is evaluated: 1/32 a apart, where its slope causes
a difference far below the error of the film."""


def sustained_by(model: Model) -> Sustained:
    """Deformed roughness at which the film of a model breaks down."""
    ends = FILM_ENDS if model.options.reduction == "response" else 1.0
    a, film_unit = model.operating.hertz_radius, model.operating.film_scale

    def sustained(x: Array, y: Array) -> Array:
        return model.contact.at(x / a, y / a)[1] * film_unit * ends

    return sustained


@dataclass(frozen=True, slots=True)
class BelowZero:
    """Where the film breaks down on one or two tiles."""

    # Mean fraction of the Hertz area without a film, over a whole passage [-]
    share: float
    # Minimum of the sustained minus the deformed roughness [m], not positive at a breakdown
    deepest: float
    pixels: tuple[tuple[int, int], ...]  # (i, j) on each tile at that minimum
    # Pixels of one tile that pass through the contact and break the film; not counted for two
    count: int | None = None


def below_zero(
    tiles: Sequence[Topography],
    deformed: Sequence[Array],
    semi_axes: tuple[float, float],
    sustained: Sustained,
) -> BelowZero:
    """Find the minimum film over tiles, in the strip that passes through the contact.

    Every pixel of a tile within b of the track passes through the contact along its row, and
    through the minimum of the smooth film on this row; there it may meet the highest point of the
    other tile on the row. The deformed roughness (nx, ny) [m], y = 0 through the centre, is assumed
    to be everywhere that at the centre. Semi-axes a and b of the contact in m, b infinite for a
    line. The share is that of one tile; NaN for two, where it needs the positions of a prediction.
    """
    a, b = semi_axes
    smooth, columns = _strip(tiles, a, b, sustained)
    tops = [values.max(axis=0)[column] for values, column in zip(deformed, columns, strict=True)]
    minimum = smooth.min(axis=0)
    for top in tops:
        minimum = minimum - top
    worst = int(np.argmin(minimum))
    pixels = tuple(
        (int(np.argmax(values[:, column[worst]])), int(column[worst]))
        for values, column in zip(deformed, columns, strict=True)
    )
    result = BelowZero(math.nan, float(minimum[worst]), pixels)
    if len(tiles) > 1:
        return result
    share, count = _beyond(deformed[0], columns[0], smooth, minimum < 0.0)
    return replace(result, share=share, count=count)


def _strip(
    tiles: Sequence[Topography], a: float, b: float, sustained: Sustained
) -> tuple[Array, list[Indices]]:
    """Give the roughness sustained on the rows of the contact (n, m) [m], inf outside of it.

    Also the column of each tile (m,) on the rows, whose distance is that of the finest pixels.
    """
    pixel = min(tile.pixel[1] for tile in tiles)
    if math.isinf(b):
        rows = np.arange(round(max(tile.length_y for tile in tiles) / pixel))
    else:
        rows = np.arange(-int(b / pixel), int(b / pixel) + 1)
    y = np.asarray(rows * pixel, dtype=float)
    x: Array = a * ((2.0 * np.arange(PLACES) + 1.0) / PLACES - 1.0)
    inside = np.hypot(x[:, np.newaxis], y[np.newaxis, :] * (a / b)) < a
    columns = [np.rint(y / tile.pixel[1]).astype(int) % tile.shape[1] for tile in tiles]
    return np.where(inside, sustained(x, y), np.inf), columns


def _beyond(deformed: Array, column: Indices, smooth: Array, ended: Array) -> tuple[float, int]:
    """Mean fraction of the contact without a film under one tile, and the pixels that cause it."""
    inside, below = np.isfinite(smooth), 0
    # a pixel may pass through the contact on several rows of a small tile
    limit = np.full(deformed.shape[1], np.inf)
    np.minimum.at(limit, column, smooth.min(axis=0))
    for k in np.nonzero(ended)[0]:
        heights = np.sort(deformed[:, column[k]])
        at = np.searchsorted(heights, smooth[inside[:, k], k], side="right")
        below += int((heights.size - at).sum())
    share = below / (deformed.shape[0] * int(inside.sum()))
    return share, int(np.count_nonzero(deformed > limit[np.newaxis, :]))


def of_model(model: Model, deformed: Sequence[Array], sustained: Sustained) -> BelowZero:
    """Find where the film of a model breaks down.

    Two surfaces are in the positions of their common period, or without one in all relative ones.
    `deformed` is the deformed roughness of each surface (nx, ny) [m].
    """
    tiles, semi_axes = [one.topography for one in model.surfaces], model.operating.semi_axes
    result = below_zero(tiles, deformed, semi_axes, sustained)
    if len(tiles) == 1 or result.deepest > 0.0:
        return result
    positions = model.relative_positions
    if positions.passages is None:
        return result
    return _in_common_period(model, positions, deformed, sustained)


def _in_common_period(
    model: Model, positions: RelativePositions, deformed: Sequence[Array], sustained: Sustained
) -> BelowZero:
    """Find the minimum film of two surfaces over a common period, in steps of a pixel."""
    tiles, (a, b) = [one.topography for one in model.surfaces], model.operating.semi_axes
    smooth, columns = _strip(tiles, a, b, sustained)
    x = (2.0 * np.arange(PLACES) + 1.0) / PLACES - 1.0
    heights = [values[:, column] for values, column in zip(deformed, columns, strict=True)]
    pixels = [tile.pixel[0] / a for tile in tiles]
    period = max(
        passages * length / u
        for passages, length, u in zip(
            positions.passages or (), positions.lengths, positions.velocity_ratios, strict=True
        )
        if u > 0.0
    )
    steps = math.ceil(period * max(positions.velocity_ratios) / min(pixels))
    result = BelowZero(math.nan, math.inf, ((0, 0), (0, 0)))
    for k in range(steps):
        shifts = positions.shifts(k, steps)
        rows = [
            np.rint((x - shifts[model.order.index(i)]) / pixels[i]).astype(int)
            % heights[i].shape[0]
            for i in (0, 1)
        ]
        film = smooth - heights[0][rows[0]] - heights[1][rows[1]]
        place = int(film.argmin())
        if film.flat[place] < result.deepest:
            i, j = divmod(place, film.shape[1])
            at = tuple(
                (int(row[i]), int(column[j])) for row, column in zip(rows, columns, strict=True)
            )
            result = BelowZero(math.nan, float(film[i, j]), at)
    return result


Full = Callable[[Topography], bool]
"""Whether a tile is under a full film."""
FEW = 0.01
"""Largest fraction of a map that counts as a few spikes: more is roughness, not dirt."""
CUT_OFF_TOLERANCE, THRESHOLD_TOLERANCE = 0.05, 0.1
"""Relative tolerances of a cut-off and of a threshold of spikes."""
MIN_THRESHOLD = 5.0
"""Below it points of a normal distribution would count as spikes: one in two million at 5."""


@dataclass(frozen=True, slots=True)
class Advice:
    """Where the film breaks down, and with which cut-off or threshold it would be full."""

    below: BelowZero
    groups: tuple[str, ...]  # of the case, one for each surface
    # x, y of the deepest point on each surface [m]; on a prepared map from its corner after
    # cropping and rotation
    places: tuple[tuple[float, float], ...]
    # `shortest_wavelength` [m] of each, then of both, with a full film and a known error of the
    # predicted friction; None: there is none
    wavelengths: tuple[float | None, ...] = ()
    # `outliers` of one map with the same properties, and the number of points that it removes;
    # None: the surface is not a map, or more than a few points would be removed
    outliers: float | None = None
    outlier_points: int | None = None
    # Options that remove artefacts, see :mod:`pyehl.surfaces.findings`; with these neither a
    # cut-off nor a threshold is suggested
    first: tuple[str, ...] = ()

    @property
    def summary(self) -> dict[str, float | int | None]:
        """Return its entry in ``summary.json``."""
        two = len(self.places) > 1
        result: dict[str, float | int | None] = {}
        for prefix, (x, y) in zip(("", "second_"), self.places, strict=False):
            result |= {f"{prefix}x_m": x, f"{prefix}y_m": y}
        result |= {"film_m": self.below.deepest, "share_of_contact": self.below.share}
        names = ("", "second_", "both_")[: 3 if two else 1]
        lengths_of = self.wavelengths or (None,) * len(names)
        for name, length in zip(names, lengths_of, strict=True):
            result[f"suggested_{name}shortest_wavelength_m"] = length
        if not two:
            result["pixels"] = self.below.count
            result["suggested_outliers"] = self.outliers
            result["suggested_outliers_points"] = self.outlier_points
        return result

    def report(self) -> list[str]:
        """Return the lines that ``pyehl predict`` prints."""
        places = [f"x = {lengths.length(x, 4)}, y = {lengths.length(y, 4)}" for x, y in self.places]
        two = len(places) > 1
        where = f"at {places[0]} of the surface"
        if two:
            where = "where " + " meets ".join(
                f"{place} of {group}" for place, group in zip(places, self.groups, strict=True)
            )
        pixels = "" if two else f"{self.below.count} pixels, "
        higher = f"{-self.below.deepest * 1e9:.3g} nm higher than the film sustains"
        lines = [
            f"film ends  {where}: {higher}; {pixels}{100 * self.below.share:.3g} % of the contact "
            "in the mean over the passage"
        ]
        if self.first:
            return lines + [f"first      {option}: it is not roughness" for option in self.first]
        if self.outliers is not None:
            lines.append(
                f"full film  with {self.groups[0]}.outliers = {self.outliers:.4g}: "
                f"{self.outlier_points} points count as spikes and are removed"
            )
        for name, length in zip((*self.groups, "both"), self.wavelengths, strict=False):
            if length is not None:
                key = f"{name}{' ' if name == 'both' else '.'}shortest_wavelength"
                lines.append(
                    f"full film  with {key} = {length:.4g}: without waves shorter than "
                    f"{lengths.length(length, max_unit='um')}"
                )
        if self.outliers is None and not any(self.wavelengths):
            cut = "short waves" if two else "spikes or short waves"
            lines.append(f"full film  not by cutting {cut} alone")
        return lines


def advise(
    model: Model,
    below: BelowZero,
    sustained: Sustained,
    without_spikes: Callable[[float], Topography] | None = None,
) -> Advice:
    """Find where the film of a model breaks down, and the cut-offs with which it would be full.

    With the full film the error of the predicted friction must be known as well. `without_spikes`
    takes a threshold of `surface.outliers` and returns the one tile without them.
    """

    def full(other: Model) -> bool:
        return of_model(other, other.deformed(), sustained).deepest > 0.0 and known(other)

    tiles = [one.topography for one in model.surfaces]
    groups = tuple(one.groups[0] for one in model.surfaces)
    places = tuple(_place(tile, *at) for tile, at in zip(tiles, below.pixels, strict=True))
    if first := remedies(model):
        return Advice(below, groups, places, first=tuple(first))
    wavelengths = []
    for numbers in choices(len(tiles)):

        def good(shortest: float, numbers: tuple[int, ...] = numbers) -> bool:
            return full(model.without_shorter(numbers, shortest))

        shortest = min(min(tiles[k].pixel) for k in numbers)
        longest = max(max(tiles[k].size) for k in numbers)
        wavelengths.append(suggested_wavelength(2.0 * shortest, longest, good))
    spikes: tuple[float, int] | None = None
    made = tiles[0].preparation
    if made is not None and without_spikes is not None and not made.options.outliers > 0.0:
        (one,) = model.surfaces
        spikes = _spikes(
            made,
            without_spikes,
            lambda tile: full(replace(model, surfaces=(replace(one, topography=tile),))),
        )
    return Advice(below, groups, places, tuple(wavelengths), *(spikes or (None, None)))


def _place(tile: Topography, i: int, j: int) -> tuple[float, float]:
    """Position of a pixel on the surface [m]; on a prepared map from its corner."""
    made = tile.preparation
    return made.place(i, j) if made else (i * tile.pixel[0], j * tile.pixel[1])


def ways_into_range(model: Model) -> str:
    """Name the cut-offs that bring the ratio into the range of the model; '' for none."""
    model = model.merged or model
    if first := remedies(model):
        return "; " + ", ".join(f"first {option}" for option in first)
    waves, radius, ways = model.components(), model.operating.hertz_radius, []
    shortest = min(min(wave.spectrum.pixel) for wave in waves)
    longest = 2.0 * math.pi / min(float(w.spectrum.q[w.spectrum.q > 0].min()) for w in waves)
    longer = LongerWaves(model, waves)
    for numbers in choices(len(model.surfaces)):

        def ratio(length: float, numbers: tuple[int, ...] = numbers) -> float:
            limit = 2.0 * math.pi / length
            return longer.ratio([limit if k in numbers else math.inf for k in model.order])

        def good(length: float, numbers: tuple[int, ...] = numbers) -> bool:
            result = run(model.without_shorter(numbers, length), 0, brief=True).friction
            return result.status == "predicted" and result.mu_ratio <= KNOWN_RATIO

        with np.errstate(over="ignore", invalid="ignore"):
            high = within_range(ratio, shortest, longest)
            cut = None if high is None else confirmed(high * radius, longest * radius, good)
        if cut is not None:
            of_each = [group for k in numbers for group in model.surfaces[k].groups]
            keys = " and ".join(f"{group}.shortest_wavelength" for group in of_each)
            ways.append(f"{keys} = {cut:g}")
    return f"; {', or '.join(ways)} would leave {KNOWN_RATIO:g} or less" if ways else ""


def remedies(model: Model) -> list[str]:
    """Options that remove form and line offsets from maps, which a cut-off would also remove."""
    return [
        f"{finding.remedy.replace('surface.', f'{one.groups[0]}.')} ({finding.kind})"
        for one in model.surfaces
        if (made := one.topography.preparation) is not None
        for finding in made.record.findings
        if finding.kind in ("form", "line offsets")
    ]


def known(model: Model) -> bool:
    """Whether the error of the ratio is known; for the model of the paper it is not required."""
    return model.options.as_in_paper or math.isfinite(model_error(mean(model)))


def choices(count: int) -> list[tuple[int, ...]]:
    """Numbers of the surfaces whose short waves are cut: each alone, then both."""
    return [(0,)] if count == 1 else [(0,), (1,), (0, 1)]


def suggested_wavelength(
    shortest: float, longest: float, full: Callable[[float], bool]
) -> float | None:
    """Find a cut-off [m] below which waves are removed so that the film is full.

    Bisection in the logarithm of the wavelength to 5 %, between the `shortest` one, two pixels, and
    the `longest`, the length of the tile. The film is full for the returned cut-off, but not
    necessarily for every longer one. `full`: whether the film is full for a cut-off. None if even
    the longest waves break the film.
    """
    low, high = math.log(shortest), math.log(longest)
    if not full(math.exp(high)):
        return None
    while high - low > CUT_OFF_TOLERANCE:
        middle = 0.5 * (low + high)
        if full(math.exp(middle)):
            high = middle
        else:
            low = middle
    rounded = _two_digits(math.exp(high))
    return rounded if full(rounded) else math.exp(high)


def suggested_outliers(
    away: Array, without_spikes: Callable[[float], Topography], full: Full
) -> tuple[float, int] | None:
    """Find a threshold of spikes with which the film is full, if only a few points break it.

    `away` is (nx, ny), see :func:`pyehl.surfaces.map_steps.prominence`; `without_spikes` takes a
    threshold. Returns the threshold and the number of points above it; None if more than a few
    points would be removed.
    """
    allowed = float(np.quantile(away, 1.0 - FEW))
    low = max(MIN_THRESHOLD, allowed)
    high = float(away.max())
    if low >= high or not full(without_spikes(low)):
        return None
    below, above = math.log(low), math.log(high)
    while above - below > THRESHOLD_TOLERANCE:
        middle = 0.5 * (below + above)
        if full(without_spikes(math.exp(middle))):
            below = middle
        else:
            above = middle
    # a threshold of two digits, on the safe side
    rounded = float(f"{math.exp(below):.2g}")
    if rounded > math.exp(below) or rounded < low or not full(without_spikes(rounded)):
        rounded = math.exp(below)
    return rounded, int(np.count_nonzero(away > rounded))


def _spikes(
    made: Preparation, without_spikes: Callable[[float], Topography], full: Full
) -> tuple[float, int] | None:
    """Threshold with a full film, and the number of points above it."""
    heights = made.scan.heights
    if any(made.options.crop):
        nx, ny = heights.shape
        pixel = (made.scan.length_x / nx, made.scan.length_y / ny)
        heights = cropped(heights, pixel, made.options.crop)
    try:
        away = prominence(heights)
    except ValueError:
        # no spread to compare spikes with
        return None
    return suggested_outliers(away, without_spikes, full)


def within_range(below: Callable[[float], float], shortest: float, longest: float) -> float | None:
    """Cut-off wavelength [a] with which mu_r/mu_s is in the range of the model.

    To a tenth, between the `shortest` and the `longest` one of the surface; None: there is none.
    `below` gives mu_r/mu_s without waves shorter than a length.
    """
    low, high = shortest, longest
    if not below(high) <= KNOWN_RATIO:
        return None
    while high > 1.1 * low:
        middle = math.sqrt(low * high)
        low, high = (low, middle) if below(middle) <= KNOWN_RATIO else (middle, high)
    return high


def confirmed(start: float, longest: float, good: Callable[[float], bool]) -> float | None:
    """First good wavelength of two digits, from `start` [m] on in steps of a tenth.

    None if there is none up to `longest` [m].
    """
    value = start
    while value <= longest:
        rounded = _two_digits(value)
        if good(rounded):
            return rounded
        value = 1.1 * rounded
    return None


def _two_digits(value: float) -> float:
    """Two digits of a wavelength, rounded up."""
    scale = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.ceil(value / scale - 1e-9) * scale:.2g}")
