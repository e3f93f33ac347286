# SPDX-License-Identifier: BSD-3-Clause
"""Faults of the machine for ``pyehl bench faults``: disk, memory, folders, damaged states."""

from __future__ import annotations

import os
import resource
import shutil
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

__all__ = ["damage", "resources"]

Run = Callable[..., subprocess.CompletedProcess[str]]
Found = tuple[int, dict[str, int], list[str]]

MEMORY = 600 * 2**20
"""Bytes that a run of 4097 x 4097 nodes is given; on the way there it solves coarser grids."""
REGIONS = 32
"""Parts of a state; a byte of each is flipped in turn."""


def damage(
    folder: Path,
    generator: np.random.Generator,
    run: Run,
    same: Callable[[Path, Path], str],
) -> Found:
    """Flip a byte of every region of the newest state, or of both, and resume.

    A damaged state is noticed: the older one, or the beginning, takes its place, and the bits are
    those of an unbroken run.
    """
    counts: Counter[str] = Counter()
    bad: list[str] = []
    # a run that is not converged leaves its states
    run(folder, "run", "case.nml", "-o", "state", "--set", "time.steps=60")
    kept = folder / "state.checkpoint"
    if not kept.is_dir():
        return 0, {}, ["a run that ended early has left no state"]
    whole = folder / "resumed"
    _copy(folder, whole)
    run(folder, "run", "--resume", "resumed", "--set", "time.steps=62")
    files = sorted(path.name for path in kept.glob("*checkpoint.?"))
    trials = 0
    for both in (False, True):
        for region in range(REGIONS):
            trials += 1
            out = folder / "damaged"
            _copy(folder, out)
            newest = max(files, key=lambda name: (kept / name).stat().st_mtime_ns)
            for name in files if both else [newest]:
                _flip(out.with_name("damaged.checkpoint") / name, region, generator)
            done = run(folder, "run", "--resume", "damaged", "--set", "time.steps=62")
            if "Traceback" in done.stderr or done.returncode not in (0, 1, 2):
                bad.append(f"region {region}, both {both}: {done.returncode} {done.stderr}")
            elif done.returncode == 2 or "damaged" in done.stderr.replace("--resume damaged", ""):
                counts["told"] += 1
            if done.returncode in (0, 1):
                difference = same(whole, out)
                counts["same bits" if not difference else "other bits"] += 1
                if difference:
                    bad.append(f"region {region}, both {both}: {difference}: {done.stderr}")
    return trials, dict(counts), bad


def _copy(folder: Path, out: Path) -> None:
    for suffix in ("", ".checkpoint"):
        target = out.with_name(out.name + suffix)
        shutil.rmtree(target, ignore_errors=True)
        source = folder / f"state{suffix}"
        if source.is_dir():
            shutil.copytree(source, target)


def _flip(path: Path, region: int, generator: np.random.Generator) -> None:
    data = bytearray(path.read_bytes())
    first, last = (len(data) * k // REGIONS for k in (region, region + 1))
    at = int(generator.integers(first, max(first + 1, last)))
    data[at] ^= int(generator.integers(1, 256))
    path.write_bytes(bytes(data))


def _limit(kind: int, size: int) -> Callable[[], None]:
    def set_limit() -> None:
        # a full disk is an error of a write, not a signal
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(kind, (size, size))

    return set_limit


def resources(folder: Path, run: Run) -> Found:
    """Take away the disk, the folder, the right to write, and memory; two runs into one folder."""
    bad: list[str] = []
    counts: Counter[str] = Counter()

    def refused(name: str, out: Path, done: subprocess.CompletedProcess[str]) -> None:
        """Check that it failed with a message and left nothing half-written."""
        counts["refused" if done.returncode in (1, 2) else "done"] += 1
        if "Traceback" in done.stderr or done.returncode not in (1, 2) or not done.stderr.strip():
            bad.append(f"{name}: exit status {done.returncode}: {done.stderr}")
        if out.is_dir() and not (out / "summary.json").is_file():
            bad.append(f"{name}: half a folder {sorted(p.name for p in out.iterdir())}")

    trials = 0
    for size in (0, 1000, 10_000, 30_000):
        trials += 1
        out = folder / f"full-{size}"
        done = run(
            folder,
            "run",
            "case.nml",
            "-o",
            out.name,
            preexec_fn=_limit(resource.RLIMIT_FSIZE, size),
        )
        refused(f"disk full after {size} bytes", out, done)
    for size in (0, 500):
        trials += 1
        out = folder / f"full-sweep-{size}"
        words = ["sweep", "case.nml", "--run", "film", "--vary", "contact.moes_m=60,70"]
        done = run(folder, *words, "-o", out.name, preexec_fn=_limit(resource.RLIMIT_FSIZE, size))
        counts["refused" if done.returncode in (1, 2) else "done"] += 1
        if "Traceback" in done.stderr or done.returncode not in (1, 2):
            bad.append(f"sweep, disk full: exit status {done.returncode}: {done.stderr}")
    trials += 3
    (folder / "file").write_text("", encoding="utf-8")
    refused("a file in place of a folder", folder / "x", _try(run, folder, "file/x"))
    refused("no right to write", folder / "x", _try(run, folder, "/proc/pyehl"))
    gone = folder / "gone"
    gone.mkdir()
    case = (folder / "case.nml").read_text(encoding="utf-8")
    (gone / "case.nml").write_text(case, encoding="utf-8")
    refused("folder gone", folder / "x", _try(run, folder, "gone/a/../../nowhere/b/out"))
    trials += 1
    done = run(
        folder,
        *("run", "case.nml", "-o", "large", "--set", "grid.points=4097"),
        preexec_fn=_limit(resource.RLIMIT_AS, MEMORY),
    )
    refused("no memory at 4097^2", folder / "large", done)
    trials += 1
    bad += _two(folder)
    counts["two runs into one folder"] += 1
    return trials, dict(counts), bad


def _try(run: Run, folder: Path, out: str) -> subprocess.CompletedProcess[str]:
    return run(folder, "run", "case.nml", "-o", out)


def _two(folder: Path) -> list[str]:
    """Start two runs into one folder at once: one of them ends whole, none tears the other's."""
    words = [sys.executable, "-P", "-m", "pyehl", "run", "case.nml", "-o", "shared"]
    pair: list[Any] = [
        subprocess.Popen(
            words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        for _ in range(2)
    ]
    told = [process.communicate()[1] for process in pair]
    states = [process.returncode for process in pair]
    bad = [f"two runs: {text}" for text in told if "Traceback" in text]
    if 0 not in states or any(state not in (0, 1, 2) for state in states):
        bad.append(f"two runs: exit statuses {states}: {told}")
    if not (folder / "shared" / "summary.json").is_file():
        bad.append(f"two runs: {sorted(os.listdir(folder / 'shared'))}")
    return bad
