# SPDX-License-Identifier: BSD-3-Clause
"""The journal of a study: one line for each finished case, safe against a kill at any instant.

A line is the CRC-32 of its text in eight hexadecimal digits, a blank, and JSON. The first line is
the study. Lines are only ever added, by the process that holds the lock of the file, and are on the
disk when `Journal.append` returns. What a kill leaves of the last line is cut off; of the first
line it is written again.
"""

import fcntl
import json
import os
import zlib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO, Self

from pyehl.destination import Destination
from pyehl.errors import FileError, InputError
from pyehl.types import Row

NAME = "journal.jsonl"
# Differences of two studies that a message has
MOST_TOLD = 12
VERSION = 1


def _line(value: Mapping[str, Any]) -> bytes:
    text = json.dumps(value, allow_nan=False, separators=(",", ":")).encode()
    return b"%08x %s\n" % (zlib.crc32(text), text)


def _read(line: bytes) -> Row | None:
    """Give what a line says, or None for a damaged one."""
    mark, _, text = line.partition(b" ")
    try:
        if int(mark, 16) != zlib.crc32(text):
            return None
        value = json.loads(text)
    except ValueError:
        return None
    return value if isinstance(value, dict) else None


def read_header(folder: str | os.PathLike[str]) -> Row | None:
    """Give what the study in a folder is; None where there is no journal that can be read."""
    try:
        with (Path(folder) / NAME).open("rb") as stream:
            return _read(stream.readline().rstrip(b"\n"))
    except OSError:
        return None


def difference(old: Mapping[str, Any], new: Mapping[str, Any]) -> list[str]:
    """Say in words where two studies differ; empty when they do not."""
    lines = []
    for name in dict.fromkeys([*old, *new]):
        a, b = old.get(name), new.get(name)
        if a == b:
            continue
        if name == "case":
            lines += difference(_keys(str(a)), _keys(str(b)))
        elif isinstance(a, dict) and isinstance(b, dict):
            lines += [f"{name}.{text}" for text in difference(a, b)]
        else:
            lines.append(f"{name}: there {_short(a)}, here {_short(b)}")
    return lines


def _keys(text: str) -> dict[str, str]:
    """Give values of a resolved case by ``group.key``, as text, and whether they are defaults.

    Where its files lie is left out.
    """
    found, group = {}, ""
    for line in text.splitlines():
        key, equals, value = line.partition(" = ")
        if line.startswith("&"):
            group = line[1:].strip()
        elif equals and key.strip() not in ("file", "table"):
            word, *_, last = value.split(" ! ")
            mark = f" ({last})" if last in ("default", "derived") else ""
            found[f"{group}.{key.strip()}"] = word.strip() + mark
    return found


def _short(value: object) -> str:
    if value is None:
        return "nothing"
    text = str(value)
    return text if len(text) <= 100 else f"{text[:60]} ... {text[-30:]}"


class Journal:
    """The journal of one study in one folder; a context manager that holds a lock on it.

    The folder is made when it is not there. Two studies are the same when their values (of JSON)
    are. `place` has the names that the study may need, by default those of the journal alone.
    `rows` are the finished cases by their number, `damaged` counts lines that could not be read.

    InputError if the folder holds another study (with the difference), or something else, or
    another process works on it; FileError if it cannot be written.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        study: Mapping[str, Any],
        place: Destination | None = None,
    ) -> None:
        self.folder = Path(folder)
        self.place = place or Destination(folder, "sweep", (NAME,))
        self.path = self.folder / NAME
        self.rows: dict[int, Row] = {}
        self.damaged = 0
        header = {"version": VERSION, **json.loads(json.dumps(study))}
        try:
            self._check_folder()
            self._file = self._locked()
            self._load(header)
        except OSError as error:
            if isinstance(error, FileError):
                raise
            raise FileError(f"{self.path}: {error.strerror or error}") from error

    def _check_folder(self) -> None:
        # a journal may appear at any instant: whose it is, is seen when it is locked
        if not self.path.exists():
            replace(self.place, kept=(NAME,)).check(resumes=True)
        self.folder.mkdir(parents=True, exist_ok=True)

    def _locked(self) -> BinaryIO:
        """Open the file, made if it is not there, and lock it before anything is read."""
        while True:
            file = os.fdopen(os.open(self.path, os.O_RDWR | os.O_CREAT, 0o666), "r+b")
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if os.path.samestat(os.fstat(file.fileno()), self.path.stat()):
                    return file
            except FileNotFoundError:
                pass  # removed since it was opened: try again
            except BlockingIOError as error:
                file.close()
                raise InputError(f"{self.folder}: another process works on this study") from error
            file.close()

    def _load(self, header: Mapping[str, Any]) -> None:
        data = self._file.read()
        if b"\n" not in data and _line(header).startswith(data):
            self._begin(header)
            return
        whole = data[: data.rfind(b"\n") + 1]
        lines = whole.splitlines()
        found = _read(lines[0]) if lines else None
        if found is None:
            self.close()
            raise InputError(f"{self.path}: its first line is damaged; it cannot be resumed")
        wrong = difference(found, header)
        if wrong:
            self.close()
            told = wrong[:MOST_TOLD]
            if len(wrong) > MOST_TOLD:
                told.append(f"and {len(wrong) - MOST_TOLD} more")
            told[-1] += "\nexpected: another folder"
            raise InputError(
                "\n  ".join([f"{self.folder}: holds another study. It differs in", *told])
            )
        if len(whole) < len(data):
            self._file.truncate(len(whole))
        self._file.seek(len(whole))
        for line in lines[1:]:
            row = _read(line)
            if row is None or "case" not in row:
                self.damaged += 1
            else:
                self.rows[int(row.pop("case"))] = row

    def _begin(self, header: Mapping[str, Any]) -> None:
        """Write the first line; without room for it there is no file."""
        try:
            self._file.seek(0)
            self._file.write(_line(header))
            self._file.flush()
            os.fsync(self._file.fileno())
            _sync_folder(self.folder)
        except OSError:
            self.path.unlink()
            with suppress(OSError):
                self._file.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def append(self, rows: Sequence[tuple[int, Row]]) -> None:
        """Add finished cases; they are on the disk when this returns.

        FileError if they cannot be written.
        """
        if not rows:
            return
        data = b"".join(_line({"case": number} | row) for number, row in rows)
        try:
            self._file.write(data)
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            raise FileError(f"{self.path}: cannot write: {error.strerror}") from error
        self.rows |= dict(rows)

    def forget(self, numbers: Sequence[int]) -> None:
        """Leave out rows, so that their cases run again; their lines stay in the file."""
        for number in numbers:
            self.rows.pop(number, None)

    def close(self) -> None:
        """Close the file, which gives the lock back.

        FileError if what was added last cannot be written.
        """
        try:
            self._file.close()
        except OSError as error:
            raise FileError(f"{self.path}: cannot write: {error.strerror}") from error


def _sync_folder(folder: Path) -> None:
    number = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(number)
    finally:
        os.close(number)
