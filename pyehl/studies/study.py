# SPDX-License-Identifier: BSD-3-Clause
"""A study: a case, its varied keys, and the run of each case."""

import hashlib
import itertools
import math
import os
import tomllib
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import metadata
from itertools import islice
from typing import Any

import numpy as np

from pyehl.case import Case
from pyehl.errors import EhlError, InputError, did_you_mean
from pyehl.given import Value, bare, by_key, check_kind, key_of, option, plain, text_file
from pyehl.schema import QUANTITIES
from pyehl.studies.tasks import TRACKS, checked

FORMS = (
    "start:stop:count, start:stop:countlog (geometric spacing), start:stop (whole numbers), "
    "or values with commas between"
)
MAX_VALUES = 1_000_000
LOGICAL = {".true.": True, ".false.": False}


@dataclass(frozen=True, slots=True)
class Axis:
    """One key ``group.key`` of a case file and its values."""

    key: str  # ``group.key``
    values: tuple[Value, ...]  # all of one type: float, int, bool or str


def parse_axis(text: str) -> Axis:
    """Read ``group.key=VALUES``, the argument of ``--vary``.

    Raises
    ------
    InputError
        If it is not of one of the forms ``start:stop:count``, ``start:stop:countlog``,
        ``start:stop`` or a list with commas.

    Examples
    --------
    >>> from pyehl.studies.study import parse_axis
    >>> parse_axis("contact.mean_velocity=0.01:1:3log").values
    (0.01, 0.1, 1.0)
    >>> parse_axis("surface.seed=1:3").values
    (1, 2, 3)
    """
    key, equals, values = (part.strip() for part in text.partition("="))
    if not equals or not key or not values:
        raise InputError(f"--vary {text}: expected group.key=VALUES, VALUES being {FORMS}")
    return axis(key, values)


def axes_of(vary: Mapping[str, Any]) -> list[Axis]:
    """Make axes from values by ``group.key``, or by group and key; InputError as `axis`."""
    check_kind(vary, Mapping, "vary", "values by key, as {'contact.load': [100.0, 200.0]}")
    return [axis(key, values) for key, values in by_key(vary, "vary")]


def axis(key: str, values: str | Iterable[Any] | Value) -> Axis:
    """Make the axis of a key from a text as in ``--vary``, a sequence or one value.

    InputError if there are no values, or they are not numbers, truth values or words.
    """
    key = key.strip().lower()
    try:
        if isinstance(values, str) and ":" in values:
            result = _spaced(values)
        elif isinstance(values, str):
            result = [_word(word.strip()) for word in values.split(",")]
        elif isinstance(values, Iterable):
            result = [plain(value) for value in islice(values, MAX_VALUES + 1)]
        else:
            result = [plain(values)]
    except ValueError as error:
        raise InputError(f"{key} = {values!r}: {error}; expected {FORMS}") from error
    if not result:
        raise InputError(f"{key}: there are no values; expected {FORMS}")
    if len(result) > MAX_VALUES:
        raise InputError(f"{key}: more than {MAX_VALUES} values, the maximum of a study")
    if len({type(value) for value in result}) > 1:
        if not all(isinstance(v, int | float) and not isinstance(v, bool) for v in result):
            raise InputError(f"{key}: numbers and words together: {result}")
        result = [float(value) for value in result]
    return Axis(key, tuple(result))


def _spaced(text: str) -> list[Value]:
    parts = [part.strip() for part in text.split(":")]
    if len(parts) == 2:
        first, last = int(parts[0]), int(parts[1])
        if last < first:
            raise ValueError("the second number is less than the first")
        _check_count(last - first + 1)
        return list(range(first, last + 1))
    if len(parts) != 3:
        raise ValueError("neither two nor three numbers with ':' between")
    geometric = parts[2].endswith("log")
    count = int(parts[2].removesuffix("log"))
    _check_count(count)
    start, stop = float(parts[0]), float(parts[1])
    if not np.isfinite([start, stop]).all():
        raise ValueError("a number is not finite")
    if geometric and not (start > 0.0 and stop > 0.0):
        raise ValueError("geometric spacing needs two positive numbers")
    # remove rounding errors: 0.1, not 0.10000000000000002
    spaced = [
        float(f"{v:.12g}") for v in (np.geomspace if geometric else np.linspace)(start, stop, count)
    ]
    spaced[0] = start
    if count > 1:
        spaced[-1] = stop
    whole = all(p.lstrip("+-").isdigit() for p in parts[:2]) and all(v == int(v) for v in spaced)
    return [int(v) for v in spaced] if whole else list(spaced)


def _check_count(count: int) -> None:
    if not 1 <= count <= MAX_VALUES:
        raise ValueError(f"{count} values; there can be 1 to {MAX_VALUES}")


def _word(word: str) -> Value:
    """Read a value as in a case file."""
    if not word:
        raise ValueError("a value is missing")
    if word.lower() in LOGICAL:
        return LOGICAL[word.lower()]
    for kind in (int, float):
        try:
            return kind(word)
        except ValueError:
            continue
    if word[0] in "'\"" and word[-1] == word[0] and len(word) > 1:
        word = word[1:-1].replace(2 * word[0], word[0])
    return word


RUNS = ("solve", "predict", "film")
"""Kinds of runs of a case."""
MAX_CASES = 1_000_000
RESULTS = frozenset(quantity.name for quantity in QUANTITIES)
ECHOED = frozenset(
    "contact.moes_m contact.moes_l contact.moes_m_line contact.moes_l_line contact.radius_ratio "
    "contact.slide_to_roll surface.seed surface.velocity_ratio".split()
)
"""Keys whose result of the same name repeats their value."""
# Keys, their types, and descriptions of these
KEYS: dict[str, tuple[Any, str]] = {
    "case": (str, "a text"),
    "run": (str, "a text"),
    "set": (dict, "a table"),
    "vary": (dict, "a table"),
    "zip": (bool | list, "true, false or lists"),
    "outputs": (list, "a list"),
}


@dataclass(frozen=True, slots=True)
class Point:
    """One case of a study."""

    number: int  # row of the table, from 0
    index: tuple[int, ...]  # index along each dimension of the study
    values: dict[str, Value]  # varied values by key

    def __str__(self) -> str:
        """Give the varied values, in one line."""
        return ", ".join(option(key, value) for key, value in self.values.items())


@dataclass(frozen=True, slots=True)
class Study:
    """A case and its varied keys."""

    case: Case | str  # a case, or the path of a case file
    options: tuple[str, ...]  # options of all cases
    # Varied keys: those of one dimension vary together; the last dimension varies fastest in the
    # table
    dimensions: tuple[tuple[Axis, ...], ...]
    run: str  # one of `RUNS`
    outputs: tuple[str, ...] = ()  # results wanted in the table; empty: all numbers and some texts

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values along each dimension."""
        return tuple(len(axes[0].values) for axes in self.dimensions)

    @property
    def size(self) -> int:
        """Number of cases."""
        return math.prod(self.shape)

    @property
    def tracks(self) -> bool:
        """Whether predictions include the tracks of a surface, in nearly three times the time."""
        return self.run == "predict" and not set(TRACKS).isdisjoint(self.outputs)

    @property
    def keys(self) -> list[str]:
        """All keys that are varied."""
        return [a.key for axes in self.dimensions for a in axes]

    @property
    def names(self) -> dict[str, str]:
        """Names of the varied keys in a Dataset.

        The name without its group, unless two keys, or a key and a result that may differ from it,
        would have the same name.
        """
        short = {key: key.partition(".")[2] for key in self.keys}
        twice = Counter(short.values())
        return {
            key: name
            if twice[name] == 1 and (key in ECHOED or name not in RESULTS)
            else key.replace(".", "_")
            for key, name in short.items()
        }

    def point(self, number: int) -> Point:
        """Case of a number in the order of the table."""
        index = tuple(int(k) for k in np.unravel_index(number, self.shape))
        values = {
            a.key: a.values[k] for k, axes in zip(index, self.dimensions, strict=True) for a in axes
        }
        return Point(number, index, values)

    def points(self) -> Iterator[Point]:
        """All cases in the order of the table."""
        return map(self.point, range(self.size))

    def spread(self, count: int) -> list[int]:
        """Numbers of about `count` cases that together cover the values of each dimension.

        The first ones are at the ends of all dimensions. A dimension with more than `count` values
        is sampled with equal spacing.
        """
        ends = itertools.islice(itertools.product(*({0, n - 1} for n in self.shape)), count)
        random = np.random.default_rng(0)
        inner = zip(*(random.permutation(count) * n // count for n in self.shape), strict=True)
        result = (int(np.ravel_multi_index(k, self.shape)) for k in itertools.chain(ends, inner))
        return list(dict.fromkeys(result))

    def resolved(self, point: Point, *more: str) -> Case:
        """Give the case of a point, checked and complete, with `more` options.

        InputError if it is not acceptable; the message names the case.
        """
        texts = [*self.options, *(option(key, value) for key, value in point.values.items())]
        texts += more
        with self.named(point):
            return Case(self.case, texts)

    @contextmanager
    def named(self, point: Point) -> Iterator[None]:
        """Raise an error as InputError, with the case before its message."""
        try:
            yield
        except EhlError as error:
            name = f"case {point.number + 1} of {self.size} ({point})"
            raise InputError(f"{name}:\n{error}") from error

    def identity(self, first: str, files: Collection[str]) -> dict[str, Any]:
        """Give the identity of this study, as values of JSON.

        `first` is the first case, resolved; `files` are the height maps and tables of all cases,
        InputError if one cannot be read.
        """
        result: dict[str, Any] = {
            "pyehl version": metadata.version("pyehl"),
            "run": self.run,
            "case": first,
            "file": contents(files),
            "set": [bare(text) for text in self.options],
            "vary": {a.key: list(a.values) for axes in self.dimensions for a in axes},
            "zip": [[a.key for a in axes] for axes in self.dimensions if len(axes) > 1],
        }
        return result | ({"tracks": True} if self.tracks else {})


def contents(files: Collection[str]) -> dict[str, str]:
    """Give the SHA-256 of files by their paths relative to their common folder.

    InputError if one cannot be read.
    """
    common = os.path.commonpath([os.path.dirname(name) for name in files]) if files else ""
    result = {}
    for name in files:
        try:
            with open(name, "rb") as stream:
                digest = hashlib.file_digest(stream, "sha256").hexdigest()
        except OSError as error:
            raise InputError(f"{name}: cannot read: {error.strerror}") from error
        result[os.path.relpath(name, common)] = f"sha256 {digest}"
    return result


def make(
    case: Case | str | os.PathLike[str],
    axes: Sequence[Axis],
    *,
    options: Iterable[str] = (),
    zipped: bool | Sequence[Sequence[str]] = False,
    run: str = "solve",
    outputs: Sequence[str] = (),
    origin: str = "",
) -> Study:
    """Make a study.

    `zipped`: True, all keys vary together; else lists of the keys that do. `outputs` are the
    results wanted in the table, none: all numbers and some texts. `origin` names the study file in
    messages.
    InputError if nothing is varied, a key is varied twice or also set by an option, keys that vary
    together have different numbers of values, a value (or combination of such keys) is repeated,
    the run or an output does not exist, or there are too many cases.
    """
    if run not in RUNS:
        raise InputError(
            f"run = '{run}': expected one of {', '.join(RUNS)}{did_you_mean(run, RUNS)}"
        )
    if not axes:
        raise InputError("nothing is varied\nexpected: values of at least one group.key")
    names = [a.key for a in axes]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"{name} is varied twice")
    groups = [names] if zipped is True else [[k.strip().lower() for k in g] for g in zipped or ()]
    dimensions = _dimensions(axes, groups)
    for together in dimensions:
        _refuse_repeats(together)
    texts = tuple(str(text) for text in options)
    for text in texts:
        key = key_of(text)
        if key in names:
            raise InputError(f"{key} is varied and set")
    base = case if isinstance(case, Case) else os.fspath(case)
    study = Study(base, texts, dimensions, run, checked(outputs, run, origin))
    if study.size > MAX_CASES:
        raise InputError(f"{study.size} cases; a study can have {MAX_CASES}")
    return study


def _refuse_repeats(together: Sequence[Axis]) -> None:
    """Refuse a dimension of a study with a repeated case."""
    for values, count in Counter(zip(*(a.values for a in together), strict=True)).items():
        if count > 1:
            names = ", ".join(a.key for a in together)
            listed = repr(values[0]) if len(values) == 1 else ", ".join(map(repr, values))
            raise InputError(f"{names}: the value {listed} is given twice")


def _dimensions(
    axes: Sequence[Axis], groups: Sequence[Sequence[str]]
) -> tuple[tuple[Axis, ...], ...]:
    """Put keys that vary together into one dimension, at the place of the first of them."""
    known = {a.key: a for a in axes}
    for key, count in Counter(key for group in groups for key in group).items():
        if key not in known:
            raise InputError(
                f"keys that vary together: '{key}' is not varied{did_you_mean(key, known)}"
            )
        if count > 1:
            raise InputError(f"keys that vary together: '{key}' is given twice")
    for group in groups:
        sizes = {key: len(known[key].values) for key in group}
        if len(set(sizes.values())) > 1:
            listed = ", ".join(f"{key} {size}" for key, size in sizes.items())
            raise InputError(f"keys that vary together need the same number of values: {listed}")
    group_of = {key: tuple(group) for group in groups for key in group}
    dimensions = dict.fromkeys(group_of.get(key, (key,)) for key in known)
    return tuple(tuple(known[key] for key in group) for group in dimensions)


def read_study(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Read a study file (TOML) into the arguments of :func:`pyehl.studies.study.make`.

    Its keys are ``case`` (a path relative to the file), ``run``, ``zip`` (true, or lists of keys),
    ``outputs`` (a list of names), and the tables ``set`` and ``vary`` of ``group.key``.
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
        axes = axes_of(values.get("vary", {}))
        fixed = [axis(key, [result]) for key, result in by_key(values.get("set", {}))]
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
