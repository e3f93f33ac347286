# SPDX-License-Identifier: BSD-3-Clause
"""Study files (TOML): a case, what is set and varied in it, and what each case is for."""

import os
import tomllib
from collections.abc import Mapping
from typing import Any

from pyehl.errors import InputError, did_you_mean
from pyehl.given import option, text_file
from pyehl.studies.vary import axis

# Keys, their types, and these in words
KEYS: dict[str, tuple[Any, str]] = {
    "case": (str, "a text"),
    "run": (str, "a text"),
    "set": (dict, "a table"),
    "vary": (dict, "a table"),
    "zip": (bool | list, "true, false or lists"),
    "outputs": (list, "a list"),
}


def read_study(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read a study file (TOML) into the arguments of :func:`pyehl.studies.study.make`.

    Its keys are ``case`` (a path from the folder of the file), ``run``, ``zip`` (true, or lists of
    keys), ``outputs`` (a list of names), and the tables ``set`` and ``vary`` of ``group.key``.
    InputError with the file, the key and what was expected.
    """
    name = os.fspath(path)
    try:
        values = tomllib.loads(text_file(path))
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{name}: error: {error}") from error
    for key, value in values.items():
        if key not in KEYS:
            raise InputError(
                f"{name}: error: unknown key '{key}'\nexpected: one of the keys "
                f"{', '.join(KEYS)}{did_you_mean(key, KEYS)}"
            )
        kind, words = KEYS[key]
        if not isinstance(value, kind):
            raise InputError(f"{name}: error: {key} = {value!r}\nexpected: {words}")
    if "case" not in values:
        raise InputError(f"{name}: error: there is no 'case'\nexpected: the path of a case file")
    try:
        axes = [axis(key, found) for key, found in _flat(values.get("vary", {})).items()]
        fixed = [axis(key, [found]) for key, found in _flat(values.get("set", {})).items()]
    except InputError as error:
        raise InputError(f"{name}: error: {error}") from error
    return {
        "case": os.path.join(os.path.dirname(name), values["case"]),
        "axes": axes,
        "options": [option(a.key, a.values[0]) for a in fixed],
        "zipped": values.get("zip", False),
        "run": values.get("run", "solve"),
        "outputs": [str(word) for word in values.get("outputs", [])],
        "origin": f"{name}: error: ",
    }


def _flat(table: Mapping[str, Any]) -> dict[str, Any]:
    """Keys ``group.key`` of a table whose groups may be tables themselves."""
    flat: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict):
            flat |= {f"{key}.{inner}": found for inner, found in value.items()}
        else:
            flat[key] = value
    return flat
