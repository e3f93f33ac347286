# SPDX-License-Identifier: BSD-3-Clause
"""Files of others for ``pyehl bench faults``: they stay; and two first starts of one study."""

from __future__ import annotations

import shutil
import subprocess
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from pyehl.bench.faults_resources import Found, Run

__all__ = ["foreign", "starts"]

FRACTAL = """&contact load = 20.0 /
&grid points = 33 /
&surface kind = 'fractal' pixels = 32 length_x = 1e-4 length_y = 1e-4 rms_height = 2e-8 /
&time steps = 2 estimate_error = .false. /
"""
# What somebody has in a folder, some of it under names of ours
FILES = ("thesis.txt", "sub/data.txt", "report.md", "case.nml", "P.npy", "map.npy", "map.npy.nml",
         "results.csv", "results.nc", "bench.json")  # fmt: skip
# Commands that write; the folder of others is `kept`, `whole` is a result folder
COMMANDS: tuple[tuple[str, ...], ...] = (
    ("run", "case.nml", "-o", "kept"),
    ("predict", "fractal.nml", "-o", "kept"),
    ("stribeck", "fractal.nml", "--speed", "0.5,1", "-o", "kept"),
    ("sweep", "case.nml", "--vary", "contact.moes_m=90,100", "--set", "time.steps=2", "-o", "kept"),
    ("reproduce", "zhang2019", "--table", "1", "--quick", "-o", "kept"),
    ("response", "fractal.nml", "--quick", "-o", "kept"),
    ("surface", "fractal.nml", "-o", "kept/map.npy"),
    ("plot", "whole", "-o", "kept"),
    ("export", "whole", "-o", "kept/results.nc"),
    ("bench", "smooth", "--points", "33", "-o", "kept/bench.json"),
    ("bench", "faults", "--kills", "1", "--inputs", "1", "-o", "kept"),
)
# The same in the folder itself, whose case is the input
HERE: tuple[tuple[str, ...], ...] = (
    ("run", "own.nml", "-o", "."),
    ("predict", "own.nml", "-o", "."),
    ("sweep", "own.nml", "--vary", "surface.seed=1,2", "--run", "predict", "-o", "."),
)
STUDY = ("sweep", "case.nml", "--vary", "contact.moes_m=60:140:9", "--run", "film", "--jobs", "1",
         "--quiet", "-o")  # fmt: skip


def foreign(folder: Path, run: Run) -> Found:
    """Let every command write into a folder with files of others; none of them changes."""
    counts: Counter[str] = Counter()
    bad: list[str] = []
    (folder / "fractal.nml").write_text(FRACTAL, encoding="utf-8")
    kept = folder / "kept"
    for place, commands in ((folder, COMMANDS), (kept, HERE)):
        for words in commands:
            before = _fill(kept)
            done = run(place, *words)
            counts["refused" if done.returncode == 2 else "written beside them"] += 1
            changed = [name for name, data in before.items() if _data(kept / name) != data]
            if changed:
                bad.append(f"{' '.join(words)}: changed {changed}, exit status {done.returncode}")
            if "Traceback" in done.stderr or (done.returncode and not done.stderr.strip()):
                bad.append(f"{' '.join(words)}: exit status {done.returncode}: {done.stderr}")
    # a link stays one, and what it points to is used
    (folder / "target").mkdir()
    (folder / "link").symlink_to("target")
    done = run(folder, "run", "case.nml", "-o", "link", "--set", "time.steps=2")
    counts["by a link"] += 1
    linked = (folder / "link").is_symlink() and (folder / "target" / "summary.json").is_file()
    if done.returncode == 2 or not linked:
        bad.append(f"a link as a folder: exit status {done.returncode}: {done.stderr}")
    return len(COMMANDS) + len(HERE) + 1, dict(counts), bad


def _fill(kept: Path) -> dict[str, bytes]:
    """Make the folder of others anew."""
    shutil.rmtree(kept, ignore_errors=True)
    for name in FILES:
        path = kept / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"precious {name}\n", encoding="utf-8")
    (kept / "own.nml").write_text(FRACTAL, encoding="utf-8")
    return {name: _data(kept / name) for name in (*FILES, "own.nml")}


def _data(path: Path) -> bytes:
    return path.read_bytes() if path.is_file() else b""


def starts(folder: Path, times: int, run: Run, command: Callable[..., list[str]]) -> Found:
    """Start a study twice at once in a new folder: no row is lost, whoever comes first."""
    counts: Counter[str] = Counter()
    bad: list[str] = []
    for number in range(times):
        out = folder / "at-once"
        pair = [
            subprocess.Popen(
                command(*STUDY, out.name),
                cwd=folder,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
            )
            for _ in range(2)
        ]
        told = [process.communicate()[1] for process in pair]
        states = sorted(process.returncode for process in pair)
        counts["one refused" if states == [0, 2] else "both ended"] += 1
        journal = (out / "journal.jsonl").read_bytes() if out.is_dir() else b""
        if states[0] != 0 or states[1] not in (0, 2) or any("Traceback" in text for text in told):
            bad.append(f"start {number}: exit statuses {states}: {told}")
        rows = journal.count(b'"case":')
        if rows < 9:
            bad.append(f"start {number}: {rows} of 9 rows in the journal")
        again = run(folder, *STUDY, out.name)
        if again.returncode:
            bad.append(f"start {number}, again: {again.stderr}")
        shutil.rmtree(out, ignore_errors=True)
    return times, dict(counts), bad
