# SPDX-License-Identifier: BSD-3-Clause
"""The groups ``&surface`` and ``&second_surface`` of a case, key by key."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

from pyehl.case.key import path, real, text, truth, typed, whole, word

FEATURES = ("dent", "bump", "ridge", "groove")
"""Kinds of surfaces that are a single feature."""


@dataclass(slots=True)
class Surface:
    """``&surface`` and ``&second_surface``: the moving roughness of a body."""

    kind: str = word(
        "smooth",
        "smooth|harmonic|map|fractal|dent|bump|ridge|groove",
        "the moving roughness; the last four pass once",
    )
    amplitude: float = real(
        0.0, "a^2/R", "[0, 1]", "amplitude A_i of a wave, height or depth of a feature; no default"
    )
    amplitude_over_film: float = real(
        0.4,
        "-",
        "[0, 10]",
        "amplitude over the smooth central film, extrapolated to fine grids",
    )
    wavelength: float = real(0.5, "a", "[0.01, 100]", "harmonic wavelength")
    wavelength_x: float = real(0.5, "a", "[0.01, 100]", "wavelength along X; default wavelength")
    wavelength_y: float = real(0.5, "a", "[0.01, 1e6]", "wavelength along Y; default wavelength")
    velocity_ratio: float = real(
        1.01,
        "-",
        "[0, 2]",
        "velocity of the rough surface over the mean velocity; default 1 + SRR/2 on body 1, "
        "1 - SRR/2 on body 2",
    )
    x_start: float = real(
        -2.5,
        "a",
        "[-1e5, 1e4]",
        "front of the roughness at time 0, or its origin at rest; default x_inlet",
    )
    height_m: float = real(
        0.0,
        "m",
        "0 or [1e-12, 1e-4]",
        "height or depth of a single feature; 0: amplitude or amplitude_over_film",
    )
    width: float = real(0.5, "a", "[0.01, 100]", "width of a single feature, across its line")
    length: float = real(
        0.0,
        "a",
        "0 or [0.01, 100]",
        "length of a single feature; 0: the width for a dent or bump, endless for a ridge or "
        "groove",
    )
    width_m: float = real(
        0.0, "m", "0 or [1e-9, 0.1]", "width of a single feature in metres; 0: width"
    )
    length_m: float = real(
        0.0, "m", "0 or [1e-9, 0.1]", "length of a single feature in metres; 0: length"
    )
    angle: float = real(
        0.0,
        "deg",
        "[-360, 360]",
        "turn a single feature counter-clockwise; 0: it lies across the motion",
    )
    y_start: float = real(0.0, "a", "[-20, 20]", "position of a single feature across the motion")
    spacing_y: float = real(
        0.0,
        "a",
        "0 or [0.01, 1000]",
        "distance after which a single feature repeats along a line contact; 0: 4 times its "
        "size, at least 4",
    )
    file: str = path("height map of kind 'map': .npy, text, instrument file")
    channel: str = text(
        "channel of an instrument file: name, or number from 1; '': its first height channel"
    )
    length_x: float = real(
        0.0, "m", "0 or [1e-9, 1]", "size of the map along X; 0: that of the file; fractal: 8.29e-4"
    )
    length_y: float = real(
        0.0, "m", "0 or [1e-9, 1]", "size of the map along Y; 0: that of the file; fractal: 8.29e-4"
    )
    height_unit: str = word(
        "m", "m|mm|um|nm", "unit of the heights of a map that names none (.npy, text)"
    )
    lateral_unit: str = word(
        "same",
        "same|m|mm|um|nm",
        "unit of x and y in a list of x, y and z, or of axes, if the file names none; same: that "
        "of the heights",
    )
    profile: str = word(
        "none",
        "none|isotropic|ridges",
        "the file is a profile: make an isotropic surface of its spectrum, or extend it as ridges",
    )
    crop_x_min: float = real(0.0, "m", "[0, 1]", "start of the map along X")
    crop_x_max: float = real(0.0, "m", "[0, 1]", "end of the map along X; 0: not cropped")
    crop_y_min: float = real(0.0, "m", "[0, 1]", "start of the map along Y")
    crop_y_max: float = real(0.0, "m", "[0, 1]", "end of the map along Y; 0: not cropped")
    sign: int = whole(1, "[-1, 1]", "-1: valleys of the map are positive; 1: peaks are positive")
    outliers: float = real(
        0.0,
        "-",
        "0 or [3, 1e6]",
        "points that deviate from their neighbourhood by more than this number of standard "
        "deviations are removed as spikes; 0: none",
    )
    align_lines: str = word(
        "none",
        "none|x|y",
        "level the lines of a scan along X or Y by their medians",
    )
    fill: str = word("harmonic", "harmonic|none", "missing points: interpolated, or refused")
    detrend: str = word(
        "auto",
        "auto|none|centre|tilt|curvature",
        "form removed; auto: tilt for instrument files, none for arrays",
    )
    rotate: float = real(0.0, "deg", "[-360, 360]", "turn the map counter-clockwise")
    edges: str = word(
        "auto",
        "auto|mirror|window|periodic",
        "how the map is made periodic; auto: mirror for instrument files, periodic for arrays",
    )
    track: float = real(
        0.0,
        "m",
        "[-1, 1]",
        "position across the motion of the line that passes the centre of the contact",
    )
    tile_x: float = real(
        0.0,
        "m",
        "0 or [1e-9, 10]",
        "size of the tile made from the map; not for input",
    )
    tile_y: float = real(
        0.0,
        "m",
        "0 or [1e-9, 10]",
        "size of the tile made from the map; not for input",
    )
    tile_mirrored: bool = truth(False, "the tile contains mirror images; not for input")
    shortest_wavelength: float = real(
        0.0, "m", "[0, 1]", "waves of a map or fractal surface shorter than this are cut; 0: none"
    )
    longest_wavelength: float = real(
        0.0, "m", "[0, 1]", "waves of a map or fractal surface longer than this are cut; 0: none"
    )
    filter: str = word("sharp", "sharp|gaussian", "how the spectrum is cut")
    rms_height: float = real(
        5e-8, "m", "[0, 1e-4]", "rms height of a fractal surface, before its spectrum is cut"
    )
    ra: float = real(
        0.0,
        "m",
        "[0, 1e-4]",
        "Ra instead of rms_height, for normally distributed heights; 0: not given",
    )
    rq: float = real(0.0, "m", "[0, 1e-4]", "Rq, another name of rms_height; 0: not given")
    finish: str = word(
        "none",
        "none|ground|honed|superfinished|polished",
        "a fractal surface with typical values of Ra, spectrum and lay unless given",
    )
    lay_ratio: float = real(
        1.0,
        "-",
        "[0.01, 100]",
        "ratio of the correlation lengths along X and Y; below 1: lay across the motion",
    )
    hurst: float = real(0.8, "-", "[0, 1]", "Hurst exponent")
    rolloff_wavenumber: float = real(
        0.0, "rad/m", "[0, 1e11]", "the spectrum is flat below it; 0: no roll-off"
    )
    pixels: int = whole(256, "[4, 8192]", "pixels per side of a fractal surface")
    seed: int = whole(1, "[0, 2147483647]", "seed of the random phases")
    modulus: str = word(
        "deterministic", "deterministic|gaussian", "modulus of the Fourier components"
    )
    amplitude_given: bool = False
    """Whether `amplitude` applies, not `amplitude_over_film`."""

    @classmethod
    def of(cls, group: Mapping[str, Any]) -> Self:
        """Give a group of a resolved case as attributes; missing keys have their defaults."""
        return typed(cls, group)

    @property
    def is_feature(self) -> bool:
        """Whether it is a single feature."""
        return self.kind in FEATURES

    @property
    def has_height(self) -> bool:
        """Whether its keys make it rough."""
        if self.kind in ("smooth", "map"):
            return self.kind == "map"
        if self.kind == "fractal":
            return self.rms_height > 0.0
        height = self.amplitude if self.amplitude_given else self.amplitude_over_film
        return max(height, self.height_m) > 0.0
