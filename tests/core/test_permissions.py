# SPDX-License-Identifier: BSD-3-Clause
"""Folders that may not be written: refused at once, by name."""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from test_ownership import FOLDERS, ROUGH, SCRIPTS, SMOOTH, refused, tree

import pyehl


def without_rights() -> list[str]:
    """Words before a command that remove the rights of the superuser."""
    if os.geteuid() != 0:
        return []
    if shutil.which("setpriv") is None:
        pytest.skip("the superuser may write everywhere")
    return ["setpriv", "--bounding-set", "-dac_override,-dac_read_search"]


def command_of(words: list[str]) -> list[str]:
    """The command in a separate process."""
    if words[0] in SCRIPTS:
        return [sys.executable, str(SCRIPTS[words[0]].__file__), *words[1:]]
    return [sys.executable, "-P", "-m", "pyehl", *words]


# only `Destination` creates the folders above
@pytest.mark.parametrize(
    ("name", "deep"),
    [
        *(pytest.param(name, False, marks=pytest.mark.long) for name in FOLDERS if name != "run"),
        *(("run", False), ("ehl", True), ("sweep", True)),
    ],
)
def test_no_permission(ehl: str, tmp_path: Path, name: str, deep: bool):
    text, words = FOLDERS[name]
    (tmp_path / "case.nml").write_text(text)
    (tmp_path / "locked").mkdir()
    (tmp_path / "locked").chmod(0o555)
    command = [ehl, *words] if name == "ehl" else command_of(words)
    place = "locked/deep/out" if deep else "locked"
    began = time.monotonic()
    done = subprocess.run(
        [*without_rights(), *command, "-o", place],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    refused(done, place, "no permission to write into")
    assert "level" not in done.stdout
    assert time.monotonic() - began < 60.0
    assert set(tree(tmp_path)) == {"case.nml", "locked"}


@pytest.mark.parametrize("name", ["plot", "export", "surface", "smooth"])
def test_no_permission_for_files(tmp_path: Path, name: str):
    (tmp_path / "case.nml").write_text(ROUGH)
    pyehl.solve(pyehl.Case.from_text(SMOOTH), output=tmp_path / "out")
    (tmp_path / "locked").mkdir()
    (tmp_path / "locked").chmod(0o555)
    words = {
        "plot": ["plot", "out", "-o", "locked"],
        "export": ["export", "out", "-o", "locked/a.nc"],
        "surface": ["surface", "case.nml", "-o", "locked/a.npy"],
        "smooth": ["smooth", "--points", "17", "-o", "locked/a.json"],
    }[name]
    done = subprocess.run(
        [*without_rights(), *command_of(words)],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    refused(done, "locked", "no permission to write")
    assert done.stdout == ""
    assert not list((tmp_path / "locked").iterdir())
