# SPDX-License-Identifier: BSD-3-Clause
"""One exception class per status code of the Fortran library."""

from __future__ import annotations

__all__ = [
    "ClosedError",
    "EhlError",
    "FileError",
    "InputError",
    "InternalError",
    "NoMemoryError",
    "check",
]


class EhlError(Exception):
    """Any failure that the library reports."""


class InputError(EhlError, ValueError):
    """A case or an argument is not acceptable; the message says where and why."""


class ClosedError(EhlError, ValueError):
    """The solver was closed before."""


class NoMemoryError(EhlError, MemoryError):
    """An allocation failed, or too many solvers are open."""


class FileError(EhlError, OSError):
    """A file could not be read or written."""


class InternalError(EhlError, RuntimeError):
    """A condition that should never occur."""


# The codes of fortran/base/status.f90
CLASSES: dict[int, type[EhlError]] = {
    1: InputError,
    2: ClosedError,
    3: NoMemoryError,
    4: FileError,
    5: InternalError,
}


def check(status: int, message: bytes) -> None:
    """Raise what a status says.

    Raises
    ------
    EhlError
        The class that belongs to `status`, unless that is 0.
    """
    if status != 0:
        raise CLASSES.get(status, InternalError)(message.decode(errors="replace").rstrip())
