# SPDX-License-Identifier: BSD-3-Clause
"""Mutated inputs for `faults.py`: case files, study files and height maps."""

import contextlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import traceback
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from pyehl.case import Case
from pyehl.errors import EhlError

Command = Callable[[Sequence[str]], int]
CHUNK = 250
"""Number of inputs that a child process tries, which may not take longer than HANG seconds."""
HANG = 900.0
CHILD = (
    f"import json, sys; sys.path.insert(0, {str(Path(__file__).parent)!r}); "
    "from pathlib import Path; from pyehl import cli; import faults_inputs; out = sys.stdout; "
    "found = faults_inputs.run_chunk(int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]), "
    "cli.main); out.write(json.dumps(found))"
)
Found = tuple[int, dict[str, int], list[str]]
"""Number of trials, outcomes by kind, and failures."""

CASE = b"""! a small case
&contact
   moes_m = 100.0
   moes_l = 6.0
/
&grid
   points = 33
/
&surface
   kind = 'harmonic'
   amplitude_over_film = 0.2
   wavelength = 1.0
/
&time
   steps = 3
/
&solver
   deflection = 'mlmi'
   max_cycles = 12
/
&output
   frame_interval = 0.25
/
"""
STUDY = b"""case = "case.nml"
run = "film"
outputs = ["H_c"]
[set]
"contact.moes_l" = 8.0
[vary]
"contact.moes_m" = [100.0, 200.0, 300.0]
"""
MAP = b"""&surface
   kind = 'map'
   file = 'map.npy'
   length_x = 4.0e-4
   length_y = 4.0e-4
/
&grid points = 33 /
&time steps = 2 /
"""
WORDS = (
    *(b"nan", b"inf", b"-1", b"0", b"1e308", b"1e-308", b"1e999", b"99999999999999999999", b"''"),
    *(b"'", b'"', b"&", b"/", b"!", b"=", b",", b"\n", b"\0", b"\xff\xfe", b"\xc3\xa9", b"[", b"]"),
    *(b"1e-12", b"4097", b"2147483647", b"'/dev/zero'"),
    *(b".true.", b"3*1.0", b"(1)", b"&grid", b"points", b"../../etc/passwd", b"%s%n", b"{}", b"#"),
)
# Limits of a case that is solved quickly
MAX_POINTS, MAX_STEPS = 65, 50


def mutate(data: bytes, generator: np.random.Generator) -> bytes:
    """Change some bytes: replace, delete or double them, truncate, or insert hostile words."""
    text = bytearray(data)
    for _ in range(int(generator.choice((1, 1, 2, 3)))):
        at = int(generator.integers(0, len(text) + 1))
        length = int(generator.integers(1, 12))
        kind = int(generator.integers(0, 6))
        if kind == 0 and text:
            text[at % len(text)] = int(generator.integers(0, 256))
        elif kind == 1:
            del text[at : at + length]
        elif kind == 2:
            text[at:at] = text[at : at + length]
        elif kind == 3:
            text[at:at] = WORDS[int(generator.integers(0, len(WORDS)))]
        elif kind == 4:
            # replace a value by a hostile word
            values = list(re.finditer(rb"[-+.\w]+", bytes(text)))
            if values:
                result = values[int(generator.integers(0, len(values)))]
                text[result.start() : result.end()] = WORDS[int(generator.integers(0, len(WORDS)))]
        else:
            del text[at:]
    return bytes(text)


def _npy(generator: np.random.Generator) -> bytes:
    file = io.BytesIO()
    kind = ("<f8", "<f4", ">f8", "<i2", "<c16", "|b1", "<U3")[int(generator.integers(0, 7))]
    shape = ((16, 16), (16, 8), (4,), (2, 2, 2), (0, 4), (1, 1))[int(generator.integers(0, 6))]
    heights = 1e-8 * generator.standard_normal(shape)
    if generator.random() < 0.3 and heights.size:
        heights.flat[0] = (np.nan, np.inf, 1e300)[int(generator.integers(0, 3))]
    np.save(file, (heights.astype(kind) if kind != "<U3" else heights.astype("U3")))
    return file.getvalue()


def run_chunk(seed: int, count: int, folder: Path, command: Command) -> dict[str, object]:
    """Try mutated inputs one after another in this process; `command` is that of ``pyehl``.

    Returns
    -------
    dict
        `counts` of 'refused', 'solved', 'not converged', 'accepted', 'bad'; `bad`, a list of the
        failures: tracebacks, other exit statuses, refusals without a place or with a folder,
        incomplete folders.
    """
    generator = np.random.default_rng(seed)
    counts: Counter[str] = Counter()
    bad: list[str] = []
    os.chdir(folder)
    for number in range(count):
        (folder / "case.nml").write_bytes(CASE)
        kind = ("nml", "nml", "toml", "npy")[number % 4]
        name = {"nml": "case.nml", "toml": "study.toml", "npy": "map.npy"}[kind]
        if kind == "npy":
            data = _npy(generator)
            data = data if generator.random() < 0.4 else mutate(data, generator)
            (folder / "case.nml").write_bytes(MAP)
        else:
            data = mutate(CASE if kind == "nml" else STUDY, generator)
        (folder / name).write_bytes(data)
        what = f"seed {seed}, input {number} ({name})"
        try:
            outcome = _one(kind, folder, f"{seed}-{number}", command)
        except BaseException:
            outcome = "bad: " + traceback.format_exc(limit=-3)
        if outcome.startswith("bad"):
            bad.append(f"{what}: {outcome}\n{data[:400]!r}")
        counts[outcome.partition(":")[0]] += 1
    return {"counts": dict(counts), "bad": bad}


def _one(kind: str, folder: Path, label: str, command: Command) -> str:  # noqa: PLR0911
    out = folder / f"out-{label}"
    case, errors = folder / "case.nml", io.StringIO()
    words = ["sweep", "study.toml", "--plan", "-o", str(out)]
    if kind != "toml":
        words = ["check", str(case)]
        if _small(case):
            words = ["run", str(case), "-o", str(out)]
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(errors):
        try:
            status = command(words)
        except SystemExit as end:
            status = int(end.code or 0)
    reported = errors.getvalue()
    if "Traceback" in reported:
        return f"bad: traceback\n{reported}"
    if status == 2:
        place = {"nml": "case.nml", "toml": "study.toml", "npy": "map.npy"}[kind]
        # a readable case that cannot be solved is reported by its keys
        if place not in reported and not re.search(r"\w+\.\w+|&\w+|grid of", reported):
            return f"bad: refused without a place: {reported}"
        return f"bad: folder {out}" if out.exists() else "refused"
    if status not in (0, 1):
        return f"bad: exit status {status}: {reported}"
    if words[0] != "run":
        return "accepted"
    if not (out / "summary.json").is_file():
        left = sorted(p.name for p in out.iterdir()) if out.exists() else []
        return f"bad: exit status {status}, the folder holds {left}: {reported}"
    json.loads((out / "summary.json").read_text(encoding="utf-8"))
    return "solved" if status == 0 else "not converged"


def _small(case: Path) -> bool:
    """Whether a case can be read and is solved quickly."""
    try:
        settings = Case(case).resolve()
    except EhlError:
        return False
    steps = int(settings["time"]["steps"])
    moving = settings["surface"]["kind"] != "smooth"
    target = float(settings["grid"]["target_error"]) > 0.0
    small = int(settings["grid"]["points"]) <= MAX_POINTS and not target
    return small and (not moving or 0 < steps <= MAX_STEPS)


def mutated(folder: Path, seed: int, inputs: int) -> Found:
    """Try mutated inputs in child processes, so that a crash or a hang is detected."""
    counts: Counter[str] = Counter()
    bad: list[str] = []
    for chunk, first in enumerate(range(0, inputs, CHUNK)):
        number = 1000 * seed + chunk
        place = folder / f"inputs-{chunk}"
        place.mkdir()
        words = [str(number), str(min(CHUNK, inputs - first)), str(place)]
        try:
            done = subprocess.run(
                [sys.executable, "-P", "-c", CHILD, *words],
                capture_output=True,
                text=True,
                timeout=HANG,
                check=False,
                env=os.environ | {"OMP_NUM_THREADS": "1"},
            )
        except subprocess.TimeoutExpired:
            bad.append(f"seed {number}: a hang")
            continue
        if done.returncode:
            bad.append(f"seed {number}: exit status {done.returncode}: {done.stderr[-2000:]}")
            continue
        result = json.loads(done.stdout)
        bad += result["bad"]
        counts.update(result["counts"])
        shutil.rmtree(place)
    return inputs, counts, bad
