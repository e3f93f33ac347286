# SPDX-License-Identifier: BSD-3-Clause
"""The journal of a study: what is in it stays in it, whatever happens to process or file."""

import shutil
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from pyehl import Case, FileError, InputError
from pyehl.results import load
from pyehl.studies import journal as journal_module
from pyehl.studies.journal import NAME, Journal, difference

STUDY = {"run": "film", "vary": {"contact.load": [1.0, 2.0]}}


def rows_of(folder: Path) -> dict[int, dict[str, object]]:
    with Journal(folder, STUDY) as journal:
        return dict(journal.rows)


def test_rows_come_back(tmp_path: Path):
    with Journal(tmp_path, STUDY) as journal:
        journal.append([(0, {"x": 0.1 + 0.2}), (2, {"x": None, "status": "failed"})])
        journal.append([(1, {"x": 1e-300, "message": 'two\nlines, "quoted" µ'})])
        told = dict(journal.rows)
    assert rows_of(tmp_path) == told
    assert told[0]["x"] == 0.1 + 0.2


def test_cut_anywhere_it_has_all_rows_before_the_cut(tmp_path: Path):
    """A kill leaves some first part of the bytes that were to be written."""
    whole = tmp_path / "whole"
    with Journal(whole, STUDY) as journal:
        for number in range(4):
            journal.append([(number, {"x": float(number)})])
    data = (whole / NAME).read_bytes()
    first = data.index(b"\n") + 1
    for length in range(first, len(data) + 1):
        cut = tmp_path / "cut"
        cut.mkdir()
        (cut / NAME).write_bytes(data[:length])
        complete = data[:length].count(b"\n") - 1
        assert rows_of(cut) == {n: {"x": float(n)} for n in range(complete)}
        # and it can be resumed
        with Journal(cut, STUDY) as journal:
            journal.append([(9, {"x": 9.0})])
        assert list(rows_of(cut)) == [*range(complete), 9]
        shutil.rmtree(cut)


def test_a_damaged_row_is_left_out(tmp_path: Path):
    with Journal(tmp_path, STUDY) as journal:
        journal.append([(n, {"x": float(n)}) for n in range(3)])
    path = tmp_path / NAME
    data = bytearray(path.read_bytes())
    place = data.index(b'"x":1.0') + 4
    data[place] = ord("7")
    path.write_bytes(data)
    with Journal(tmp_path, STUDY) as journal:
        assert list(journal.rows) == [0, 2]
        assert journal.damaged == 1


def test_a_damaged_first_line_is_refused(tmp_path: Path):
    Journal(tmp_path, STUDY).close()
    path = tmp_path / NAME
    path.write_bytes(b"0" + path.read_bytes()[1:])
    with pytest.raises(InputError, match="first line is damaged"):
        Journal(tmp_path, STUDY)


def test_another_study_is_refused_with_the_difference(tmp_path: Path):
    Journal(tmp_path, STUDY).close()
    other = {"run": "solve", "vary": {"contact.load": [1.0, 2.0], "surface.seed": [1]}}
    with pytest.raises(InputError) as refusal:
        Journal(tmp_path, other)
    text = str(refusal.value)
    assert "run: there film, here solve" in text
    assert "vary.surface.seed: there nothing, here [1]" in text
    assert "contact.load" not in text
    assert rows_of(tmp_path) == {}


def test_differences_that_are_many_are_counted(tmp_path: Path):
    """A study of another command differs in every key."""
    with Journal(tmp_path, {f"key{k}": 1 for k in range(30)}):
        pass
    with pytest.raises(InputError) as caught, Journal(tmp_path, STUDY):
        pass
    lines = str(caught.value).splitlines()
    assert len(lines) < 18
    assert lines[-2].endswith("more")
    assert lines[-1] == "expected: another folder"
    with pytest.raises(InputError, match=r"not a result folder of one case \(of a study"):
        load(tmp_path)


def test_difference_of_the_same_is_nothing():
    assert difference(STUDY, dict(STUDY)) == []


def test_two_processes_do_not_write_one_journal(tmp_path: Path):
    with Journal(tmp_path, STUDY), pytest.raises(InputError, match="another process"):
        Journal(tmp_path, STUDY)


def test_other_folders_are_left_alone(tmp_path: Path):
    (tmp_path / "thesis.txt").write_text("all of it")
    with pytest.raises(InputError, match=r"thesis\.txt"):
        Journal(tmp_path, STUDY)
    assert [p.name for p in tmp_path.iterdir()] == ["thesis.txt"]
    with pytest.raises(InputError, match="not a folder"):
        Journal(tmp_path / "thesis.txt", STUDY)


def test_first_starts_at_once_lose_nothing(tmp_path: Path):
    """What `append` returned from is there, whoever was first; the others are refused."""
    starts = 4
    lost, refused = [], 0
    with ThreadPoolExecutor(starts) as pool:
        for n in range(50):
            folder, barrier = tmp_path / str(n), threading.Barrier(starts)

            def start(number: int, folder: Path = folder, barrier: threading.Barrier = barrier):
                barrier.wait()
                try:
                    with Journal(folder, STUDY) as journal:
                        journal.append([(number, {"x": number})])
                except InputError as error:
                    return str(error)
                return number

            found = list(pool.map(start, range(starts)))
            words = {text for text in found if isinstance(text, str)}
            assert words <= {f"{folder}: another process works on this study"}
            refused += len(words)
            lost += sorted({k for k in found if isinstance(k, int)} - set(rows_of(folder)))
            assert [p.name for p in folder.iterdir()] == [NAME]
    assert lost == []
    assert refused


def test_a_journal_that_was_removed_meanwhile_is_not_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """Between opening and locking: the rows would go to a file that nobody can find."""
    real = journal_module.fcntl.flock
    left = [1, 1]

    def flock(*arguments: object) -> None:
        if left:
            left.pop()
            (tmp_path / NAME).unlink()
        real(*arguments)

    monkeypatch.setattr(journal_module.fcntl, "flock", flock)
    with Journal(tmp_path, STUDY) as journal:
        journal.append([(0, {"x": 1.0})])
    assert rows_of(tmp_path) == {0: {"x": 1.0}}


def test_a_first_line_that_was_cut_is_written_again(tmp_path: Path):
    """It has no rows yet; that of another study is not touched."""
    Journal(tmp_path, STUDY).close()
    path = tmp_path / NAME
    first = path.read_bytes()
    for length in (0, 5, len(first) - 1):
        path.write_bytes(first[:length])
        Journal(tmp_path, STUDY).close()
        assert path.read_bytes() == first
    path.write_bytes(first[:-1])
    with pytest.raises(InputError, match="first line is damaged"):
        Journal(tmp_path, {"run": "solve"})
    assert path.read_bytes() == first[:-1]


def test_without_room_for_its_first_line_there_is_no_journal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    def full(number: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(journal_module.os, "fsync", full)
    with pytest.raises(FileError, match="No space left"):
        Journal(tmp_path / "new", STUDY)
    assert list((tmp_path / "new").iterdir()) == []


def test_cases_differ_by_their_keys():
    old = Case.from_text("", ["grid.points=65", "contact.load=600.0"]).text
    new = Case.from_text("", ["grid.points=129"]).text
    assert difference({"case": old}, {"case": new}) == [
        # a default follows other values, one that was given does not
        "contact.load: there 600.0, here 600.0 (default)",
        "grid.points: there 65, here 129",
        "grid.points_y: there 65 (derived), here 129 (derived)",
    ]
