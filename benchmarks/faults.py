# SPDX-License-Identifier: BSD-3-Clause
"""Fault injection: killed processes, damaged checkpoints and hostile input, from a seed.

No result may be lost, no run may leave an incomplete folder, no input may end in a traceback or a
hang, and a run that was killed and resumed gives the bits of an uninterrupted one.
"""

import argparse
import csv
import json
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from common import add_number, columns, header, parser, say, show, verdict
from faults_inputs import HANG, Found, mutated

from pyehl.cli import status_of
from pyehl.destination import Destination, write_json
from pyehl.types import Row

COLUMNS = columns("campaign:s trials:d wrong:d outcomes:s")
CASE = """&contact moes_m = 100.0 moes_l = 6.0 /
&grid points = 65 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /
&surface kind = 'harmonic' amplitude_over_film = 0.2 wavelength = 1.0 /
&output checkpoint_interval = 0.01 frame_interval = 0.5 /
"""
# Entries that differ between runs
TIMES = ("wall_seconds", "seconds_per_step", "seconds", "bytes")
REGIONS = 32
"""Number of regions of a checkpoint; a byte of each is flipped in turn."""


def campaign(folder: Path, *, seed: int = 1, kills: int = 200, inputs: int = 2000) -> list[Row]:
    """Run all campaigns in an empty folder; returns rows of `COLUMNS`, with failures in `bad`.

    `seed` determines instants, bytes and inputs. Of ten killed processes six solve, three run a
    sweep and one exports; `inputs` is the number of mutated case files, study files and height
    maps.
    """
    generator = np.random.default_rng(seed)
    (folder / "case.nml").write_text(CASE, encoding="utf-8")
    rows = []
    for name, share, work in (
        ("killed runs, resumed", 0.6, _kill_runs),
        ("killed sweeps, started again", 0.3, _kill_sweeps),
        ("killed exports", 0.1, _kill_exports),
    ):
        say(f"{name}: {round(share * kills)}")
        rows.append(_row(name, *work(folder, generator, max(1, round(share * kills)))))
    say("bytes of a checkpoint flipped, region by region")
    rows.append(_row("damaged states", *damage(folder, generator)))
    say(f"mutated inputs: {inputs}")
    rows.append(_row("mutated inputs", *mutated(folder, seed, inputs)))
    return rows


def _row(name: str, trials: int, counts: dict[str, int], bad: list[str]) -> Row:
    reported = ", ".join(f"{count} {what}" for what, count in sorted(counts.items()))
    return {"campaign": name, "trials": trials, "wrong": len(bad), "outcomes": reported, "bad": bad}


def command(*words: str) -> list[str]:
    """Return the command line of ``pyehl``."""
    return [sys.executable, "-P", "-m", "pyehl", *words]


def run(
    folder: Path,
    *words: str,
    **how: Any,  # noqa: ANN401
) -> subprocess.CompletedProcess[str]:
    """Run ``pyehl`` to its end in a folder."""
    return subprocess.run(
        command(*words),
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        **{"timeout": HANG, **how},
    )


def _killed(folder: Path, words: Sequence[str], after: float) -> bool:
    """Start a command and kill it after some seconds; returns whether it was still running."""
    process = subprocess.Popen(
        command(*words), cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        process.wait(after)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
        process.wait()
        return True
    return False


def _values(path: Path) -> dict[str, Any]:
    values = json.loads(path.read_text(encoding="utf-8"))
    return {name: value for name, value in values.items() if name not in TIMES}


def same(one: Path, two: Path) -> str:
    """Compare file names, summaries without `TIMES` and arrays of two result folders.

    Returns what differs; '' if nothing does.
    """
    names = sorted(p.name for p in one.iterdir())
    if names != sorted(p.name for p in two.iterdir()):
        return f"files {names} and {sorted(p.name for p in two.iterdir())}"
    for name in names:
        if name == "summary.json":
            if _values(one / name) != _values(two / name):
                return name
        elif name.endswith(".npy") and (one / name).read_bytes() != (two / name).read_bytes():
            return name
    return ""


def _kill_runs(folder: Path, generator: np.random.Generator, kills: int) -> Found:
    whole, out, bad = folder / "whole", folder / "out", []
    began = time.monotonic()
    run(folder, "run", "case.nml", "-o", "whole")
    takes = time.monotonic() - began
    done = finished = 0
    while done < kills:
        if _killed(folder, _go_on(out), float(generator.uniform(0.0, 1.1 * takes))):
            done += 1
            if out.exists() and not (out / "summary.json").is_file():
                bad.append(f"kill {done}: half a folder {sorted(p.name for p in out.iterdir())}")
        else:
            finished += 1
            _compare(out, whole, f"after kill {done}", bad)
            shutil.rmtree(out, ignore_errors=True)
    last = run(folder, *_go_on(out))
    if last.returncode:
        bad.append(f"the last run: {last.stderr}")
    _compare(out, whole, "in the end", bad)
    return done, {"killed": done, "completed": finished + 1}, bad


def _go_on(out: Path) -> list[str]:
    """Arguments that start a run, or resume it if it has left a checkpoint."""
    resumed = out.with_name(f"{out.name}.checkpoint").exists()
    return ["run", "--resume", out.name] if resumed else ["run", "case.nml", "-o", out.name]


def _compare(out: Path, whole: Path, when: str, bad: list[str]) -> None:
    difference = same(whole, out) if out.exists() else "no folder"
    if difference:
        bad.append(f"{when}: {difference}")


def _kill_sweeps(folder: Path, generator: np.random.Generator, kills: int) -> Found:
    bad: list[str] = []
    words = ["sweep", "case.nml", "--vary", "contact.moes_m=60:140:9", "--set"]
    words += ["time.estimate_error=.false.", "--jobs", "2", "--quiet", "-o"]
    began = time.monotonic()
    run(folder, *words, "whole-sweep")
    takes = time.monotonic() - began
    wanted = _table(folder / "whole-sweep")
    out = folder / "sweep"
    done = finished = 0
    while done < kills:
        if _killed(folder, [*words, "sweep"], float(generator.uniform(0.3, 1.0)) * takes):
            done += 1
            continue
        finished += 1
        if _table(out) != wanted:
            bad.append(f"after kill {done}: another table")
        shutil.rmtree(out)
    last = run(folder, *words, "sweep")
    if last.returncode or _table(out) != wanted:
        bad.append(f"in the end: another table, exit status {last.returncode}: {last.stderr}")
    return done, {"killed": done, "completed": finished + 1}, bad


def _table(folder: Path) -> list[dict[str, str]]:
    with (folder / "results.csv").open(encoding="utf-8", newline="") as file:
        return [
            {name: cell for name, cell in row.items() if name not in TIMES}
            for row in csv.DictReader(file)
        ]


def _kill_exports(folder: Path, generator: np.random.Generator, kills: int) -> Found:
    bad: list[str] = []
    began = time.monotonic()
    first = run(folder, "export", "whole", "-o", "whole.nc")
    takes = time.monotonic() - began
    wanted = (folder / "whole.nc").read_bytes() if first.returncode == 0 else b""
    if not wanted:
        bad.append(f"cannot export: {first.stderr}")
    out = folder / "killed.nc"
    done = 0
    while done < kills:
        done += _killed(
            folder, ["export", "whole", "-o", out.name], float(generator.uniform(0.5, 1.1)) * takes
        )
        if out.exists():
            if out.read_bytes() != wanted:
                bad.append(f"kill {done}: half a file")
            out.unlink()
    return done, {"killed": done}, bad


def damage(folder: Path, generator: np.random.Generator) -> Found:
    """Flip a byte in every region of the newest checkpoint, or of both, and resume.

    A damaged checkpoint must be detected: the run resumes from the older one, or starts again, and
    gives the bits of an uninterrupted run.
    """
    counts: Counter[str] = Counter()
    bad: list[str] = []
    # a run that is not converged leaves its checkpoints
    run(folder, "run", "case.nml", "-o", "state", "--set", "time.steps=60")
    kept = folder / "state.checkpoint"
    if not kept.is_dir():
        return 0, {}, ["a run that ended early has left no checkpoint"]
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
                counts["reported"] += 1
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


def work(args: argparse.Namespace) -> int:
    """Run the campaign and print; returns the exit status."""
    Destination(args.output, "bench faults").check()
    args.output.mkdir(parents=True, exist_ok=True)
    rows = campaign(args.output.resolve(), seed=args.seed, kills=args.kills, inputs=args.inputs)
    show(rows, COLUMNS)
    answer = header(work) | {"seed": args.seed, "rows": rows}
    write_json(args.output / "faults.json", answer, allow_nan=True)
    for row in rows:
        for what in row["bad"]:
            say(f"{row['campaign']}: {what}")
    return verdict(rows)


def main(words: Sequence[str] | None = None) -> int:
    """Run the script."""
    made = parser(__doc__)
    add_number(made, "seed", 1)
    add_number(made, "kills", 200)
    add_number(made, "inputs", 2000, "mutated ones")
    made.add_argument(
        "-o", "--output", type=Path, metavar="DIR", required=True, help="an empty folder"
    )
    args = made.parse_args(words)
    return status_of(lambda: work(args))


if __name__ == "__main__":
    sys.exit(main())
