# SPDX-License-Identifier: BSD-3-Clause
"""The journal of a study: an SQLite database with a row for each finished case.

SQLite keeps it consistent if the process is killed, and locks it for the process that writes.
"""

import json
import os
import socket
import sqlite3
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any, Self

from pyehl.destination import Destination
from pyehl.errors import FileError, InputError
from pyehl.types import Row

NAME = "journal.sqlite"
FILES = (NAME, f"{NAME}-wal", f"{NAME}-journal")
"""Its files: after a kill, SQLite needs all of them to complete the last transaction."""
MARKS = {"application_id": 0x7965686C, "user_version": 1}
"""Entries of the file header: a journal of pyehl ('yehl' in ASCII), and its version."""
OTHER = "expected: another folder"
# Differences of two studies that a message lists
MAX_LISTED = 12


def read_header(folder: str | os.PathLike[str]) -> Row | None:
    """Give the identity of the study in a folder; None if no journal can be read."""
    result = _unlocked(Path(folder) / NAME, "study")
    return None if result is None else dict(json.loads(result))


def _unlocked(path: Path, name: str) -> str | None:
    """Read an entry that never changes while a process holds the lock; None if there is none."""
    try:
        source = f"{path.resolve().as_uri()}?mode=ro&immutable=1"
        with closing(sqlite3.connect(source, uri=True)) as base:
            result = base.execute("SELECT value FROM study WHERE name = ?", (name,)).fetchone()
    except sqlite3.Error:
        return None
    return None if result is None else str(result[0])


def difference(old: Mapping[str, Any], new: Mapping[str, Any]) -> list[str]:
    """List the differences of two studies as text."""
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

    The paths of its files are omitted.
    """
    result, group = {}, ""
    for line in text.splitlines():
        key, equals, value = line.partition(" = ")
        if line.startswith("&"):
            group = line[1:].strip()
        elif equals and key.strip() not in ("file", "table"):
            word, *_, last = value.split(" ! ")
            mark = f" ({last})" if last in ("default", "derived") else ""
            result[f"{group}.{key.strip()}"] = word.strip() + mark
    return result


def _short(value: object) -> str:
    if value is None:
        return "nothing"
    text = str(value)
    return text if len(text) <= 100 else f"{text[:60]} ... {text[-30:]}"


def _json(value: Mapping[str, Any]) -> str:
    return json.dumps(value, allow_nan=False, separators=(",", ":"))


class Journal:
    """The journal of one study in one folder; a context manager that holds a lock on it.

    A missing folder is made. Two studies are the same if their JSON values are equal. `place` has
    the names of the files of the study, by default those of the journal alone. `rows` are the
    finished cases by their number.

    InputError if the folder holds another study (with the differences) or something else, or if
    another process works on it (with its name); FileError if it cannot be written.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        study: Mapping[str, Any],
        place: Destination | None = None,
    ) -> None:
        self.folder = Path(folder)
        self.path = self.folder / NAME
        self.rows: dict[int, Row] = {}
        # another process may create a journal at any time: its study is checked once it is locked
        if not self.path.exists():
            place = place or Destination(folder, "study", (NAME,))
            replace(place, kept=FILES).check(resumes=True)
        self.folder.mkdir(parents=True, exist_ok=True)
        try:
            self._base = sqlite3.connect(
                self.path, timeout=0.0, isolation_level=None, check_same_thread=False
            )
        except sqlite3.Error as error:
            raise FileError(f"{self.path}: cannot open: {error}") from error
        try:
            self._open(study)
        except BaseException:
            self._base.close()
            raise

    def _open(self, study: Mapping[str, Any]) -> None:
        """Lock the file; make its tables, or read them."""
        run = self._base.execute
        try:
            run("PRAGMA locking_mode = EXCLUSIVE")
            run("BEGIN EXCLUSIVE")
            marks = tuple(run(f"PRAGMA {name}").fetchone()[0] for name in MARKS)
            if not run("SELECT count(*) FROM sqlite_master").fetchone()[0]:
                for name, value in MARKS.items():
                    run(f"PRAGMA {name} = {value}")
                run("CREATE TABLE study (name TEXT PRIMARY KEY, value TEXT)")
                run("CREATE TABLE rows (number INTEGER PRIMARY KEY, row TEXT)")
                run("INSERT INTO study VALUES ('study', ?)", (_json(study),))
            elif marks != tuple(MARKS.values()):
                raise InputError(f"{self.path}: not a journal of this version\n{OTHER}")
            self._compare(run("SELECT value FROM study WHERE name = 'study'").fetchone()[0], study)
            who = f"process {os.getpid()} on {socket.gethostname()}"
            run("INSERT OR REPLACE INTO study VALUES ('holder', ?)", (who,))
            run("COMMIT")
            # one sync for each row; the entries of `study` are now in the main file
            run("PRAGMA journal_mode = WAL")
            run("PRAGMA wal_checkpoint(TRUNCATE)")
            self.rows = self.read()
        except sqlite3.OperationalError as error:
            if error.sqlite_errorcode == sqlite3.SQLITE_BUSY:
                who = _unlocked(self.path, "holder") or "another process"
                raise InputError(f"{self.folder}: {who} is running this study") from error
            raise FileError(f"{self.path}: cannot write: {error}") from error
        except sqlite3.DatabaseError as error:
            raise InputError(
                f"{self.path}: no journal, or a damaged one: {error}\n{OTHER}"
            ) from error

    def _compare(self, result: str, study: Mapping[str, Any]) -> None:
        """Refuse the journal of another study."""
        wrong = difference(json.loads(result), json.loads(_json(study)))
        if wrong:
            listed = wrong[:MAX_LISTED]
            if len(wrong) > MAX_LISTED:
                listed.append(f"and {len(wrong) - MAX_LISTED} more")
            text = "\n  ".join([f"{self.folder}: holds another study. It differs in", *listed])
            raise InputError(f"{text}\n{OTHER}")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def append(self, rows: Sequence[tuple[int, Row]]) -> None:
        """Add finished cases; they are on the disk when this returns.

        FileError if they cannot be written.
        """
        texts = [(number, _json(row)) for number, row in rows]
        try:
            with self._base:
                self._base.execute("BEGIN")
                self._base.executemany("INSERT OR REPLACE INTO rows VALUES (?, ?)", texts)
        except sqlite3.Error as error:
            raise FileError(f"{self.path}: cannot write: {error}") from error
        self.rows |= dict(rows)

    def read(self) -> dict[int, Row]:
        """Read all finished cases from the file."""
        result = self._base.execute("SELECT number, row FROM rows")
        return {number: json.loads(text) for number, text in result}

    def close(self) -> None:
        """Close the file, which releases the lock."""
        self._base.close()
