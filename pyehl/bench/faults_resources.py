# SPDX-License-Identifier: BSD-3-Clause
"""Faults of the machine for ``pyehl bench faults``: disk, memory, folders, damaged states."""

from __future__ import annotations

import os
import resource
import shutil
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

__all__ = ["damage", "limited", "resources"]

Run = Callable[..., subprocess.CompletedProcess[str]]
Found = tuple[int, dict[str, int], list[str]]

# A full disk is an error of a write, not a signal
LIMITED = (
    "import resource, signal, sys; from pyehl import cli; import pyehl.commands.run; "
    "signal.signal(signal.SIGXFSZ, signal.SIG_IGN); kind, size = map(int, sys.argv[1:3]); "
    "resource.setrlimit(kind, (size, size)); sys.exit(cli.main(sys.argv[3:]))"
)
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
    files = sorted(path.name for path in kept.glob("*checkpoint.*"))
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


def limited(folder: Path, kind: int, size: int, *words: str) -> subprocess.CompletedProcess[str]:
    """Run ``pyehl`` with a limit, set behind its imports: an editable package may build."""
    return subprocess.run(
        [sys.executable, "-P", "-c", LIMITED, str(kind), str(size), *words],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=900.0,
        check=False,
    )


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
    for size in (1000, 10_000, 30_000, 100_000):
        trials += 1
        out = folder / f"full-{size}"
        done = limited(folder, resource.RLIMIT_FSIZE, size, "run", "case.nml", "-o", out.name)
        refused(f"disk full after {size} bytes", out, done)
    trials += 3
    (folder / "file").write_text("", encoding="utf-8")
    refused("a file in place of a folder", folder / "x", _try(run, folder, "file/x"))
    refused("no right to write", folder / "x", _try(run, folder, "/proc/pyehl"))
    bad += _gone(folder)
    counts["folder gone"] += 1
    trials += 1
    words = ("run", "case.nml", "-o", "large", "--set", "grid.points=4097")
    done = limited(folder, resource.RLIMIT_AS, MEMORY, *words)
    refused("no memory at 4097^2", folder / "large", done)
    trials += 1
    bad += _two(folder)
    counts["two runs into one folder"] += 1
    return trials, dict(counts), bad


def _try(run: Run, folder: Path, out: str) -> subprocess.CompletedProcess[str]:
    return run(folder, "run", "case.nml", "-o", out)


def _gone(folder: Path) -> list[str]:
    """Take the folder of a run away while it works."""
    gone = folder / "gone"
    gone.mkdir()
    words = [sys.executable, "-P", "-m", "pyehl", "run", "case.nml", "-o", "gone/out"]
    process = subprocess.Popen(
        words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    until = time.monotonic() + 60.0
    while process.poll() is None and not any(gone.iterdir()) and time.monotonic() < until:
        time.sleep(0.01)
    shutil.rmtree(gone, ignore_errors=True)
    told = process.communicate()[1]
    if "Traceback" in told or process.returncode not in (0, 1, 2):
        return [f"folder gone: exit status {process.returncode}: {told}"]
    return []


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
