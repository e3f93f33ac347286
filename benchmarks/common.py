# SPDX-License-Identifier: BSD-3-Clause
"""Command line, tables and unit of time of the benchmarks.

The unit is the time of one elastic deflection by scipy.fft on the same grid: zero-padded, real,
float64, one worker, kernel transformed beforehand.
"""

import argparse
import os
import platform
import resource
import statistics
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

# products of small matrices are slower on several threads; set before NumPy is imported
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import scipy.fft

from pyehl import library
from pyehl.cli import status_of
from pyehl.destination import check_files, mark, write_json
from pyehl.types import Array, Mask, Row

LISTS = {"points": "nodes per side", "threads": "numbers of threads"}
GRIDS = (65, 129, 257, 513, 1025)
X_INLET, X_OUTLET, Y_EXTENT = -2.5, 1.5, 2.0

Columns = Sequence[tuple[str, str]]
"""Names and formats of the columns of a table."""


def columns(text: str) -> Columns:
    """Parse names and formats, as in 'points:d error:.1e'."""
    return [(name, form) for name, form in (word.split(":") for word in text.split())]


def say(text: str) -> None:
    """Report progress."""
    print(text, file=sys.stderr)


def parser(text: str | None, **lists: Sequence[int]) -> argparse.ArgumentParser:
    """Make the parser of a script from its docstring; `lists` has defaults of its options."""
    made = argparse.ArgumentParser(description=(text or "").split("\n\n")[0], allow_abbrev=False)
    for name, default in lists.items():
        add_list(made, name, default, LISTS[name])
    return made


def add_list(
    to: argparse.ArgumentParser,
    name: str,
    default: Sequence[object],
    what: str = "",
    known: Sequence[str] = (),
) -> None:
    """Add an option of comma-separated values: words, each one of `known`, or integers."""
    minimum = 1 if name == "threads" else 3

    def read(text: str) -> list[str] | list[int]:
        words = text.split(",")
        if known:
            if unknown := [word for word in words if word not in known]:
                raise argparse.ArgumentTypeError(
                    f"'{unknown[0]}'; expected: some of {', '.join(known)}"
                )
            return words
        try:
            numbers = [int(word) for word in words]
        except ValueError as error:
            raise argparse.ArgumentTypeError(f"'{text}' is not like 129,257") from error
        if min(numbers) < minimum:
            raise argparse.ArgumentTypeError(f"{min(numbers)}; expected: {minimum} or more")
        return numbers

    what = f"of {', '.join(known)}{what}" if known else what
    shown = "all" if known and len(default) == len(known) else ",".join(map(str, default))
    to.add_argument(
        f"--{name}",
        type=read,
        default=list(default),
        metavar="NAME,NAME,..." if known else "N,N,...",
        help=f"{what} (default: {shown})" if shown else what,
    )


def add_number(
    to: argparse.ArgumentParser, name: str, default: float, what: str = "", *, minimum: float = 0
) -> None:
    """Add an option for a number of the type of its default; an integer is at least `minimum`."""

    def read(text: str) -> float:
        number = type(default)(text)
        if isinstance(default, int) and number < minimum:
            raise argparse.ArgumentTypeError(f"{text}; expected: {minimum} or more")
        return number

    read.__name__ = type(default).__name__
    help_text = f"{what} (default: {default:g})".lstrip()
    to.add_argument(f"--{name}", type=read, default=default, help=help_text)


def measure(
    work: Callable[[argparse.Namespace], dict[str, object]],
    made: argparse.ArgumentParser,
    words: Sequence[str] | None,
    *,
    picture: bool = False,
) -> int:
    """Run a script; with ``--output`` its result goes into a JSON file, and `picture` beside it."""
    made.add_argument("-o", "--output", type=Path, metavar="FILE.json", help="write JSON too")
    args = made.parse_args(words)

    def run() -> int:
        if args.output is not None:
            others = [args.output.with_suffix(".png")] if picture else []
            check_files([args.output, *others], "bench")
        answer = header(work) | work(args)
        if args.output is not None:
            write_json(args.output, answer, allow_nan=True)
        return verdict(answer["rows"])  # type: ignore[arg-type]

    return status_of(run)


def header(work: Callable[..., object]) -> dict[str, object]:
    """Return the origin of a JSON file: script, processor and build."""
    return {"source": mark("bench"), "what": Path(work.__code__.co_filename).stem} | {
        "machine": machine()
    }


def verdict(rows: Sequence[Row]) -> int:
    """Return the exit status: 1 if a row is `wrong`, or not the `same` without skipped work."""
    return int(any(row.get("wrong") or not row.get("same", True) for row in rows))


def show(rows: Sequence[Row], columns: Columns, *notes: str) -> None:
    """Print a table, with '-' for missing values, and notes below it."""
    lines = [[name.replace("_", " ") for name, _ in columns]]
    lines += [
        ["-" if row[name] is None else format(row[name], form) for name, form in columns]
        for row in rows
    ]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        print("  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True)))
    for note in notes:
        print(note)


def kernel(nx: int, ny: int, hx: float, hy: float) -> Array:
    """(2/pi^2) times the integral of 1/r over a cell at offsets (i hx, j hy), shape (nx, ny)."""
    x = (np.arange(nx + 1) - 0.5)[:, None] * hx
    y = (np.arange(ny + 1) - 0.5)[None, :] * hy
    corner = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    cells: Array = corner[1:, 1:] - corner[:-1, 1:] - corner[1:, :-1] + corner[:-1, :-1]
    return 2.0 / np.pi**2 * cells


class ScipyDeflection:
    """Zero-padded circular convolution by scipy.fft, the unit of time."""

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


def hertz(points: int) -> tuple[Array, float, Array, Mask]:
    """Hertz pressure on a grid, its mesh size, and the exact deflection with its valid nodes."""
    x = np.linspace(X_INLET, X_OUTLET, points)
    y = np.linspace(-Y_EXTENT, Y_EXTENT, points)
    r2 = x[:, None] ** 2 + y[None, :] ** 2
    return np.sqrt(np.maximum(0.0, 1.0 - r2)), float(x[1] - x[0]), 1.0 - 0.5 * r2, r2 < 1.0


def median_seconds(call: Callable[[], object]) -> float:
    """Median time of a call, repeated at least three times and for 0.3 seconds."""
    call()
    times: list[float] = []
    while len(times) < 3 or sum(times) < 0.3:
        began = time.perf_counter()
        call()
        times.append(time.perf_counter() - began)
    return statistics.median(times)


def unit_seconds(points: int) -> float:
    """Time one deflection by scipy.fft on `points` nodes per side [s]."""
    pressure, h, _, _ = hertz(points)
    deflection = ScipyDeflection(points, points, h, h)
    return median_seconds(lambda: deflection.apply(pressure))


def processor_seconds() -> float:
    """Processor time of this process and of its finished children [s]."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def machine() -> dict[str, str]:
    """Name the processor and the build of the library to which the times belong."""
    information = Path("/proc/cpuinfo")
    text = information.read_text(encoding="utf-8") if information.is_file() else ""
    models = [line for line in text.splitlines() if line.startswith("model name")]
    model = models[0].partition(":")[2].strip() if models else ""
    return {"processor": model or platform.processor(), "build": library.build()}
