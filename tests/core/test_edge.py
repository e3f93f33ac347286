# SPDX-License-Identifier: BSD-3-Clause
"""Devices, pipes, files of terabytes: refused by name, at once, with nothing written."""

import os
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from limited import limited

CASE = (
    "&contact moes_m = 100.0 moes_l = 6.0 /\n"
    "&grid points = 65 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
    "&surface kind = 'harmonic' amplitude_over_film = 0.2 wavelength = 1.0 /\n"
)
ONCE = 60
"""Seconds within which input is refused."""
MAP = """&contact load = 20.0 /
&grid points = 33 /
&surface kind = 'map' file = '{}' length_x = 1e-3 length_y = 1e-3 /
"""
# The input, and words of the message
COMMANDS: tuple[tuple[tuple[str, ...], str], ...] = (
    (("check", "/dev/zero"), "/dev/zero"),
    (("check", "/dev/random"), "/dev/random"),
    (("check", "/dev/null"), "/dev/null"),
    (("check", "pipe"), "pipe"),
    (("check", "."), "folder"),
    (("check", "binary.nml"), "binary.nml"),
    (("check", "long.nml"), "long.nml"),
    (("check", "npy.nml"), "sparse.npy"),
    (("predict", "npy.nml", "-o", "edge-out"), "sparse.npy"),
    (("surface", "npy.nml"), "sparse.npy"),
    (("run", "txt.nml", "-o", "edge-out"), "sparse.txt"),
    (("run", "pipe.nml", "-o", "edge-out"), "surface.file"),
    (("check", "case.nml", "--set", "contact.moes_m=-1"), "contact.moes_m"),
    (("check", "radius.nml"), "contact.radius"),
    (("check", "fast.nml", "--set", "time.steps=10000000"), "output.frame_interval"),
    (("check", "case.nml", "--set", "surface.velocity_ratio=1e-12"), "surface.velocity_ratio"),
    (("check", "case.nml", "--set", "surface.file=\udcff", "--set", "surface.kind=map"), "file"),
    (("predict", "wave.nml", "-o", "edge-out"), "a wave of"),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the inputs of `COMMANDS`; sparse files take no space on the disk."""
    folder = tmp_path_factory.mktemp("edge")
    os.mkfifo(folder / "pipe")
    (folder / "binary.nml").write_bytes(bytes(range(256)))
    (folder / "long.nml").write_text("! a line\n" * 200_000, encoding="utf-8")
    for kind in ("npy", "txt"):
        name = f"sparse.{kind}"
        (folder / f"{kind}.nml").write_text(MAP.format(name), encoding="utf-8")
        with (folder / name).open("wb") as stream:
            if kind == "npy":
                header = {"descr": "<f8", "fortran_order": False, "shape": (400_000, 400_000)}
                np.lib.format.write_array_header_1_0(stream, header)
            else:
                stream.write(b"1 2 3 4\n")
            stream.truncate(stream.tell() + 8 * 400_000**2)
    (folder / "pipe.nml").write_text(MAP.format("pipe"), encoding="utf-8")
    (folder / "radius.nml").write_text("&contact load=10.0 radius=9.525 /\n", encoding="utf-8")
    (folder / "wave.nml").write_text(
        "&surface kind = 'harmonic' wavelength_y = 1e6 /\n", encoding="utf-8"
    )
    (folder / "fast.nml").write_text(CASE + "&output frame_interval = 1e-12 /\n", encoding="utf-8")
    (folder / "case.nml").write_text(CASE, encoding="utf-8")
    return folder


@pytest.mark.parametrize(("words", "part"), COMMANDS, ids=[" ".join(w[:2]) for w, _ in COMMANDS])
def test_refused_at_once(command, folder: Path, words: tuple[str, ...], part: str):
    done = command(folder, *words, seconds=ONCE)
    assert done.returncode in (1, 2)
    assert part in done.stderr
    assert not (folder / "edge-out").exists()


@pytest.mark.parametrize("size", [1_000, 30_000])
def test_full_disk_is_reported_and_leaves_no_folder(folder: Path, size: int):
    """A partial write is no error for gfortran: the length of every file is checked."""
    words = ["run", "case.nml", "-o", "full", "--set", "time.steps=4"]
    done = limited(folder, resource.RLIMIT_FSIZE, size, *words)
    assert done.returncode == 1
    assert "cannot write: the disk is full" in done.stderr
    assert not (folder / "full").exists()


def test_no_more_memory_on_coarser_grids(folder: Path):
    """The memory for a run of 4097 x 4097 nodes is enough for the coarser grids."""
    words = ["run", "case.nml", "-o", "large", "--set", "grid.points=4097"]
    done = limited(folder, resource.RLIMIT_AS, 600 * 2**20, *words)
    assert done.returncode in (1, 2)
    assert done.stderr.strip()
    assert "Traceback" not in done.stderr
    assert not (folder / "large").exists()


@pytest.mark.parametrize("out", ["file/x", "/proc/pyehl"])
def test_folder_in_an_impossible_place(command, folder: Path, out: str):
    (folder / "file").write_text("", encoding="utf-8")
    done = command(folder, "run", "case.nml", "-o", out)
    assert done.returncode == 2
    assert out in done.stderr


def test_folder_taken_away_from_a_run(folder: Path):
    gone = folder / "gone"
    gone.mkdir()
    words = [sys.executable, "-P", "-m", "pyehl", "run", "case.nml", "-o", "gone/out"]
    # a state is written at once
    words += ["--set", "output.checkpoint_interval=0.01"]
    with subprocess.Popen(words, cwd=folder, stderr=subprocess.PIPE, text=True) as process:
        until = time.monotonic() + 60.0
        while process.poll() is None and not any(gone.iterdir()) and time.monotonic() < until:
            time.sleep(0.01)
        # the run writes into it at the same time
        for _ in range(1000):
            shutil.rmtree(gone, ignore_errors=True)
            if not gone.exists():
                break
        reported = process.communicate()[1]
    assert process.returncode in (0, 1, 2)
    assert "Traceback" not in reported
