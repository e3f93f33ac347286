# SPDX-License-Identifier: BSD-3-Clause
"""Commands import modules that take long to load only where they are needed."""

import shutil
import subprocess
import sys

import pytest

HEAVY = {"matplotlib", "xarray", "pandas", "tqdm", "dask", "SurfaceTopography"}
# `scipy` itself loads fast: its parts are loaded on first use
SCIPY = {"scipy.fft", "scipy.ndimage", "scipy.sparse", "scipy.special", "scipy.linalg"}

INSIDE = """
import ast, sys
from pyehl.cli import main
for words in ast.literal_eval(sys.argv[1]):
    assert main(words) == 0
    print("loaded:", *sys.modules)
"""
PREDICT = ["predict", "table1.nml", "-o", "out", "--set", "psd.smooth=hertz"]
"""No contact is solved."""
# in one process, each command may load more modules than those before it
COMMANDS = [
    (["--version"], HEAVY | SCIPY | {"numpy"}),
    (["check", "quick.nml"], HEAVY | SCIPY),
    (["run", "quick.nml", "-o", "run"], HEAVY | SCIPY),
    ([*PREDICT, "--no-plots"], HEAVY | SCIPY),
    (PREDICT, (HEAVY | SCIPY | {"matplotlib.pyplot"}) - {"matplotlib"}),
]


@pytest.mark.parametrize(
    "commands", [COMMANDS, [(["film", "table1.nml"], HEAVY)]], ids=["in turn", "film"]
)
def test_commands_import_no_heavy_modules(cases, tmp_path, commands):
    for name in ("quick.nml", "table1.nml"):
        shutil.copy(cases / name, tmp_path)
    done = subprocess.run(
        [sys.executable, "-P", "-c", INSIDE, repr([words for words, _ in commands])],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    loaded = [line for line in done.stdout.splitlines() if line.startswith("loaded:")]
    for (words, absent), line in zip(commands, loaded, strict=True):
        assert "pyehl.cli" in line.split()
        assert not set(line.split()) & absent, words
