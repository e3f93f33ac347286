# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of callers, checked at the interface: a wrong type is reported as bad input."""

import math
import os
import reprlib
from collections.abc import Iterable, Iterator, Mapping
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyehl.errors import InputError
from pyehl.types import Array

Option = str | Mapping[str, Any] | Iterable[str | Mapping[str, Any]]
"""``"group.key=value"``, ``{"group.key": value}``, ``{"group": {"key": value}}``, or several."""
Value = float | int | bool | str

EXPECTED = "texts group.key=value or dicts of values by group.key, or by group and key"
TYPED = "--set "
"""Prefix of an option from the command line, so that messages repeat what the user typed."""
# NumPy kinds of numbers that can be heights: floats, and integers with and without a sign
REAL = "fiu"
OTHER_KINDS = {
    "c": "complex numbers",
    "b": "truth values",
    "M": "dates",
    "m": "spans of time",
    "U": "text",
    "S": "text",
    "V": "records",
}


def check_kind(value: object, kinds: type | tuple[type, ...], name: str, expected: str) -> None:
    """Refuse an argument that is not of one of the `kinds`.

    InputError with the value, the expected kind and the actual type.
    """
    if not isinstance(value, kinds):
        raise InputError(
            f"{name} = {reprlib.repr(value)}: expected {expected}, not {type(value).__name__}"
        )


def positive(name: str, value: float, unit: str) -> float:
    """Return the value as a float.

    InputError, with name and unit, if it is no number, or not positive and finite.
    """
    try:
        value = float(value)
    except (TypeError, ValueError):
        check_kind(value, (), name, f"a positive number [{unit}]")
    if not (math.isfinite(value) and value > 0.0):
        raise InputError(f"{name} must be a positive number [{unit}], not {value!r}")
    return value


def path_of(value: Any, name: str) -> str:  # noqa: ANN401
    """Give a path as text; InputError if it is not a path."""
    check_kind(value, (str, bytes, os.PathLike), name, "a path")
    path = os.fsdecode(value)
    if "\0" in path:
        raise InputError(f"{name} = {path!r}: expected a path, without a zero byte")
    return path


def text_file(path: str | os.PathLike[str], expected: str = "") -> str:
    """Give the text of a file that a caller names; InputError if it cannot be read."""
    try:
        return Path(path).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or error
        hint = f"\nexpected: {expected}" if expected else ""
        raise InputError(f"{os.fspath(path)}: cannot read: {why}{hint}") from error


def text_of(value: Any, name: str) -> bytes:  # noqa: ANN401
    """Encode a text for the library.

    InputError if it is not a text, or cannot be encoded.
    """
    check_kind(value, str, name, "a text")
    try:
        # bytes of a terminal that are not UTF-8 are passed on unchanged
        return bytes(value.encode(errors="surrogateescape"))
    except UnicodeEncodeError as error:
        raise InputError(f"{name} = {reprlib.repr(value)}: not a text: {error.reason}") from None


def plain(value: object) -> Value:
    """Convert a value of Python, NumPy or TOML to one of the four types of a case file.

    ValueError if that is impossible.
    """
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, os.PathLike):
        value = os.fsdecode(value)
    if isinstance(value, bool | int | float | str):
        return value
    raise ValueError(f"{value!r} is neither a number nor a word")


def option(key: str, value: Value) -> str:
    """Format ``group.key=value`` for the reader of cases.

    A word is quoted if it is empty, or would lose its own quotes or blanks.
    """
    if isinstance(value, bool):
        return f"{key}={'.true.' if value else '.false.'}"
    if isinstance(value, str) and (value != value.strip() or value[:1] in ("", "'", '"')):
        return f"{key}='{value.replace(chr(39), 2 * chr(39))}'"
    return f"{key}={value!r}" if isinstance(value, float) else f"{key}={value}"


def options_of(options: Any) -> list[str]:  # noqa: ANN401
    """Flatten options, single or in lists or dicts, to a list of texts.

    InputError if one has several lines, or a value is not a number, a truth value or a word.
    """
    if isinstance(options, str):
        if "\n" in options:
            raise InputError(
                f"{reprlib.repr(options)}: more than one line\nexpected: group.key=value"
            )
        return [options]
    if isinstance(options, Mapping):
        return [
            text for key, value in by_key(options) for text in options_of(_option_of(key, value))
        ]
    if isinstance(options, bytes | None) or not isinstance(options, Iterable):
        check_kind(options, (), "options", EXPECTED)
    return [text for option in options for text in options_of(option)]


def by_key(options: Mapping[Any, Any], what: str = "options") -> Iterator[tuple[str, Any]]:
    """Yield ``group.key`` and value of each item of a dict, whose groups may be dicts.

    InputError for a key without a group.
    """
    for name, value in options.items():
        check_kind(name, str, what, EXPECTED)
        if isinstance(value, Mapping):
            for key, inner in value.items():
                check_kind(key, str, name, EXPECTED)
                yield f"{name}.{key}", inner
        elif "." not in name:
            raise InputError(
                f"{name} = {reprlib.repr(value)}: expected values by key, as {{'points': 65}}, or "
                f"a name group.key"
            )
        else:
            yield name, value


def bare(option: str) -> str:
    """Give an option as ``group.key=value``, without the prefix of the command line."""
    return option.removeprefix(TYPED)


def key_of(option: str) -> str:
    """Give the key ``group.key`` that an option sets."""
    return bare(option).partition("=")[0].strip().lower()


def _option_of(key: str, value: Any) -> str:  # noqa: ANN401
    # the only keys that take lists
    if key.startswith("duty.") and isinstance(value, list | tuple | np.ndarray):
        try:
            if isinstance(value, np.ndarray) and value.dtype.kind in "Mm":
                raise TypeError(OTHER_KINDS[value.dtype.kind])
            # what is masked is missing, and the case refuses it
            masked: Any = np.ma.asarray(value, dtype=float)
            numbers = np.ma.filled(masked, np.nan).ravel().tolist()
        except (TypeError, ValueError):
            raise InputError(f"{key} = {reprlib.repr(value)}: expected numbers") from None
        return f"{key}={', '.join(map(repr, numbers))}"
    try:
        return option(key, plain(value))
    except ValueError:
        raise InputError(
            f"{key} = {reprlib.repr(value)}: expected a number, a truth value or a word, not "
            f"{type(value).__name__}"
        ) from None


def real_numbers(values: Any, what: str) -> Any:  # noqa: ANN401
    """Return real numbers as an array; one of objects or a masked one in double precision.

    Masked numbers become NaN. `what` begins the message. InputError for complex numbers, truth
    values, dates and text, which NumPy would convert without an error.
    """
    try:
        array = values if isinstance(values, np.ndarray) else np.asanyarray(values)
        if array.dtype.kind == "O":
            # every member has to be a real number
            other = {type(item).__name__ for item in array.flat if not isinstance(item, Real)}
            if other or any(isinstance(item, bool) for item in array.flat):
                raise TypeError(f"not {', '.join(sorted(other)) or 'bool'}")
            array = array.astype(float)
    except (TypeError, ValueError) as error:
        raise InputError(f"{what}: heights: expected a matrix of numbers [m]: {error}") from None
    if array.dtype.kind not in REAL:
        result = OTHER_KINDS.get(array.dtype.kind, str(array.dtype))
        raise InputError(
            f"{what}: heights must be real numbers, not {result} ({array.dtype})\n"
            "expected: a matrix of numbers [m], missing points as nan or masked"
        )
    # for arrays of NumPy's own type numpy.ma, which takes long to load, is not needed
    if type(array) is not np.ndarray and np.ma.isMA(array):
        return np.ma.filled(array.astype(float), np.nan)
    return array


def heights_of(heights: ArrayLike) -> Array:
    """Give heights [m] (nx, ny) in Fortran order, in double precision.

    InputError if they are not a matrix of finite numbers; masked and nan heights are reported as
    missing points.
    """
    values = np.asfortranarray(real_numbers(heights, "the surface"), dtype=np.float64)
    if values.ndim == 2 and np.isnan(values).any():
        i, j = np.argwhere(np.isnan(values))[0]
        raise InputError(
            f"{int(np.isnan(values).sum())} of {values.size} heights are missing (nan or masked), "
            f"the first at row {i}, column {j}: expected a matrix (nx, ny) of finite numbers [m]"
        )
    if values.ndim != 2 or not np.isfinite(values).all():
        raise InputError(
            f"heights of shape {values.shape}: expected a matrix (nx, ny) of finite numbers [m]"
        )
    return values
