# SPDX-License-Identifier: BSD-3-Clause
"""Destinations of results: what a command may replace, and how it replaces it.

A command may write into a folder that is empty, or that holds an earlier result of the same kind
and nothing else. The compiled library, as in ``ehl``, checks this and replaces the folder in one
step. A command may write a single file that is new, or that the same command wrote, as its metadata
state; never a file that the command reads. Symbolic links are followed and stay.
"""

import errno
import itertools
import json
import math
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from pyehl.errors import FileError, InputError, check
from pyehl.extension import functions

AnyPath = str | os.PathLike[str]

# Numbers of temporary files: several threads may write the same target
_NUMBERS = itertools.count(1)
# Bytes at both ends of a file that are searched for the mark of the command
NEAR = 64 * 1024


def mark(command: str) -> str:
    """Give the mark in the metadata of a file that a command made."""
    return f"pyehl {command}: replaced when made again"


def _lines(items: Iterable[AnyPath]) -> bytes:
    return b"".join(os.fsencode(item) + b"\n" for item in items)


@contextmanager
def file_errors(path: AnyPath, what: str = "cannot be written") -> Iterator[None]:
    """Raise an OSError as a FileError, with the path before the message of the system."""
    try:
        yield
    except FileError:
        raise
    except OSError as error:
        raise FileError(f"{os.fspath(path)}: {what}: {error.strerror or error}") from error


def _fresh(name: str) -> str:
    # the suffix stays at the end: it may determine the format
    return f".partial-{os.getpid()}-{next(_NUMBERS)}-{name}"


def check_name(path: AnyPath) -> None:
    """Refuse a name that is too long, or whose longer temporary name is."""
    folder, name = os.path.split(os.path.abspath(path))
    try:
        os.lstat(os.path.join(folder, _fresh(name)))
    except OSError as error:
        if error.errno == errno.ENAMETOOLONG:
            raise InputError(
                f"{os.fspath(path)}: error: the name is too long\nexpected: a shorter name"
            ) from error


@dataclass(frozen=True, slots=True)
class Destination:
    """A folder for a result."""

    folder: AnyPath
    # 'solution', 'prediction', ...: the ``kind`` of its summary, which also lists its ``files``
    kind: str
    names: tuple[str, ...] = ()  # names of the files of the result
    inputs: tuple[AnyPath, ...] = ()  # what the command reads
    kept: tuple[str, ...] = ()  # names of other files of this kind, which stay
    force: bool = False  # accept other files in the folder; they stay

    def __post_init__(self) -> None:
        check_name(self.folder)

    def _given(self) -> tuple[bytes, bytes, bytes, bytes, bytes, int]:
        lists = (_lines(self.names), _lines(self.inputs), _lines(self.kept))
        return os.fsencode(self.folder), self.kind.encode(), *lists, int(self.force)

    def check(self, *, resumes: bool = False) -> None:
        """Refuse a folder that must not be replaced, or cannot be written.

        `resumes`: an earlier result is completed, not replaced. InputError with the file in the
        way, and a remedy.
        """
        check(*functions.check_folder(*self._given(), int(resumes)))

    @contextmanager
    def fresh(self) -> Iterator[Path]:
        """Give an empty folder for the files; at the end of the block it replaces the destination.

        InputError as `check`; FileError if the folder cannot be written.
        """
        name, status, message = functions.begin_folder(*self._given())
        check(status, message)
        fresh = Path(os.fsdecode(name.rstrip()))
        try:
            with file_errors(self.folder):
                yield fresh
        except BaseException:
            shutil.rmtree(fresh, ignore_errors=True)
            raise
        check(*functions.finish_folder(*self._given(), os.fsencode(fresh)))

    def claim(self, values: Mapping[str, object]) -> None:
        """Make the folder, or resume in it, with a summary that states its kind from the start.

        InputError as `check`; FileError if the folder cannot be written.
        """
        self.check(resumes=True)
        folder = Path(self.folder)
        summary = {"kind": self.kind, **values, "files": ["summary.json", *self.names]}
        with file_errors(folder, "cannot be made"):
            folder.mkdir(parents=True, exist_ok=True)
        write_json(folder / "summary.json", summary)


def made_by(path: Path, word: str) -> bool:
    """Whether a file contains a word near its beginning or its end."""
    with path.open("rb") as stream:
        size = os.fstat(stream.fileno()).st_size
        head = stream.read(NEAR)
        stream.seek(max(0, size - NEAR))
        return word.encode() in head or word.encode() in stream.read(NEAR)


def check_files(
    paths: Iterable[AnyPath],
    command: str,
    inputs: Iterable[AnyPath] = (),
    *,
    known: Callable[[Path], bool] | None = None,
) -> None:
    """Refuse files that must not be written by a command, such as 'plot', which reads `inputs`.

    `known`: whether the command wrote an existing file; default: the file has its `mark`.
    InputError with the file in the way, and a remedy.
    """
    sources = {os.path.realpath(source) for source in inputs}
    for path in map(Path, paths):
        check_name(path)
        other = "expected: another name"
        folder = Path(os.path.realpath(path)).parent
        if os.path.realpath(path) in sources:
            raise InputError(f"{path}: error: this command reads it\n{other}")
        if path.is_dir():
            raise InputError(f"{path}: error: this is a folder\n{other}")
        if not folder.is_dir():
            raise InputError(f"{path}: error: there is no folder {folder}\n{other}")
        try:
            ours = not path.exists() or (known or partial(made_by, word=mark(command)))(path)
            with tempfile.TemporaryFile(dir=folder):
                pass
        except OSError as error:
            raise InputError(f"{path}: error: no permission to write it\n{other}") from error
        if not ours:
            raise InputError(
                f"{path}: error: there is a file that pyehl {command} did not write\n{other}"
            )


@contextmanager
def new_file(path: AnyPath) -> Iterator[Path]:
    """Give a temporary file beside a file; at the end of the block it replaces the file.

    FileError if it cannot be written; the file is then unchanged.
    """
    place = Path(os.path.realpath(path))
    fresh = place.with_name(_fresh(Path(path).name))
    try:
        with file_errors(path):
            yield fresh
            fresh.replace(place)
    except BaseException:
        fresh.unlink(missing_ok=True)
        raise


def write_json(path: AnyPath, values: Mapping[str, object], *, allow_nan: bool = False) -> None:
    """Write values as JSON, whole or not at all.

    `allow_nan`: NaN and infinity as Python writes them; without it a ValueError. FileError if the
    file cannot be written.
    """
    with new_file(path) as fresh:
        text = json.dumps(values, indent=2, allow_nan=allow_nan)
        fresh.write_text(text + "\n", encoding="utf-8")


def finite(value: object) -> object:
    """Return the value with null for what JSON cannot represent."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, list):
        return [finite(item) for item in value]
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    return value
