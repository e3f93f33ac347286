# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions and results in copies, threads and other processes."""

import copy
import importlib
import inspect
import multiprocessing
import pickle
import pkgutil
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyehl
from pyehl.destination import write_json
from pyehl.netcdf import export
from pyehl.surfaces.text_table import BadCellError

SMALL = {"contact.moes_m": 100.0, "contact.moes_l": 5.0, "grid.points": 33}
ROUGH = {"grid.points": 65, "surface.kind": "fractal", "surface.pixels": 32}
COPIES: tuple[Callable[[Any], Any], ...] = (
    lambda thing: pickle.loads(pickle.dumps(thing)),
    copy.copy,
    copy.deepcopy,
)


def exceptions() -> list[type[BaseException]]:
    """All exception classes of the package."""
    result = set()
    for module in pkgutil.walk_packages(pyehl.__path__, "pyehl."):
        if module.name.endswith("__main__"):
            continue
        for _, thing in inspect.getmembers(importlib.import_module(module.name), inspect.isclass):
            if issubclass(thing, BaseException) and thing.__module__.startswith("pyehl"):
                result.add(thing)
    return sorted(result, key=lambda thing: thing.__name__)


@pytest.mark.parametrize("kind", exceptions(), ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("through", COPIES, ids=["pickle", "copy", "deepcopy"])
def test_exceptions(kind, through):
    results = pyehl.solve(pyehl.Case.from_text(""), SMALL) if kind is pyehl.NotConverged else None
    given = {pyehl.NotConverged: ("why", results), BadCellError: (3, "x1")}.get(kind, ("why",))
    error = kind(*given)
    error.add_note("and a note")
    again = through(error)
    assert type(again) is kind
    assert (str(again), again.__notes__) == (str(error), ["and a note"])
    assert again.args == error.args or results is not None
    if results is not None:
        assert again.results.identical(results)


def results() -> Iterator[Any]:
    case = pyehl.Case.from_text("", SMALL)
    yield case
    yield pyehl.solve(case)
    yield pyehl.predict(pyehl.Case.from_text("", ROUGH))
    yield pyehl.film(case)
    yield pyehl.OperatingPoint()
    yield pyehl.Lubricant.from_name("fva3")
    yield pyehl.Topography(np.zeros((8, 8)), (1e-4, 1e-4))


@pytest.mark.parametrize("through", COPIES, ids=["pickle", "copy", "deepcopy"])
def test_results(through):
    for thing in results():
        again = through(thing)
        assert type(again) is type(thing)
        assert repr(again) == repr(thing)


@pytest.mark.parametrize("through", COPIES, ids=["pickle", "copy", "deepcopy"])
def test_a_solver_has_no_copies(through):
    """Two solvers with one number would free each other's arrays."""
    with pyehl.Solver(pyehl.Case.from_text("", SMALL)) as solver:
        with pytest.raises(TypeError, match="cannot be copied or pickled: make another"):
            through(solver)
        assert not solver.advance()


def test_other_processes():
    """A failure in a pool does not keep the other processes from their results."""
    context = multiprocessing.get_context("spawn")
    case = pyehl.Case.from_text("", SMALL)
    with ProcessPoolExecutor(1, mp_context=context) as pool:
        jobs = [pool.submit(pyehl.solve, case, {"solver.max_cycles": n}) for n in (30, 1, 30)]
        assert float(jobs[0].result().H_c) == float(jobs[2].result().H_c)
        with pytest.raises(pyehl.NotConverged) as error:
            jobs[1].result()
    assert error.value.results.attrs["status"] == "cycle limit"


def test_threads_that_write_one_target(tmp_path: Path):
    target = tmp_path / "out.json"
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda k: write_json(target, {"k": k}), range(800)))
    assert target.read_text().startswith('{\n  "k": ')
    folder = tmp_path / "result"
    pyehl.solve(pyehl.Case.from_text("", SMALL), output=folder)
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda _: export(folder, tmp_path / "one.nc"), range(20)))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.nc", "out.json", "result"]
