# SPDX-License-Identifier: BSD-3-Clause
"""Command lines, options and case files that both drivers refuse, or accept with an option."""

import os
from pathlib import Path

import pytest


@pytest.mark.parametrize("driver", ["ehl", "pyehl"])
@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["missing.nml", "-o", "out"], "missing.nml"),
        ([".", "-o", "out"], "folder"),
        (["case.nml"], "-o"),
        (["-o", "out"], "CASE.nml"),
        (["case.nml", "-o", "out", "--what"], "--what"),
        (["case.nml", "-o", "full"], "full"),
        (["case.nml", "-o", "file"], "file"),
        (["case.nml", "-o", "file/out"], "file/out"),
        (["case.nml", "-o", "/"], "/"),
    ],
)
def test_bad_command_line(drive, tmp_path: Path, driver, words, part):
    (tmp_path / "case.nml").write_text("&grid points = 33 /\n")
    (tmp_path / "file").write_text("not a folder\n")
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.tex").write_text("precious\n")
    done = drive(driver, *words)
    assert done.returncode == 2
    assert part in done.stderr
    assert "Traceback" not in done.stderr
    assert sorted(p.name for p in tmp_path.rglob("*")) == ["case.nml", "file", "full", "thesis.tex"]


def test_option_replaces_a_value_that_is_not_acceptable(drive, tmp_path: Path):
    text = "&contact moes_m = -3 moes_l = 'x' /\n&grid points = 66 /\n&surface kind = 'smoth' /\n"
    (tmp_path / "case.nml").write_text(text)
    values = ("contact.moes_m=200", "contact.moes_l=10", "grid.points=65", "surface.kind=smooth")
    options = [word for value in values for word in ("--set", value)]
    for driver in ("ehl", "pyehl"):
        assert drive(driver, "case.nml", "-o", driver, *options).returncode == 0
    for driver, where in (("ehl", "1"), ("pyehl", "1:19")):
        fault = drive(driver, "case.nml", "-o", "out", *options[2:])
        assert fault.returncode == 2
        assert fault.stderr.startswith(f"case.nml:{where}: error: contact.moes_m = -3")


@pytest.mark.parametrize("driver", ["ehl", "pyehl"])
@pytest.mark.parametrize("kind", ["/dev/zero", "/dev/random", "pipe", "large"])
def test_no_case_file(drive, tmp_path: Path, driver, kind):
    """Reported at once, without waiting for a pipe or reading an endless device."""
    os.mkfifo(tmp_path / "pipe")
    with (tmp_path / "large").open("wb") as stream:
        stream.truncate(2_000_000)
    done = drive(driver, kind, "-o", "out")
    assert done.returncode == 2
    assert done.stderr.startswith(f"{kind}: error: ")
    assert not (tmp_path / "out").exists()
