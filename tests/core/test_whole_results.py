# SPDX-License-Identifier: BSD-3-Clause
"""A result is complete at every instant: read, written twice or killed during replacement."""

import json
import os
import random
import shutil
import subprocess
import time
from pathlib import Path

import pytest
from test_ownership import FOLDERS, foreign, whole


@pytest.fixture
def words(ehl: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Command that replaces the result in `out`, which also contains files of a user."""
    monkeypatch.chdir(tmp_path)
    text, own = FOLDERS["ehl"]
    Path("case.nml").write_text(text)
    subprocess.run([ehl, *own, "-o", "out"], check=True)
    foreign(tmp_path / "out")
    return [ehl, *own, "-o", "out", "--force"]


def test_whole_at_every_instant(words: list[str], tmp_path: Path):
    """A reader always finds the result and the files of the user while it is replaced."""

    def read(name: str) -> bytes:
        """Read a file; once more if it was just renamed."""
        try:
            return (tmp_path / "out" / name).read_bytes()
        except OSError:
            return (tmp_path / "out" / name).read_bytes()

    reads = 0
    for _ in range(25):
        with subprocess.Popen(words) as process:
            while process.poll() is None:
                assert json.loads(read("summary.json"))["status"] == "converged"
                assert read("notes.txt") == read("sub/a.txt") == b"mine"
                reads += 1
        assert process.returncode == 0
    assert reads > 1000


def test_two_runs_into_one_folder(words: list[str], tmp_path: Path):
    """The second is refused while the first writes; otherwise they follow each other."""
    for _ in range(40):
        pair = [subprocess.Popen(words) for _ in range(2)]
        assert sorted(process.wait() for process in pair) in ([0, 0], [0, 2])
        whole(tmp_path / "out")
        assert (tmp_path / "out" / "notes.txt").read_text() == "mine"
        assert (tmp_path / "out" / "sub" / "a.txt").read_text() == "mine"
    assert {path.name for path in tmp_path.iterdir()} == {"case.nml", "out"}
    assert not (tmp_path / "out" / "sub").is_symlink()


def test_killed_at_any_instant(words: list[str], tmp_path: Path):
    """The folder after a kill is complete, with files of the user; the next run can replace it."""
    began = time.monotonic()
    assert subprocess.run(words, check=False).returncode == 0
    takes = time.monotonic() - began
    chance = random.Random(20190128)
    killed = 0
    for _ in range(60):
        process = subprocess.Popen(words)
        time.sleep(chance.uniform(0.3, 1.1) * takes)
        process.kill()
        killed += process.wait() != 0
        whole(tmp_path / "out")
        assert (tmp_path / "out" / "notes.txt").read_text() == "mine"
        assert (tmp_path / "out" / "sub" / "a.txt").read_text() == "mine"
    assert killed > 5
    assert subprocess.run(words, check=False).returncode == 0


@pytest.mark.skipif(shutil.which("strace") is None, reason="needs strace")
@pytest.mark.parametrize("calls", ["renameat2", "unlink", "rmdir", "symlink"])
def test_killed_between_two_calls(words: list[str], tmp_path: Path, calls: str):
    """At each system call that changes a folder."""
    for number in range(1, 12):
        traced = ["strace", "-f", "-qq", "-o", os.devnull, f"-etrace={calls}"]
        traced += [f"-einject={calls}:signal=KILL:when={number}", *words]
        done = subprocess.run(traced, capture_output=True, check=False)
        if done.returncode == 0:
            break
        whole(tmp_path / "out")
        assert (tmp_path / "out" / "notes.txt").read_text() == "mine"
        assert (tmp_path / "out" / "sub" / "a.txt").read_text() == "mine"
    assert number > 1


@pytest.mark.skipif(shutil.which("strace") is None, reason="needs strace")
def test_file_system_without_exchange(words: list[str], tmp_path: Path):
    old = (tmp_path / "out" / "summary.json").stat().st_ino
    traced = ["strace", "-f", "-qq", "-o", os.devnull, "-einject=renameat2:error=EINVAL"]
    subprocess.run([*traced, *words], check=True)
    assert (tmp_path / "out" / "summary.json").stat().st_ino != old
    assert not (tmp_path / "out" / "notes.txt").is_symlink()
    assert not (tmp_path / "out" / "sub").is_symlink()
    whole(tmp_path / "out")
    assert {path.name for path in tmp_path.iterdir()} == {"case.nml", "out"}
