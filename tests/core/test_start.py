# SPDX-License-Identifier: BSD-3-Clause
"""What a command imports: modules that take long to load only where they are needed."""

import subprocess
import sys

import pytest

HEAVY = {"matplotlib", "xarray", "pandas", "tqdm", "dask", "SurfaceTopography"}
# `scipy` itself is light: it loads its parts on first use
SCIPY = {"scipy.fft", "scipy.ndimage", "scipy.sparse", "scipy.special", "scipy.linalg"}

INSIDE = """
import sys
from pyehl.cli import main
assert main(sys.argv[1:]) == 0
print("loaded:", *sys.modules)
"""


@pytest.mark.parametrize(
    ("words", "absent"),
    [
        (["--version"], HEAVY | SCIPY | {"numpy"}),
        (["run", "quick.nml", "-o", "out"], HEAVY | SCIPY),
        (["check", "quick.nml"], HEAVY | SCIPY),
        (["film", "table1.nml"], HEAVY),
        (["predict", "table1.nml", "--no-plots", "-o", "out"], HEAVY | SCIPY),
        (
            ["predict", "table1.nml", "-o", "out"],
            (HEAVY | SCIPY | {"matplotlib.pyplot"}) - {"matplotlib"},
        ),
    ],
    ids=["version", "run", "check", "film", "predict without pictures", "predict"],
)
def test_heavy_modules_are_left_alone(cases, tmp_path, words, absent):
    given = [str(cases / word) if word.endswith(".nml") else word for word in words]
    if words[0] == "predict":
        # nothing is solved
        given += ["--set", "psd.smooth=hertz"]
    done = subprocess.run(
        [sys.executable, "-P", "-c", INSIDE, *given],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    loaded = set(done.stdout.rpartition("loaded:")[2].split())
    assert "pyehl.cli" in loaded
    assert not loaded & absent
