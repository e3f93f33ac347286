# SPDX-License-Identifier: BSD-3-Clause
"""Rough surfaces: generators, height maps, spectra, exact shifts.

A surface is a periodic tile of heights z [m], array (nx, ny), first index along x (the rolling
direction); peaks are positive and thin the film. Pixel [i, j] lies at x = i length_x/nx,
y = j length_y/ny.

Spectra follow Jacobs, Junge & Pastewka 2017 (doi 10.1088/2051-672X/aa51f8):
C2D(q) = |dx dy sum z exp(-i q x)|^2/(Lx Ly) [m^4], so that h_rms^2 = sum C2D/(Lx Ly), and C_iso is
its mean over annuli of |q|.

The fractal generator is written here and not taken from a surface library for three reasons: the
seed must give the same surface for as long as the package lives, which only raw output of a named
bit generator promises; the modulus of each Fourier component must be selectable, exactly on the
power law or random; and a surface is needed without heavy dependencies.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
import scipy.fft
from numpy.typing import ArrayLike, NDArray

from pyehl.operating import OperatingPoint

__all__ = [
    "Topography",
    "fractal",
    "from_settings",
    "harmonic",
    "harmonic_amplitude",
    "psd_2d",
    "psd_isotropic",
    "read_map",
    "resampled",
    "shifted",
    "spectrum",
    "wavenumbers",
]

Array = NDArray[np.float64]

MAX_PIXELS = 2**26
"""Most pixels a map may have (512 MB of heights)."""

# Heights, pixels and tiles outside these bands [m] are unit mistakes
RMS_BAND = (1e-10, 1e-4)
PIXEL_BAND = (1e-10, 1e-3)

# Least pixels per wavelength, and per Hertz radius, of a sampled harmonic pattern
HARMONIC_PIXELS = 32
RADIUS_PIXELS = 64


@dataclass(frozen=True, slots=True)
class Topography:
    """A periodic tile of heights.

    Attributes
    ----------
    heights
        (nx, ny) [m], peaks positive.
    length_x, length_y
        Size of the tile [m].
    origin
        Where it came from, in words.
    seed
        Seed of a generated surface, else None.

    Raises
    ------
    ValueError
        If the heights are not a finite matrix of at least 2 x 2 or a length is not positive.
    """

    heights: Array
    length_x: float
    length_y: float
    origin: str = ""
    seed: int | None = None

    def __post_init__(self) -> None:
        """Check shape, numbers and size."""
        z = self.heights
        if z.ndim != 2 or min(z.shape) < 2:
            raise ValueError(
                f"{self.origin or 'surface'}: heights must be a matrix (nx, ny) of at least 2 x 2, "
                f"not of shape {z.shape}"
            )
        bad = int(z.size - np.count_nonzero(np.isfinite(z)))
        if bad:
            i, j = np.argwhere(~np.isfinite(z))[0]
            raise ValueError(
                f"{self.origin or 'surface'}: {bad} of {z.size} heights are not finite, the first "
                f"at row {i}, column {j}; fill the holes of the map first"
            )
        for name, value in (("length_x", self.length_x), ("length_y", self.length_y)):
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} must be positive [m], not {value!r}")

    @property
    def shape(self) -> tuple[int, int]:
        """Pixels along x and y."""
        return self.heights.shape[0], self.heights.shape[1]

    @property
    def pixel(self) -> tuple[float, float]:
        """Pixel size along x and y [m]."""
        return self.length_x / self.shape[0], self.length_y / self.shape[1]

    @property
    def rms_height(self) -> float:
        """Root mean square of the heights about their mean [m]."""
        return float(np.std(self.heights))


def wavenumbers(topography: Topography) -> tuple[Array, Array]:
    """q_x (nx, 1) and q_y (1, ny//2 + 1) of the half spectrum of a tile [rad/m]."""
    nx, ny = topography.shape
    dx, dy = topography.pixel
    qx = 2.0 * np.pi * scipy.fft.fftfreq(nx, dx)
    qy = 2.0 * np.pi * scipy.fft.rfftfreq(ny, dy)
    return qx[:, np.newaxis], qy[np.newaxis, :]


def spectrum(topography: Topography) -> NDArray[np.complex128]:
    """Amplitude of each Fourier component, (nx, ny//2 + 1) [m]: the half spectrum of z over nx ny.

    z[i, j] = sum over the full spectrum of amplitude exp(i (q_x x + q_y y)); no factor 4, a real
    cosine of amplitude A shows as two components of A/2.
    """
    z = scipy.fft.rfft2(topography.heights, norm="forward")
    return cast("NDArray[np.complex128]", z)


def fractal(
    pixels: int | tuple[int, int],
    length_x: float,
    length_y: float,
    *,
    rms_height: float,
    hurst: float,
    rolloff_wavenumber: float = 0.0,
    seed: int = 1,
    modulus: str = "deterministic",
) -> Topography:
    """Self-affine surface with random phases.

    C2D is proportional to max(|q|, q_r)^(-2 - 2 hurst) up to the Nyquist wavenumbers of the tile,
    zero at q = 0. The rms height is exact for each surface, the mean is zero, the tile is periodic.

    Parameters
    ----------
    pixels
        Per side, or (nx, ny).
    length_x, length_y
        Size of the tile [m].
    rms_height
        [m], positive.
    hurst
        Hurst exponent, 0 < hurst <= 1.
    rolloff_wavenumber
        q_r [rad/m] below which the spectrum is flat; 0: no roll-off.
    seed
        Not negative. The phases come from the raw words of PCG64, which NumPy promises not to
        change.
    modulus
        ``"deterministic"``: each component lies exactly on the power law, only phases are random
        (the usual generator); ``"gaussian"``: amplitudes of a Gaussian random field.

    Returns
    -------
    Topography
        Two surfaces of one seed and different pixels are not the same surface.

    Raises
    ------
    ValueError
        For an argument out of range.
    """
    nx, ny = (pixels, pixels) if isinstance(pixels, int) else pixels
    if nx < 4 or ny < 4 or nx * ny > MAX_PIXELS:
        raise ValueError(f"pixels must be at least 4 per side and at most {MAX_PIXELS} in all")
    if not (math.isfinite(rms_height) and rms_height > 0.0):
        raise ValueError(f"rms_height must be positive [m], not {rms_height!r}")
    if not 0.0 < hurst <= 1.0:
        raise ValueError(f"hurst must be in (0, 1], not {hurst!r}")
    if not (math.isfinite(rolloff_wavenumber) and rolloff_wavenumber >= 0.0):
        raise ValueError(
            f"rolloff_wavenumber must not be negative [rad/m], not {rolloff_wavenumber!r}"
        )
    if seed < 0:
        raise ValueError(f"seed must not be negative, not {seed!r}")
    if modulus not in ("deterministic", "gaussian"):
        raise ValueError(f"modulus {modulus!r}: expected 'deterministic' or 'gaussian'")

    half = ny // 2 + 1
    words = np.random.PCG64(seed).random_raw(2 * nx * half)
    uniform = ((words >> np.uint64(11)).astype(float) * 2.0**-53).reshape(2, nx, half)
    component = np.exp(2j * np.pi * uniform[0])
    if modulus == "gaussian":
        component *= np.sqrt(-np.log1p(-uniform[1]))
    _make_hermitian(component, ny, gaussian=modulus == "gaussian")

    blank = Topography(np.zeros((nx, ny)), length_x, length_y)
    qx, qy = wavenumbers(blank)
    q = np.maximum(np.hypot(qx, qy), rolloff_wavenumber)
    q[0, 0] = np.inf
    component *= q ** (-1.0 - hurst)
    z = scipy.fft.irfft2(component, s=(nx, ny))
    z -= z.mean()
    z *= rms_height / np.sqrt(np.mean(z * z))
    origin = f"fractal, hurst {hurst:g}, seed {seed}, {modulus} modulus"
    return Topography(np.ascontiguousarray(z), length_x, length_y, origin, seed)


def _make_hermitian(component: NDArray[np.complex128], ny: int, *, gaussian: bool) -> None:
    """Give the columns q_y = 0 and Nyquist of a half spectrum the symmetry of a real surface.

    Component (q_x, q_y) there is the partner of (-q_x, q_y), so one half is copied from the other.
    The up to four components that are their own partner are real: a random sign at the given
    modulus, or, of a Gaussian field, a real normal number of the same mean square.
    """
    nx = component.shape[0]
    for j in [0] if ny % 2 else [0, ny // 2]:
        component[: nx // 2 : -1, j] = np.conj(component[1 : (nx + 1) // 2, j])
        for i in [0] if nx % 2 else [0, nx // 2]:
            value = component[i, j]
            if gaussian:
                component[i, j] = math.sqrt(2.0) * value.real
            else:
                component[i, j] = math.copysign(abs(value), value.real)


def harmonic_amplitude(
    settings: Mapping[str, Mapping[str, Any]], operating: OperatingPoint, film: float
) -> float:
    """Amplitude A_i [m] of the harmonic surface of a resolved case with a smooth film h_c [m]."""
    surface = settings["surface"]
    amplitude = surface.get("amplitude")
    if amplitude:
        return float(amplitude) * operating.film_scale
    return float(surface["amplitude_over_film"]) * film


def harmonic(
    amplitude: float, wavelength_x: float, wavelength_y: float, pixels: tuple[int, int]
) -> Topography:
    """One tile of z = A cos(2 pi x/wavelength_x) cos(2 pi y/wavelength_y), eq. 15 behind the front.

    Parameters
    ----------
    amplitude
        A [m].
    wavelength_x, wavelength_y
        [m]; the size of the tile.
    pixels
        (nx, ny).
    """
    nx, ny = pixels
    x = np.cos(2.0 * np.pi * np.arange(nx) / nx)
    y = np.cos(2.0 * np.pi * np.arange(ny) / ny)
    return Topography(amplitude * np.outer(x, y), wavelength_x, wavelength_y, "harmonic")


def read_map(
    path: str | Path, length_x: float | None = None, length_y: float | None = None
) -> Topography:
    """Height map from a file, mean removed.

    Parameters
    ----------
    path
        ``.npy`` (never pickled), text (``.txt``, ``.csv``, ``.dat``, ``.asc``: one x per line, y
        along the line, separated by blanks, commas or semicolons), heights in m; or any format
        that the package SurfaceTopography reads, which then also gives units and size.
    length_x, length_y
        Size of the tile [m]. Needed for ``.npy`` and text; other formats carry their own, and a
        length given here replaces it.

    Raises
    ------
    OSError
        If the file cannot be opened.
    ValueError
        If it is no matrix of numbers, has holes, is too large, or its heights or pixels are so
        large or small that the unit must be wrong.
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"{path}: no such height map")
    suffix = path.suffix.lower()
    if suffix == ".npy":
        heights = _read_npy(path)
    elif suffix in (".txt", ".csv", ".dat", ".asc", ".xyz", ""):
        heights = _read_text(path)
    else:
        heights, size_x, size_y = _read_instrument(path)
        length_x = size_x if length_x is None else length_x
        length_y = size_y if length_y is None else length_y
    if length_x is None or length_y is None:
        raise ValueError(f"{path}: length_x and length_y [m] are needed, the file has no size")
    topography = Topography(heights, length_x, length_y, str(path))
    _check_plausible(topography)
    centred = np.ascontiguousarray(heights - heights.mean())
    return Topography(centred, length_x, length_y, str(path))


def _read_npy(path: Path) -> Array:
    try:
        # mapped, so that the header is checked before the data are read
        raw = np.load(path, mmap_mode="r", allow_pickle=False)
    except (ValueError, EOFError) as error:
        raise ValueError(f"{path}: not a readable .npy file of numbers: {error}") from None
    if raw.ndim != 2:
        raise ValueError(f"{path}: heights must be a matrix (nx, ny), not of shape {raw.shape}")
    if raw.dtype.kind not in "fiu":
        raise ValueError(f"{path}: heights must be real numbers, not {raw.dtype}")
    if raw.size > MAX_PIXELS:
        raise ValueError(f"{path}: {raw.size} heights, more than {MAX_PIXELS}")
    return np.array(raw, dtype=float, order="C")


def _read_text(path: Path) -> Array:
    if path.stat().st_size > 32 * MAX_PIXELS:
        raise ValueError(f"{path}: the file is too large for a map of {MAX_PIXELS} heights")
    rows: list[Array] = []
    with path.open(encoding="utf-8", errors="replace") as lines:
        for number, line in enumerate(lines, 1):
            text = line.partition("#")[0].replace(";", " ").replace(",", " , ")
            words = text.split()
            # "1,2 3,4" would otherwise be read as four heights
            commas = words.count(",")
            if not words:
                continue
            numbers = [w for w in words if w != ","]
            if commas and commas not in (len(numbers) - 1, len(numbers)):
                raise ValueError(
                    f"{path}:{number}: commas and blanks both separate the numbers; if the comma "
                    "is a decimal comma, write a point"
                )
            try:
                row = np.array([float(w) for w in numbers])
            except ValueError as error:
                raise ValueError(f"{path}:{number}: {error}") from None
            if rows and row.size != rows[0].size:
                raise ValueError(
                    f"{path}:{number}: {row.size} heights, but {rows[0].size} in the lines above"
                )
            rows.append(row)
    if not rows:
        raise ValueError(f"{path}: no heights in the file")
    return np.array(rows)


def _read_instrument(path: Path) -> tuple[Array, float, float]:
    try:
        from SurfaceTopography import read_topography  # noqa: PLC0415
    except ImportError:
        raise ValueError(
            f"{path}: files of this kind are read by the package SurfaceTopography, which is not "
            "installed: pip install SurfaceTopography, or save the heights in m as .npy"
        ) from None
    scan = read_topography(str(path)).to_unit("m")
    masked: np.ma.MaskedArray[Any, np.dtype[np.float64]]
    masked = np.ma.asarray(scan.heights(), dtype=float)
    size_x, size_y = scan.physical_sizes
    return np.asarray(masked.filled(np.nan), dtype=float), float(size_x), float(size_y)


def _check_plausible(topography: Topography) -> None:
    """Refuse what can only be a mistake of units."""
    rms = topography.rms_height
    if not RMS_BAND[0] <= rms <= RMS_BAND[1]:
        raise ValueError(
            f"{topography.origin}: rms height {rms:.3g} m is outside {RMS_BAND[0]:g} ... "
            f"{RMS_BAND[1]:g} m; are the heights in m?"
        )
    for name, pixel in zip(("length_x", "length_y"), topography.pixel, strict=True):
        if not PIXEL_BAND[0] <= pixel <= PIXEL_BAND[1]:
            raise ValueError(
                f"{topography.origin}: {name} gives a pixel of {pixel:.3g} m, outside "
                f"{PIXEL_BAND[0]:g} ... {PIXEL_BAND[1]:g} m; is the length in m?"
            )


def from_settings(
    settings: Mapping[str, Mapping[str, Any]], operating: OperatingPoint, film: float
) -> Topography:
    """Make or read the surface of a resolved case.

    Parameters
    ----------
    settings
        A resolved case; the group ``surface`` is read.
    operating
        Gives the scales of a harmonic pattern.
    film
        Central film h_c [m], of which the amplitude of a harmonic pattern may be a share.

    Raises
    ------
    ValueError
        If the surface is smooth or the map is not usable.
    OSError
        If the map cannot be opened.
    """
    surface = settings["surface"]
    kind = str(surface["kind"])
    if kind == "fractal":
        return fractal(
            int(surface["pixels"]),
            float(surface["length_x"]),
            float(surface["length_y"]),
            rms_height=float(surface["rms_height"]),
            hurst=float(surface["hurst"]),
            rolloff_wavenumber=float(surface["rolloff_wavenumber"]),
            seed=int(surface["seed"]),
            modulus=str(surface["modulus"]),
        )
    if kind == "harmonic":
        shares = (float(surface["wavelength_x"]), float(surface["wavelength_y"]))
        # a long wave is sampled as finely as the contact needs, not only as it needs itself
        pixels = tuple(2 * math.ceil(max(HARMONIC_PIXELS, RADIUS_PIXELS * s) / 2) for s in shares)
        return harmonic(
            harmonic_amplitude(settings, operating, film),
            shares[0] * operating.hertz_radius,
            shares[1] * operating.hertz_radius,
            (pixels[0], pixels[1]),
        )
    if kind == "map":
        return read_map(
            str(surface["file"]), float(surface["length_x"]), float(surface["length_y"])
        )
    raise ValueError(
        f"surface.kind = {kind!r} has no heights; expected 'harmonic', 'map' or 'fractal'"
    )


def _shift_factor(q: Array, distance: float, nyquist: int | None) -> NDArray[np.complex128]:
    factor = np.exp(-1j * q * distance)
    if nyquist is not None:
        # half of this component travels with +q and half with -q
        factor[nyquist] = np.cos(q[nyquist] * distance)
    return cast("NDArray[np.complex128]", factor)


def shifted(topography: Topography, distance_x: float, distance_y: float = 0.0) -> Topography:
    """Return the tile moved by a distance [m] towards positive x and y, by its Fourier interpolant.

    Exact for the trigonometric polynomial through the heights; a shift by whole pixels is the
    cyclic copy to rounding. The Nyquist component cannot be told from a standing wave and is
    multiplied by the cosine of its phase, so it is the one part that a fraction of a pixel dims.
    """
    nx, ny = topography.shape
    qx, qy = wavenumbers(topography)
    fx = _shift_factor(qx[:, 0], distance_x, None if nx % 2 else nx // 2)
    fy = _shift_factor(qy[0, :], distance_y, None if ny % 2 else ny // 2)
    z = scipy.fft.rfft2(topography.heights) * fx[:, np.newaxis] * fy[np.newaxis, :]
    heights = scipy.fft.irfft2(z, s=(nx, ny))
    return Topography(
        np.ascontiguousarray(heights),
        topography.length_x,
        topography.length_y,
        topography.origin,
        topography.seed,
    )


def resampled(topography: Topography, pixels: tuple[int, int]) -> Topography:
    """Return the tile on a finer grid by its Fourier interpolant, (nx, ny) = `pixels`.

    Raises
    ------
    ValueError
        If the new grid has fewer pixels in a direction.
    """
    if pixels == topography.shape:
        return topography
    z = topography.heights
    for axis in (0, 1):
        old, new = topography.shape[axis], pixels[axis]
        if new < old:
            raise ValueError(f"cannot resample {topography.shape} pixels to fewer, {pixels}")
        if new == old:
            continue
        values = scipy.fft.rfft(z, axis=axis, norm="forward")
        if old % 2 == 0:
            # the Nyquist component is one of two conjugate halves on a finer grid
            index = [slice(None), slice(None)]
            index[axis] = slice(old // 2, old // 2 + 1)
            values[tuple(index)] *= 0.5
        z = scipy.fft.irfft(values, n=new, axis=axis, norm="forward")
    return Topography(
        np.ascontiguousarray(z),
        topography.length_x,
        topography.length_y,
        topography.origin,
        topography.seed,
    )


def psd_2d(topography: Topography) -> tuple[Array, Array, Array]:
    """Power spectral density of a tile.

    Returns
    -------
    qx, qy
        (nx,) and (ny,) [rad/m], ascending, zero at index nx//2 and ny//2.
    c2d
        (nx, ny) [m^4]; sum(c2d)/(Lx Ly) is the mean square height about the mean.
    """
    nx, ny = topography.shape
    dx, dy = topography.pixel
    z = topography.heights - topography.heights.mean()
    amplitude = scipy.fft.fft2(z, norm="forward")
    area = topography.length_x * topography.length_y
    c2d = scipy.fft.fftshift(area * np.abs(amplitude) ** 2)
    qx = scipy.fft.fftshift(2.0 * np.pi * scipy.fft.fftfreq(nx, dx))
    qy = scipy.fft.fftshift(2.0 * np.pi * scipy.fft.fftfreq(ny, dy))
    return qx, qy, c2d


def psd_isotropic(topography: Topography) -> tuple[Array, Array]:
    """Mean of C2D over annuli of |q|.

    The annuli are centred on the multiples of 2 pi/min(Lx, Ly) and as wide. What lies beyond the
    smaller Nyquist wavenumber, where the square no longer fills the circle, is left out, and so
    are empty annuli.

    Returns
    -------
    q
        (n,) mean wavenumber of each annulus [rad/m], ascending.
    c_iso
        (n,) [m^4].
    """
    qx, qy, c2d = psd_2d(topography)
    q = np.hypot(qx[:, np.newaxis], qy[np.newaxis, :])
    step = 2.0 * np.pi / min(topography.length_x, topography.length_y)
    largest = np.pi / max(topography.pixel)
    ring = np.rint(q / step).astype(int)
    keep = (ring > 0) & (q <= largest * (1.0 + 1e-12))
    count = np.bincount(ring[keep])
    filled = count > 0
    mean_q = np.bincount(ring[keep], q[keep])[filled] / count[filled]
    mean_c = np.bincount(ring[keep], c2d[keep])[filled] / count[filled]
    return mean_q, mean_c


def rms_from_psd(c2d: ArrayLike, length_x: float, length_y: float) -> float:
    """Rms height [m] of a spectrum C2D [m^4] of a tile: sqrt(sum C2D/(Lx Ly))."""
    return math.sqrt(float(np.sum(c2d)) / (length_x * length_y))
