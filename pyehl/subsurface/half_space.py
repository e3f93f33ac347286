# SPDX-License-Identifier: BSD-3-Clause
"""Stress in an elastic half-space under pressure and shear traction on its surface, by FFT.

The half-space is z > 0, x along the motion. A wave exp(i k.x) of the pressure p, or of the traction
q that acts on the solid, has the plane strain solution of its wavenumber k = |k| (Johnson 1985,
*Contact Mechanics*, chapter 2): with l along k, t across it in the surface, and e = exp(-k z)

=========  ==================  =============================  ==============
component  p                   q along l                      q along t
=========  ==================  =============================  ==============
ll         -(1 - k z) e        i (2 - k z) e                  0
tt         -2 nu e             2 i nu e                       0
zz         -(1 + k z) e        i k z e                        0
lz         i k z e             -(1 - k z) e                   0
lt, tz     0                   0                              i e, -e
=========  ==================  =============================  ==============

Tension is positive. The transform makes the load periodic. The stress caused by the periodic images
varies slowly over the contact; it is computed on a coarse grid, as the difference between two
periodic cells of which the second is `FAR` times as large, and subtracted.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.fft

from pyehl.types import Array, Complex

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
"""Order of the components in all arrays of stresses."""
# Size of the larger cell over that of the periodic cell; for a line, whose images decay more slowly
FAR, FAR_LINE = 8, 64
# Minimum number of blocks of the coarse grid along a side
BLOCKS = 24


@dataclass(frozen=True, slots=True)
class _Waves:
    """Waves of a periodic cell: wavenumber k, and cos and sin of its angle to x.

    k is over the unit of the mesh sizes.
    """

    cell: tuple[int, int]
    k: Array
    c: Array  # cos for odd powers, 0 at the Nyquist wave
    s: Array
    cc: Array  # cos^2
    ss: Array

    @classmethod
    def of(cls, cell: tuple[int, int], mesh: tuple[float, float], mean: float) -> _Waves:
        """Return the waves; `mean` is cos^2 for k = 0, which has no direction."""
        kx = 2.0 * np.pi * scipy.fft.fftfreq(cell[0], mesh[0])[:, None]
        ky = 2.0 * np.pi * scipy.fft.rfftfreq(cell[1], mesh[1])[None, :]
        k = np.hypot(kx, ky)
        k[0, 0] = 1.0
        c, s = kx / k, ky / k
        k[0, 0] = 0.0
        cc, ss = c**2, s**2
        cc[0, 0], ss[0, 0] = mean, 1.0 - mean
        # a real transform has no odd part at the Nyquist wavenumber
        if cell[0] % 2 == 0:
            c[cell[0] // 2, :] = 0.0
        if cell[1] % 2 == 0:
            s[:, -1] = 0.0
        return cls(cell, k, c, s, cc, ss)

    def by_pressure(self, depth: float, nu: float) -> list[Array | Complex]:
        """Stress of each wave for unit pressure, by `COMPONENTS`."""
        kz, c, s, cc, ss = self.k * depth, self.c, self.s, self.cc, self.ss
        e = np.exp(-kz)
        return [
            -e * (cc * (1.0 - kz) + 2.0 * nu * ss),
            -e * (ss * (1.0 - kz) + 2.0 * nu * cc),
            -e * (1.0 + kz),
            -e * (c * s * (1.0 - kz - 2.0 * nu)),
            1j * e * c * kz,
            1j * e * s * kz,
        ]

    def by_traction(self, depth: float, nu: float) -> list[Array | Complex]:
        """Stress for unit traction along x, whose components are c along k and -s across it."""
        kz, c, s, cc, ss = self.k * depth, self.c, self.s, self.cc, self.ss
        e = np.exp(-kz)
        return [
            1j * e * c * (cc * (2.0 - kz) + 2.0 * (1.0 + nu) * ss),
            1j * e * c * (2.0 * nu * cc - ss * kz),
            1j * e * c * kz,
            1j * e * s * (cc * (1.0 - kz - 2.0 * nu) + ss),
            -e * (cc * (1.0 - kz) + ss),
            e * c * s * kz,
        ]


@dataclass(frozen=True, slots=True)
class _Kernels:
    """Fourier kernels of the stress at one depth on one cell."""

    cell: tuple[int, int]
    of_pressure: list[Array | Complex]
    of_traction: list[Array | Complex]

    @classmethod
    def of(cls, waves: _Waves, depth: float, nu: float) -> _Kernels:
        return cls(waves.cell, waves.by_pressure(depth, nu), waves.by_traction(depth, nu))

    def under(self, pressure: Array, traction: Array | None) -> Array:
        """Stress (6, nx, ny) under loads (nx, ny) on the first nodes of the cell."""
        p = scipy.fft.rfft2(pressure, self.cell)
        waves = [kernel * p for kernel in self.of_pressure]
        if traction is not None:
            q = scipy.fft.rfft2(traction, self.cell)
            waves = [w + kernel * q for w, kernel in zip(waves, self.of_traction, strict=True)]
        nx, ny = pressure.shape
        return np.stack([scipy.fft.irfft2(wave, self.cell)[:nx, :ny] for wave in waves])


class HalfSpace:
    """An elastic half-space under loads on a grid of its surface.

    Parameters
    ----------
    shape
        Nodes (nx, ny).
    mesh
        Mesh sizes along x and y [m], or in any other unit of length.
    poisson
        Ratio nu [-].
    periodic
        Whether the load is periodic along x and along y; along y alone it is a line contact.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        mesh: tuple[float, float],
        *,
        poisson: float = 0.3,
        periodic: tuple[bool, bool] = (False, False),
    ) -> None:
        self.shape, self.poisson = shape, poisson
        blocks, cell = zip(*map(_blocks, shape, periodic), strict=True)
        mean = {(False, True): 1.0, (True, False): 0.0}.get(periodic, 0.5)
        self._waves = _Waves.of(cell, mesh, mean)
        self._far: Images | None = None
        if not all(periodic):
            coarse_mesh = mesh[0] * blocks[0], mesh[1] * blocks[1]
            near_cell = cell[0] // blocks[0], cell[1] // blocks[1]
            self._far = Images(shape, blocks, coarse_mesh, near_cell, periodic, mean)

    def layer(self, depth: float) -> Layer:
        """Return the kernels at a depth, in the unit of the mesh sizes."""
        fine = _Kernels.of(self._waves, depth, self.poisson)
        return Layer(fine, self._far.at(depth, self.poisson) if self._far else None)


class Images:
    """Stress caused by the periodic images of a load, on a coarse grid.

    Loads are on a grid of `shape`; `blocks` of its nodes form the cells of the coarse grid, which
    has mesh sizes `mesh` and a periodic cell of `cell` blocks.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        blocks: tuple[int, int],
        mesh: tuple[float, float],
        cell: tuple[int, int],
        periodic: tuple[bool, bool],
        mean: float,
    ) -> None:
        # the effect of images decays as 1/distance for a line, as 1/distance^2 for a point contact
        far = FAR_LINE if any(periodic) else FAR
        self.decay = float(far if any(periodic) else far**2)
        self.blocks = blocks
        self.to_fine = [_interpolation(n, b) for n, b in zip(shape, blocks, strict=True)]
        far_x, far_y = (n if p else far * n for n, p in zip(cell, periodic, strict=True))
        self._waves = [_Waves.of(c, mesh, mean) for c in (cell, (far_x, far_y))]
        # offsets between blocks, in the order of a cyclic convolution
        self._offsets = [
            np.fft.ifftshift(np.arange(1 - m.shape[1], m.shape[1])) for m in self.to_fine
        ]

    def at(self, depth: float, nu: float) -> ImagesAt:
        """Return the kernels of the images at a depth."""
        near, far = (_Kernels.of(waves, depth, nu) for waves in self._waves)
        return ImagesAt(self, near, far)

    def transforms(self, near: _Kernels, far: _Kernels, name: str) -> list[Complex]:
        """Return the transformed stress of the images of a load on one block."""
        result = []
        for pair in zip(getattr(near, name), getattr(far, name), strict=True):
            one, other = (
                scipy.fft.irfft2(kernel, kernels.cell)[
                    np.ix_(*(o % n for o, n in zip(self._offsets, kernels.cell, strict=True)))
                ]
                for kernel, kernels in zip(pair, (near, far), strict=True)
            )
            result.append(scipy.fft.rfft2(one - other))
        return result


class ImagesAt:
    """Stress of the images at one depth, for any number of loads."""

    def __init__(self, images: Images, near: _Kernels, far: _Kernels) -> None:
        self._images, self._pair = images, (near, far)
        self._kernels: dict[str, list[Complex]] = {}

    def under(self, pressure: Array, traction: Array | None) -> Array:
        """Return the stress (6, nx, ny) of the images of loads (nx, ny)."""
        images = self._images
        total: list[Complex] = []
        for name, load in (("of_pressure", pressure), ("of_traction", traction)):
            if load is None:
                continue
            if name not in self._kernels:
                self._kernels[name] = images.transforms(*self._pair, name)
            coarse = _block_means(load, images.blocks)
            cell = tuple(2 * n - 1 for n in coarse.shape)
            wave = scipy.fft.rfft2(coarse, cell)
            parts = [kernel * wave for kernel in self._kernels[name]]
            total = [a + b for a, b in zip(total, parts, strict=True)] if total else parts
        nx, ny = coarse.shape
        result = np.stack([scipy.fft.irfft2(wave, cell)[:nx, :ny] for wave in total])
        to_x, to_y = images.to_fine
        return np.asarray(to_x @ result @ to_y.T)

    def left(self, pressure: Array, traction: Array | None) -> float:
        """Bound on the remaining stress of images, those of the larger cell."""
        return float(np.max(np.abs(self.under(pressure, traction)))) / self._images.decay


@dataclass(frozen=True, slots=True)
class Layer:
    """A depth of a half-space, for any number of loads."""

    fine: _Kernels
    images: ImagesAt | None

    def under(self, pressure: Array, traction: Array | None = None) -> Array:
        """Stress (6, nx, ny) in the unit of the loads, by `COMPONENTS`.

        Parameters
        ----------
        pressure
            (nx, ny) [Pa], or in any other unit of stress.
        traction
            Along x on the surface of this solid, (nx, ny), in the same unit; None: without
            friction.
        """
        stress = self.fine.under(pressure, traction)
        if self.images:
            stress -= self.images.under(pressure, traction)
        return stress

    def error(self, pressure: Array, traction: Array | None = None) -> float:
        """Bound on the error of `under` by the periodic cell, in its unit; 0 without images."""
        return self.images.left(pressure, traction) if self.images else 0.0


def _blocks(n: int, periodic: bool) -> tuple[int, int]:
    """Nodes per block of the coarse grid, and nodes of the periodic cell, along a side."""
    if periodic:
        return 1, n
    block = max(1, n // BLOCKS)
    return block, block * scipy.fft.next_fast_len(-(-n // block), real=True)


def _block_means(values: Array, blocks: tuple[int, int]) -> Array:
    """Means over blocks of nodes, padded with zeros beyond the last node."""
    (nx, ny), (bx, by) = values.shape, blocks
    whole = np.zeros((-(-nx // bx) * bx, -(-ny // by) * by))
    whole[:nx, :ny] = values
    return np.asarray(whole.reshape(-1, bx, whole.shape[1] // by, by).mean(axis=(1, 3)))


def _interpolation(n: int, block: int) -> Array:
    """Matrix (n, blocks) of linear inter- and extrapolation from the centres of blocks to nodes."""
    blocks = -(-n // block)
    place = (np.arange(n) - 0.5 * (block - 1)) / block
    left = np.clip(np.floor(place), 0, max(blocks - 2, 0)).astype(int)
    weights = np.zeros((n, blocks))
    rows = np.arange(n)
    weights[rows, left] = 1.0 - (place - left)
    if blocks > 1:
        weights[rows, left + 1] = place - left
    return weights
