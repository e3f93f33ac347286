# SPDX-License-Identifier: BSD-3-Clause
"""The interface to Fortran: no copies, errors as exceptions, handles that end."""

import re
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from pyehl import Case, Solver, errors, handle, library
from pyehl.case import resolve
from pyehl.extension import solvers as ehl
from pyehl.handle import NO_HEIGHTS

SMALL = (
    "&contact moes_m = 100.0 moes_l = 5.0 /\n"
    "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
)


@pytest.fixture
def number() -> Iterator[int]:
    """A solver as the number that the library uses."""
    text = Case.from_text(SMALL).text.encode()
    opened, status, message = ehl.open_case(text, b"case", 0, NO_HEIGHTS, 0, NO_HEIGHTS)
    errors.check(status, message)
    yield opened
    errors.check(*ehl.close_case(opened))


@pytest.fixture
def solver():
    with Solver(Case.from_text(SMALL)) as opened:
        yield opened


def test_one_exception_class_per_code(root: Path):
    text = (root / "fortran" / "base" / "status.f90").read_text()
    codes = dict(re.findall(r"parameter :: ehl_(\w+) = (\d+)", text))
    names = {int(number): name.replace("_", "") for name, number in codes.items() if name != "ok"}
    classes = {
        number: kind.__name__.removesuffix("Error").lower()
        for number, kind in errors.CLASSES.items()
    }
    assert classes == {n: {"badinput": "input"}.get(name, name) for n, name in names.items()}


def test_unknown_code_is_an_internal_error():
    with pytest.raises(errors.InternalError, match="what"):
        errors.check(99, b"what")
    errors.check(0, b"")


def test_solver_in_python(solver: Solver):
    assert solver.describe()
    assert not solver.done
    assert solver.run()
    assert solver.done
    assert solver.summary["status"] == "converged"
    x, y = solver.axes()
    assert (x[0], x[-1], y[0], y[-1]) == (-2.5, 1.5, -2.0, 2.0)
    pressure = solver.field("P")
    assert pressure.shape == solver.shape == (33, 33)
    assert pressure.flags.f_contiguous
    assert pressure.max() == solver.summary["P_max"]
    with pytest.raises(errors.InputError):
        solver.field("Q")


def test_fields_refer_to_the_finest_grid_from_the_start():
    """Nested iteration begins on a coarser grid; its values are given on the finest one."""
    with Solver(Case.from_text(SMALL.replace("33", "129"))) as solver:
        shapes = set()
        while not solver.done:
            x, y = solver.axes()
            pressure = solver.field("P")
            shapes.add((solver.shape, pressure.shape, x.shape, y.shape))
            # linear between the nodes of the coarser grid: symmetric to rounding
            assert np.allclose(pressure, pressure[:, ::-1], rtol=0.0, atol=1e-14)
            solver.advance()
        assert shapes == {((129, 129), (129, 129), (129,), (129,))}
        assert solver.summary["P_max"] == solver.field("P").max()


def test_interrupted_solver(solver: Solver):
    solver.advance()
    solver.interrupt()
    assert solver.done
    assert not solver.converged
    assert solver.summary["status"] == "interrupted"


@pytest.mark.parametrize("array", [
    np.empty((33, 33)),
    np.empty((33, 33), dtype=np.float32, order="F"),
    np.empty((33, 33), dtype=np.int64, order="F"),
    np.empty((66, 33), order="F")[::2],
], ids=["C order", "float32", "int64", "strided"])  # fmt: skip
def test_arrays_are_refused_rather_than_copied(number: int, array):
    with pytest.raises(ValueError, match="array"):
        ehl.field(number, b"P", array)


def test_arrays_of_another_shape_are_refused(number: int):
    with pytest.raises(errors.InputError, match="shape"):
        errors.check(*ehl.field(number, b"P", np.empty((33, 31), order="F")))


def test_values_arrive_in_the_callers_memory(number: int):
    values = np.full((33, 33), np.nan, order="F")
    errors.check(*ehl.field(number, b"H", values))
    assert np.isfinite(values).all()


def test_closed_solver_raises():
    solver = Solver(Case.from_text(SMALL))
    solver.close()
    solver.close()
    for call in (solver.advance, solver.describe, solver.interrupt, solver.axes):
        with pytest.raises(errors.ClosedError):
            call()
    with pytest.raises(errors.ClosedError):
        solver.summary  # noqa: B018
    for wrong in (-1, 0, 5, 2**31 - 1):
        with pytest.raises(errors.ClosedError):
            errors.check(*ehl.interrupt(wrong))


def test_a_handle_is_never_used_again(number: int):
    """A new solver gets another handle, even in the same slot."""
    errors.check(*ehl.close_case(number))
    text = Case.from_text(SMALL).text.encode()
    other, status, message = ehl.open_case(text, b"case", 0, NO_HEIGHTS, 0, NO_HEIGHTS)
    errors.check(status, message)
    assert other != number
    with pytest.raises(errors.ClosedError):
        errors.check(*ehl.interrupt(number))
    errors.check(*ehl.close_case(other))


SLOTS = """
import pytest
from pyehl import Case, Solver, errors

case = Case.from_text(
    "&contact moes_m = 100.0 /\\n"
    "&grid points = 17 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\\n"
)
opened = [Solver(case) for _ in range(64)]
with pytest.raises(errors.NoMemoryError, match="64"):
    Solver(case)
for solver in opened:
    solver.close()
with Solver(case) as again:
    assert not again.done
"""


def test_slots_run_out_and_are_freed():
    """In a separate process: other tests may have open solvers."""
    subprocess.run([sys.executable, "-P", "-c", SLOTS], check=True)


def test_solvers_in_threads_do_not_disturb_each_other():
    texts = [SMALL, SMALL.replace("100.0", "50.0")] * 8
    results: list[float | None] = [None] * len(texts)

    def work(k: int) -> None:
        with Solver(Case.from_text(texts[k])) as solver:
            solver.run()
            results[k] = solver.summary["H_c"]

    threads = [threading.Thread(target=work, args=(k,)) for k in range(len(texts))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(set(results[::2])) == len(set(results[1::2])) == 1
    assert None not in results
    assert results[0] != results[1]


def test_text_beyond_ascii_arrives():
    with pytest.raises(errors.InputError, match=r"Höhe µm:1:1: error: unknown group &größe"):
        resolve("&größe /", "Höhe µm")


def test_deflection_of_the_hertz_pressure():
    # W = 1 - r^2/2 inside a Hertz contact, in units of a^2/R
    x = np.linspace(-1.5, 1.5, 65)
    r2 = x[:, None] ** 2 + x[None, :] ** 2
    pressure = np.sqrt(np.maximum(1.0 - r2, 0.0))
    h = x[1] - x[0]
    inside = r2 < 0.8
    for engine, folded in (("mlmi", 1e-4), ("fft", 1e-13)):
        result = library.deflection(pressure, h, h, engine)
        assert abs(result.values - (1.0 - 0.5 * r2))[inside].max() < 0.02
        assert result.seconds > 0.0
        half = library.deflection(pressure[:, 32:], h, h, engine, mirror=True)
        assert np.abs(half.values - result.values[:, 32:]).max() < folded
    with pytest.raises(errors.InputError, match="fem"):
        library.deflection(pressure, h, h, "fem")


def test_texts_of_any_length_arrive_complete(monkeypatch: pytest.MonkeyPatch):
    """The library returns the length of a list; a second call has a buffer of that length."""
    monkeypatch.setattr(handle, "MIN_BYTES", 7)
    monkeypatch.setattr(handle, "MIN_VALUES", 3)
    with Solver(Case.from_text("&grid points = 33 /\n")) as solver:
        solver.run()
        short = solver.summary
        monkeypatch.undo()
        assert solver.summary == short


def test_a_truncated_message_states_it():
    with pytest.raises(errors.InputError) as caught:
        library.deflection(np.zeros((33, 33)), 0.1, 0.1, "x" * 9000)
    assert str(caught.value).endswith("... (the rest does not fit)")
