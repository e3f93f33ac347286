"""Run both builds of an installed wheel and compare them; fails where they disagree.

What may differ: v3 fuses multiplications with additions, and the vector functions of the C library
round differently for it, so that the last bits differ. The numbers of cycles and steps may not.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

WAVE = """&contact load = 20.0 /
&grid points = 129 /
&surface kind = 'harmonic' amplitude_over_film = 0.2 wavelength = 0.8 /
"""
QUANTITIES = ("H_c", "H_min", "P_max", "F", "mu_ratio", "cycles", "total_cycles", "steps")
# Relative. Rounding is 1e-16, and each cycle and step reduces the difference of the previous one
ROUNDING = 1e-11

INSIDE = """
import json, os, sys, time
import numpy as np
import pyehl
from pyehl import library
start = time.process_time()
ds = pyehl.solve(sys.argv[1], check=True)
seconds = time.process_time() - start
np.savez(sys.argv[2], P=ds.P.values, H=ds.H.values)
maps = open("/proc/self/maps").read()
names = ("libfftw", "libgfortran", "libgomp", "libquadmath", "/_core")
libs = sorted({line.split()[-1] for line in maps.splitlines() if any(n in line for n in names)})
numbers = {str(name): float(v) for name, v in ds.data_vars.items() if v.ndim == 0}
print(json.dumps({"numbers": {k: v for k, v in numbers.items() if np.isfinite(v)},
                  "build": library.build(), "libs": libs, "seconds": seconds}))
"""


def solve(build: str, case: str, fields: str) -> dict:
    """Solve a case with one build in a separate process."""
    out = subprocess.run(
        [sys.executable, "-c", INSIDE, case, fields],
        env={**os.environ, "PYEHL_CPU": build},
        check=True,
        capture_output=True,
        text=True,
    )
    return json.loads(out.stdout)


def program(build: str, case: str, folder: str) -> float:
    """Central film of the program ``ehl`` with one build."""
    env = {**os.environ, "PYEHL_CPU": build}
    subprocess.run(["ehl", case, "-o", folder, "-q"], env=env, check=True)
    return json.loads(Path(folder, "summary.json").read_text())["H_c"]


def main() -> None:
    """Compare smooth contact, transient run and prediction."""
    Path("wave.nml").write_text(WAVE)
    for case in ("cases/quick.nml", "wave.nml"):
        runs = {b: solve(b, case, f"{b}.npz") for b in ("baseline", "x86-64-v3")}
        for build, found in runs.items():
            foreign = [lib for lib in found["libs"] if not lib.startswith(sys.prefix)]
            assert found["libs"]
            assert not foreign, f"not from the wheel: {foreign}"
            assert ("-march=x86-64-v3" in found["build"]) == (build == "x86-64-v3"), found["build"]
            h_c = program(build, case, f"out-{build}-{Path(case).stem}")
            assert h_c == found["numbers"]["H_c"], "program and extension differ"
        low, high = runs.values()
        print(
            f"\n{case}: CPU time {low['seconds']:.2f} s baseline, {high['seconds']:.2f} s x86-64-v3"
        )
        for name in QUANTITIES:
            if name not in low["numbers"]:
                continue
            a, b = low["numbers"][name], high["numbers"][name]
            difference = abs(a - b) / max(abs(a), abs(b), 1e-300)
            print(f"  {name:13}{a:<22.16g}{b:<22.16g}relative difference {difference:.1e}")
            assert difference <= ROUNDING, f"{name} differs by more than {ROUNDING}"
        if "seconds_per_step" in low["numbers"]:
            a, b = (found["numbers"]["seconds_per_step"] for found in runs.values())
            print(f"  seconds per step {a:.2e}, {b:.2e}: {a / b:.2f} times faster")
        fields = [np.load(f"{build}.npz") for build in runs]
        for name in ("P", "H"):
            most = np.abs(fields[0][name] - fields[1][name]).max()
            print(f"  {name} maximum nodal difference {most:.1e}")
    for build in ("baseline", "x86-64-v3"):
        env = {**os.environ, "PYEHL_CPU": build}
        subprocess.run(
            ["pyehl", "predict", "cases/table1.nml", "-o", f"psd-{build}"],
            env=env,
            check=True,
            capture_output=True,
            text=True,
        )
        ratio = json.loads(Path(f"psd-{build}", "summary.json").read_text())["mu_ratio"]
        print(f"\npyehl predict cases/table1.nml, {build}: mu_ratio {ratio:.15g}")
    env = {**os.environ, "PYEHL_CPU": "i386"}
    bad = subprocess.run(["ehl", "x"], env=env, check=False, capture_output=True, text=True)
    assert bad.returncode == 2
    assert "PYEHL_CPU=i386" in bad.stderr
    print("\nlibraries of the wheel:", *(Path(lib).name for lib in low["libs"] if "/pyehl" in lib))


if __name__ == "__main__":
    main()
