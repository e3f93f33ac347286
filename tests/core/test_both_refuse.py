# SPDX-License-Identifier: BSD-3-Clause
"""A case for the solver: ``ehl`` refuses what pyehl refuses, and nothing else."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from test_malformed import FAULTS, MARK

from pyehl import Case
from pyehl.case.case import resolve
from pyehl.case.key import Key, Value, to_text
from pyehl.case.settings import KEYS, MACHINES
from pyehl.errors import EhlError, InputError
from pyehl.handle import SolverHandle
from pyehl.solver import Solver

COMPLETED = "which pyehl derives from it"
"""In the message of a case that ehl refers to pyehl."""
CONTACTS: tuple[dict[str, Value], ...] = (
    {},
    {"contact.shape": "line"},
    {"contact.shape": "line", "contact.load_per_length": 2e5},
    {
        "contact.shape": "roller",
        "contact.length": 0.01,
        "contact.load": 2000.0,
        "contact.radius": 0.005,
    },
    {"contact.moes_m": 200.0, "contact.moes_l": 6.0},
    {"contact.radius_x": 0.01, "contact.radius_y": 0.03},
    {"surface.kind": "harmonic", "surface.wavelength": 0.5},
    {"surface.kind": "dent", "surface.amplitude": 0.05, "second_surface.kind": "bump"},
    {"lubricant.kinematic_viscosity_40": 68.0, "lubricant.kinematic_viscosity_100": 8.7},
    {"lubricant.name": "n100"},
    {"bodies.radius_x1": 0.02, "bodies.radius_y1": 0.03},
    {"inlet.position_hertz": 1.5, "contact.moes_m": 200.0, "contact.moes_l": 6.0},
)
DRAWN: dict[str, list[Key]] = {}
for each in KEYS.values():
    numeric = each.kind in ("real", "whole", "word", "truth") and each.key != "name"
    if numeric and each.for_input and each.group not in (*MACHINES, "output"):
        DRAWN.setdefault(each.group, []).append(each)


def value_of(key: Key, rng: np.random.Generator) -> Value:
    """Draw a value near the default, at an end of the range, or beyond it."""
    if key.kind == "truth":
        return bool(rng.random() < 0.5)
    if key.kind == "word":
        return str(rng.choice(key.choices))
    low, high, *_ = key.interval
    usual = float(key.default_value) or 1.0  # type: ignore[arg-type]
    near, far = (usual * math.exp(rng.uniform(-width, width)) for width in (1.5, 8.0))
    ends = (low if math.isfinite(low) else 0.0, high if math.isfinite(high) else 10.0 * usual)
    drawn = rng.choice([*ends, ends[0] - 1.0, near, far], p=[0.15, 0.05, 0.07, 0.63, 0.1])
    return round(drawn) if key.kind == "whole" else float(f"{drawn:.4g}")


def cases(seed: int, count: int) -> Iterator[str]:
    """Texts of cases with up to six random keys."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        values = dict(CONTACTS[rng.integers(len(CONTACTS))])
        for _ in range(rng.integers(1, 7)):
            keys = DRAWN[str(rng.choice(list(DRAWN)))]
            key = keys[rng.integers(len(keys))]
            values[key.name] = value_of(key, rng)
        values["grid.points"] = min(129, int(values.get("grid.points", 65)))  # type: ignore[arg-type]
        groups: dict[str, list[str]] = {}
        for name, value in values.items():
            group, _, short_name = name.partition(".")
            groups.setdefault(group, []).append(f"{short_name} = {to_text(value)}")
        yield "".join(f"&{group} {' '.join(lines)} /\n" for group, lines in groups.items())


def by_ehl(text: str) -> str:
    """The error of ehl, or ''."""
    try:
        SolverHandle(text).close()
    except EhlError as error:
        return str(error)
    return ""


def by_pyehl(text: str) -> str:
    """The error of pyehl, or ''."""
    try:
        Solver(Case.from_text(text)).close()
    except EhlError as error:
        return str(error)
    return ""


@pytest.mark.parametrize(
    ("seed", "count"), [(1, 200), pytest.param(2, 1000, marks=pytest.mark.long)]
)
def test_random_keys(seed: int, count: int):
    refused = taken = 0
    for text in cases(seed, count):
        ehl, pyehl = by_ehl(text), by_pyehl(text)
        assert bool(ehl) == bool(pyehl) or COMPLETED in ehl, f"{text}\n{ehl}\n{pyehl}"
        # pyehl detects it before it calls the solver
        assert "resolved case" not in pyehl, f"{text}\n{pyehl}"
        refused += bool(ehl)
        taken += not ehl
    assert min(refused, taken) > 0.1 * count


@pytest.mark.parametrize(
    ("name", "text"), [(name, text) for name, text, options, _ in FAULTS if not options]
)
def test_malformed_cases(name: str, text: str):
    with pytest.raises(InputError):
        Case.from_text(text.replace(MARK, ""))
    assert by_ehl(text.replace(MARK, "")), name


@pytest.mark.parametrize(
    "keys",
    [
        "kind = 'fractal' rms_height = 5e-8 ra = 4e-7",
        "kind = 'fractal' rms_height = 5e-8 rq = 4e-7",
        "kind = 'fractal' rms_height = 5e-8 finish = 'ground'",
    ],
)
def test_heights_that_ehl_does_not_derive(keys: str):
    """``ehl`` refuses a height beside a different Ra or Rq, and a finish without its spectrum."""
    for group in ("surface", "second_surface"):
        text = f"&contact load = 20.0 /\n&{group} {keys} /\n"
        ehl, pyehl = by_ehl(text), by_pyehl(text)
        assert ehl
        assert pyehl or COMPLETED in ehl
    # pyehl gives all values to the solver
    text = "&contact load = 20.0 /\n&surface finish = 'ground' ra = 2e-8 /\n"
    assert not by_ehl(resolve(text, "text"))
