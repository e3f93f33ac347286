# SPDX-License-Identifier: BSD-3-Clause
"""Damaged states for ``pyehl bench faults``."""

import shutil
import subprocess
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np

Run = Callable[..., subprocess.CompletedProcess[str]]
Found = tuple[int, dict[str, int], list[str]]

REGIONS = 32
"""Parts of a state; a byte of each is flipped in turn."""


def damage(
    folder: Path, generator: np.random.Generator, run: Run, same: Callable[[Path, Path], str]
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
