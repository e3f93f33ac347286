# SPDX-License-Identifier: BSD-3-Clause
"""Input at the edge for ``pyehl bench faults``: refused by name, at once, nothing written."""

from __future__ import annotations

import os
import subprocess
import threading
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import pyehl
from pyehl.bench.faults_resources import Found, Run
from pyehl.errors import EhlError
from pyehl.solver import Solver

__all__ = ["arguments", "inputs_at_the_edge", "reads"]

ONCE = 60.0
"""Seconds within which input is refused, start of the program included."""
MAP = """&contact load = 20.0 /
&grid points = 33 /
&surface kind = 'map' file = '{}' length_x = 1e-3 length_y = 1e-3 /
"""
# What is given, and what the message must name
COMMANDS: tuple[tuple[tuple[str, ...], str], ...] = (
    (("check", "/dev/zero"), "/dev/zero"),
    (("check", "/dev/random"), "/dev/random"),
    (("check", "pipe"), "pipe"),
    (("check", "."), "folder"),
    (("check", "binary.nml"), "binary.nml"),
    (("check", "long.nml"), "long.nml"),
    (("check", "npy.nml"), "sparse.npy"),
    (("predict", "npy.nml", "-o", "edge-out"), "sparse.npy"),
    (("surface", "npy.nml"), "sparse.npy"),
    (("run", "txt.nml", "-o", "edge-out"), "sparse.txt"),
    (("run", "pipe.nml", "-o", "edge-out"), "surface.file"),
    (("check", "case.nml", "--set", "contact.moes_m=-1"), "contact.moes_m"),
    (("check", "radius.nml"), "contact.radius"),
    (("check", "fast.nml", "--set", "time.steps=10000000"), "output.frame_interval"),
    (("check", "case.nml", "--set", "surface.velocity_ratio=1e-12"), "surface.velocity_ratio"),
    (("check", "case.nml", "--set", "surface.file=\udcff", "--set", "surface.kind=map"), "file"),
    (("predict", "wave.nml", "-o", "edge-out"), "a wave of"),
)
# Calls of Python with arguments of the wrong kind; the path of a case is given
CALLS: tuple[Callable[[str], Any], ...] = (
    lambda path: pyehl.Case.from_text(None),  # type: ignore[arg-type]
    lambda path: pyehl.Case.from_text(path, {"grid.points": 65}),
    lambda path: pyehl.Case.read(path, 65),  # type: ignore[arg-type]
    lambda path: pyehl.Case.read(path, b"grid.points=65"),  # type: ignore[arg-type]
    lambda path: pyehl.Case.read(None),  # type: ignore[arg-type]
    lambda path: pyehl.solve(pyehl.Case("nonsense")),
    lambda path: pyehl.solve([path]),  # type: ignore[arg-type]
    lambda path: pyehl.solve(path, output=3),  # type: ignore[arg-type]
    lambda path: pyehl.solve(path, progress="x"),  # type: ignore[arg-type]
    lambda path: pyehl.predict(path, smooth=3),  # type: ignore[arg-type]
    lambda path: pyehl.Solver(path, "grid.points=33").field(3),  # type: ignore[arg-type]
    lambda path: pyehl.Solver.open(path, np.full((8, 8), np.nan)),
    lambda path: pyehl.Solver.open(path, [[1.0], [2.0, 3.0]]),
    lambda path: pyehl.load(None),  # type: ignore[arg-type]
    pyehl.load,
    lambda path: pyehl.sweep(path, ["contact.load"]),  # type: ignore[arg-type]
    lambda path: pyehl.sweep(path, {"contact.moes_m": [object()]}),
    lambda path: pyehl.sweep(path, {"contact.moes_m": [9.0]}, jobs="x"),  # type: ignore[arg-type]
)
WAVE = (
    "&contact moes_m = 100.0 moes_l = 6.0 /\n&grid points = 65 /\n"
    "&surface kind = 'harmonic' amplitude_over_film = 0.2 wavelength = 1.0 /\n"
    "&time steps = 25 /\n"
)


def _files(folder: Path) -> None:
    """Write what `COMMANDS` read; files with holes take no room on the disk."""
    os.mkfifo(folder / "pipe")
    (folder / "binary.nml").write_bytes(bytes(range(256)))
    (folder / "long.nml").write_text("! a line\n" * 200_000, encoding="utf-8")
    for kind in ("npy", "txt"):
        name = f"sparse.{kind}"
        (folder / f"{kind}.nml").write_text(MAP.format(name), encoding="utf-8")
        with (folder / name).open("wb") as stream:
            if kind == "npy":
                header = {"descr": "<f8", "fortran_order": False, "shape": (400_000, 400_000)}
                np.lib.format.write_array_header_1_0(stream, header)
            else:
                stream.write(b"1 2 3 4\n")
            stream.truncate(stream.tell() + 8 * 400_000**2)
    (folder / "pipe.nml").write_text(MAP.format("pipe"), encoding="utf-8")
    (folder / "radius.nml").write_text("&contact load=10.0 radius=9.525 /\n", encoding="utf-8")
    (folder / "wave.nml").write_text(
        "&surface kind = 'harmonic' wavelength_y = 1e6 /\n", encoding="utf-8"
    )
    (folder / "fast.nml").write_text(
        WAVE.replace("&time steps = 25 /", "&output frame_interval = 1e-12 /"), encoding="utf-8"
    )


def inputs_at_the_edge(folder: Path, run: Run) -> Found:
    """Give devices, pipes, files of terabytes and values at the edge to commands."""
    counts: Counter[str] = Counter()
    bad: list[str] = []
    _files(folder)
    for words, part in COMMANDS:
        told = " ".join(words).encode(errors="replace").decode()
        try:
            done = run(folder, *words, timeout=ONCE)
        except subprocess.TimeoutExpired:
            bad.append(f"{told}: a hang")
            continue
        counts["refused"] += 1
        if done.returncode not in (1, 2) or "Traceback" in done.stderr or part not in done.stderr:
            bad.append(f"{told}: exit status {done.returncode}: {done.stderr}")
        if (folder / "edge-out").exists():
            bad.append(f"{told}: a folder is there")
    return len(COMMANDS), dict(counts), bad


def arguments(folder: Path) -> Found:
    """Call Python with arguments of the wrong kind."""
    bad: list[str] = []
    for number, call in enumerate(CALLS):
        try:
            call(str(folder / "case.nml"))
        except EhlError:
            continue
        except Exception as error:
            bad.append(f"call {number}: {type(error).__name__}: {error}")
        else:
            bad.append(f"call {number}: accepted")
    return len(CALLS), {"refused": len(CALLS) - len(bad)}, bad


def reads(times: int) -> Found:
    """Read fields while another thread advances: each is the whole state after some step."""
    case = pyehl.Case(WAVE)
    with Solver(case) as solver:
        states = {solver.field("P").tobytes()}
        while not solver.advance():
            states.add(solver.field("P").tobytes())
        states.add(solver.field("P").tobytes())
    counts: Counter[str] = Counter()
    bad: list[str] = []
    while sum(counts.values()) < times:
        with Solver(case) as solver:
            worker = threading.Thread(target=solver.run)
            worker.start()
            while worker.is_alive() and sum(counts.values()) < times:
                try:
                    whole = solver.field("P").tobytes() in states
                    solver.summary()
                    solver.progress()
                except EhlError as error:
                    bad.append(str(error))
                    continue
                counts["whole states" if whole else "no state"] += 1
            worker.join()
    if counts["no state"]:
        bad.append(f"{counts['no state']} of {times} fields are no state at all")
    return times, dict(counts), bad
