# SPDX-License-Identifier: BSD-3-Clause
"""Instructions per time step, with and without a duty, of two builds of ``ehl``.

    python docs/evidence/duty/cost.py EARLIER_EHL EHL

rewrites cost.csv. A harmonic surface in pure rolling, on 65 nodes; the duty is constant. callgrind
counts the steps 65 to 128, four periods of the wave; without a duty time.scheme = 'paper'.
"""

import csv
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).resolve().parent
CASE = """&contact load = 60.0 mean_velocity = 1.0 radius = 0.01 reduced_modulus = 2.2e11
slide_to_roll = 0.0 /
&lubricant viscosity = 0.05 pressure_viscosity = 2e-8 /
&surface kind = 'harmonic' amplitude = 0.016 wavelength = 1.0 /
&grid points = 65 border = 'zero' /
&solver threads = 1 /
&output checkpoint_interval = 0.0 fields = .false. /
"""
WITHOUT = "&time scheme = '{scheme}' steps = {steps} estimate_error = .false. /\n"
DUTY = "&duty time = 0.0, {end!r} mean_velocity = 1.0, 1.0 /\n"
MESH = 0.0625
ENDS = 64, 128
"""Steps, 16 to a period of the wave."""
Counts = tuple[int, int]


def count(program: str, case: str) -> tuple[Counts, dict[str, str]]:
    """Instructions and cycles of a run, and the last row of its history."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder)
        (path / "case.nml").write_text(case, encoding="utf-8")
        counter = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={path}/counts"]
        run = [program, str(path / "case.nml"), "-o", str(path / "out"), "--quiet"]
        # without an error of its mean friction the run ends as not converged
        subprocess.run([*counter, *run], check=False, capture_output=True)
        line = [
            line
            for line in (path / "counts").read_text(encoding="utf-8").splitlines()
            if line.startswith(("summary:", "totals:"))
        ][-1]
        with (path / "out/history.csv").open(newline="", encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
    return (int(line.split()[1]), sum(int(float(row["cycles"])) for row in rows)), rows[-1]


def rows_of(earlier: str, now: str) -> Iterator[dict[str, object]]:
    """Measure each build, without a duty and with one."""
    for name, program, scheme in (
        ("earlier build", earlier, "paper"),
        ("no duty", now, "paper"),
        ("constant duty", now, ""),
    ):
        if scheme:
            cases = [WITHOUT.format(scheme=scheme, steps=steps) for steps in ENDS]
        else:
            # the time of a step, from a short run
            _, last = count(program, CASE + DUTY.format(end=1e-5))
            step = MESH * float(last["t_s"]) / float(last["T"])
            cases = [DUTY.format(end=step * steps) for steps in ENDS]
        ((first, before), _), ((last_one, cycles), row) = (count(program, CASE + c) for c in cases)
        if int(row["step"]) != ENDS[1]:
            raise RuntimeError(f"{name}: {row['step']} steps")
        steps = ENDS[1] - ENDS[0]
        yield {
            "run": name,
            "steps": steps,
            "cycles": cycles - before,
            "million_per_step": f"{(last_one - first) / steps / 1e6:.4g}",
        }


def main(words: list[str]) -> None:
    """Write the table."""
    earlier, now = words
    rows = list(rows_of(earlier, now))
    with (HERE / "cost.csv").open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main(sys.argv[1:])
