# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions, one class per status code of the Fortran library; exit statuses."""

import difflib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

EXIT_OK, EXIT_FAILED, EXIT_USAGE, EXIT_INTERRUPTED = 0, 1, 2, 130
"""Exit statuses of commands: done, not converged or failed, bad input, interrupted (as ``ehl``)."""


class EhlError(Exception):
    """Any failure that the library reports.

    Examples
    --------
    >>> import pyehl
    >>> try:
    ...     pyehl.solve("cases/quick.nml", "grid.points=66")
    ... except pyehl.EhlError as error:
    ...     print(type(error).__name__)
    InputError
    """


class InputError(EhlError, ValueError):
    """A case or an argument is not acceptable; the message states where and why.

    Examples
    --------
    >>> import pyehl
    >>> try:
    ...     pyehl.Case("cases/quick.nml", "contact.laod=600.0")
    ... except pyehl.InputError as error:
    ...     print("load" in str(error))
    True
    """


class ClosedError(EhlError, ValueError):
    """The solver is closed."""


class NoMemoryError(EhlError, MemoryError):
    """An allocation failed or would fail, or too many solvers are open."""

    def __reduce__(self) -> tuple[Any, ...]:
        # dask rebuilds exceptions with their own __init__, as MemoryError, without arguments
        return type(self), self.args, self.__dict__


class NotConverged(EhlError, RuntimeError):  # noqa: N818 (the name of a status)
    """The run ended with another status than 'converged'.

    Attributes
    ----------
    results
        The state at the end, as an xarray Dataset.

    Examples
    --------
    >>> import pyehl
    >>> try:
    ...     pyehl.solve("cases/quick.nml", "grid.points=65", "solver.max_cycles=1")
    ... except pyehl.NotConverged as error:
    ...     print(error.results.attrs["status"])
    cycle limit
    """

    def __init__(self, message: str, results: Any) -> None:  # noqa: ANN401 (no import of xarray)
        super().__init__(message)
        self.results = results

    def __reduce__(self) -> tuple[Any, ...]:
        """Copy and pickle both arguments, not the message alone."""
        return type(self), (str(self), self.results), self.__dict__


class FileError(EhlError, OSError):
    """A file could not be read or written.

    Examples
    --------
    >>> import pyehl
    >>> issubclass(pyehl.FileError, OSError)
    True
    """


class ExtensionError(EhlError, ImportError):
    """The compiled extension cannot be imported."""


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
    """Raise the error of a status: the class of EhlError that belongs to it, unless it is 0."""
    if status != 0:
        raise CLASSES.get(status, InternalError)(message.decode(errors="replace").rstrip())


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Give the nearest known word as the end of a message about an unknown one; '' if none is near.

    Examples
    --------
    >>> from pyehl.errors import did_you_mean
    >>> did_you_mean("prdict", ("solve", "predict", "film"))
    "; did you mean 'predict'?"
    """
    near = difflib.get_close_matches(word, list(known), n=1)
    return f"; did you mean '{near[0]}'?" if near else ""


@contextmanager
def named(name: str) -> Iterator[None]:
    """Put the name of the case file, if it is not '', before the message of an InputError."""
    try:
        yield
    except InputError as error:
        if not name:
            raise
        raise InputError(f"{name}: {error}") from error
