# SPDX-License-Identifier: BSD-3-Clause
"""The choice between builds of the compiled parts. `.ci/wheel` runs both builds of a wheel."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pyehl.errors import InputError
from pyehl.processor import V3_FLAGS, choose, processor_flags


@pytest.mark.parametrize(
    ("wanted", "has_v3", "flags", "suffix"),
    [
        ("", False, V3_FLAGS, ""),
        ("", True, V3_FLAGS, "_v3"),
        ("", True, V3_FLAGS | {"avx512f"}, "_v3"),
        ("", True, V3_FLAGS - {"fma"}, ""),
        ("", True, set(), ""),
        ("baseline", True, V3_FLAGS, ""),
        ("x86-64-v3", True, V3_FLAGS, "_v3"),
    ],
)
def test_choice(wanted: str, has_v3: bool, flags: set[str], suffix: str):
    assert choose(wanted, has_v3, flags) == suffix


@pytest.mark.parametrize(
    ("wanted", "has_v3", "flags", "stated"),
    [
        ("i386", True, V3_FLAGS, "PYEHL_CPU=i386: 'baseline' or 'x86-64-v3'"),
        ("baseline", False, V3_FLAGS, "one build only"),
        ("x86-64-v3", True, V3_FLAGS - {"fma", "bmi2"}, "missing on this processor: bmi2, fma"),
    ],
)
def test_unavailable_builds_are_refused(wanted: str, has_v3: bool, flags: set[str], stated: str):
    with pytest.raises(InputError, match=stated):
        choose(wanted, has_v3, flags)


def test_flags_of_a_processor(tmp_path: Path):
    file = tmp_path / "cpuinfo"
    file.write_text("processor\t: 0\nflags\t\t: fpu avx2 fma\nflags\t: none\n")
    assert processor_flags(file) == {"fpu", "avx2", "fma"}
    file.write_text("Features\t: neon\n")
    assert processor_flags(file) == set()
    assert processor_flags(tmp_path / "nothing") == set()


def test_a_wrong_variable_ends_a_command(root: Path):
    done = subprocess.run(
        [sys.executable, "-m", "pyehl", "check", str(root / "cases/quick.nml")],
        env={**os.environ, "PYEHL_CPU": "v4"},
        capture_output=True,
        text=True,
        cwd=root / "cases",
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("PYEHL_CPU=v4: ")
