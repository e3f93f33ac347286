# SPDX-License-Identifier: BSD-3-Clause
"""The unit of time of all benchmarks: one elastic deflection by scipy.fft at the same grid.

Zero-padded, real, float64, one worker, kernel transformed beforehand. With what measures seconds.
"""

import platform
import resource
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import scipy.fft

from pyehl import library
from pyehl.types import Array, Mask

X_INLET, X_OUTLET, Y_EXTENT = -2.5, 1.5, 2.0


def kernel(nx: int, ny: int, hx: float, hy: float) -> Array:
    """(2/pi^2) times the integral of 1/r over a cell at offsets (i hx, j hy), shape (nx, ny)."""
    x = (np.arange(nx + 1) - 0.5)[:, None] * hx
    y = (np.arange(ny + 1) - 0.5)[None, :] * hy
    corner = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    cells: Array = corner[1:, 1:] - corner[:-1, 1:] - corner[1:, :-1] + corner[:-1, :-1]
    return 2.0 / np.pi**2 * cells


class ScipyDeflection:
    """Zero-padded circular convolution by scipy.fft, the yardstick of all times."""

    def __init__(self, nx: int, ny: int, hx: float, hy: float) -> None:
        self.shape = nx, ny
        self.padded = tuple(scipy.fft.next_fast_len(2 * n - 1, real=True) for n in (nx, ny))
        quarter = kernel(nx, ny, hx, hy)
        whole = np.zeros(self.padded)
        whole[:nx, :ny] = quarter
        whole[-nx + 1 :, :ny] = quarter[:0:-1, :]
        whole[:, -ny + 1 :] = whole[:, ny - 1 : 0 : -1]
        self.transform = scipy.fft.rfft2(whole, workers=1)

    def apply(self, p: Array) -> Array:
        """Deflection of p, shape (nx, ny)."""
        transform = scipy.fft.rfft2(p, s=self.padded, workers=1)
        transform *= self.transform
        w: Array = scipy.fft.irfft2(transform, s=self.padded, workers=1)
        return w[: self.shape[0], : self.shape[1]]


def median_seconds(call: Callable[[], object]) -> float:
    """Median time of a call, repeated at least three times and for 0.3 seconds."""
    call()
    times: list[float] = []
    while len(times) < 3 or sum(times) < 0.3:
        began = time.perf_counter()
        call()
        times.append(time.perf_counter() - began)
    return statistics.median(times)


def processor_seconds() -> float:
    """Seconds of the processor [s] of this process and of its children that have ended."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def unit_seconds(points: int) -> float:
    """Seconds of one deflection by scipy.fft on so many nodes per side."""
    pressure, h, _, _ = hertz(points)
    yardstick = ScipyDeflection(points, points, h, h)
    return median_seconds(lambda: yardstick.apply(pressure))


def machine() -> dict[str, str]:
    """Name what times belong to: processor, and build of the library."""
    model = ""
    information = Path("/proc/cpuinfo")
    if information.is_file():
        for line in information.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    return {"processor": model or platform.processor(), "build": library.build()}


def hertz(points: int) -> tuple[Array, float, Array, Mask]:
    """Hertz pressure on a grid, its mesh size, the exact deflection, and where that holds."""
    x = np.linspace(X_INLET, X_OUTLET, points)
    y = np.linspace(-Y_EXTENT, Y_EXTENT, points)
    r2 = x[:, None] ** 2 + y[None, :] ** 2
    return np.sqrt(np.maximum(0.0, 1.0 - r2)), float(x[1] - x[0]), 1.0 - 0.5 * r2, r2 < 1.0
