# SPDX-License-Identifier: BSD-3-Clause
"""What all tests share: the program, the folder of cases, and calls of both drivers."""

import contextlib
import gc
import importlib
import importlib.util
import io
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Generator, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from pyehl import cli

# products of small matrices are slower on several threads; to be set before NumPy is loaded
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

ROOT = Path(__file__).resolve().parent.parent


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Collect without the search for unused cycles, which takes a third of the time.

    Objects that exist after the collection are not searched later.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Give each file to one worker: the tests of a file share runs."""
    from xdist.scheduler import LoadFileScheduling

    return LoadFileScheduling(config, log)


@pytest.fixture(scope="session", autouse=True)
def workers_wait_for_later_tests() -> None:
    """Keep the worker processes of a study: to start one takes a second of imports."""
    from pyehl.studies import pool

    pool.IDLE_TIMEOUT = 3600


@pytest.fixture(scope="session")
def root() -> Path:
    """The root folder of the repository."""
    return ROOT


@pytest.fixture(scope="session")
def script() -> Callable[[str], ModuleType]:
    """Import a script of `docs/` by its path from the folder of the repository."""

    def load(path: str) -> ModuleType:
        spec = importlib.util.spec_from_file_location(path.replace("/", "_"), ROOT / path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        # dataclasses look their module up
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
        return module

    return load


@pytest.fixture
def evidence(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[str, str], ModuleType]]:
    """Import a module of a folder of `docs/evidence` for one test only."""

    def load(folder: str, name: str) -> ModuleType:
        monkeypatch.syspath_prepend(str(ROOT / "docs" / "evidence" / folder))
        # several folders have a `make`
        monkeypatch.delitem(sys.modules, name, raising=False)
        return importlib.import_module(name)

    before = set(sys.modules)
    yield load
    for name in set(sys.modules) - before:
        if str(ROOT / "docs" / "evidence") in (getattr(sys.modules[name], "__file__", "") or ""):
            del sys.modules[name]


@pytest.fixture(scope="session")
def cases() -> Path:
    """The folder of the case files."""
    return ROOT / "cases"


@pytest.fixture(scope="session")
def ehl() -> str:
    """The program ``ehl`` of this installation."""
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    # An editable install leaves the program in its build folder
    places = [Path(sys.executable).parent / "ehl", ROOT / "build" / tag / "fortran" / "ehl"]
    for place in places:
        if place.is_file():
            return str(place)
    result = shutil.which("ehl")
    assert result, f"the program ehl is in none of {places} and not on the PATH: pip install ."
    return result


Driver = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="session")
def drivers(ehl: str) -> dict[str, list[str]]:
    """How to call both drivers: ``ehl`` and ``pyehl run``."""
    # -P: never import from the working directory
    return {"ehl": [ehl], "pyehl": [sys.executable, "-P", "-m", "pyehl", "run"]}


@pytest.fixture(scope="session")
def command() -> Driver:
    """Call ``pyehl`` in this process: ``command(folder, "check", "case.nml")``.

    A new process would take longer than most of what is tested. After `seconds` the test fails.
    """

    def call(
        folder: Path, *words: str | Path, seconds: int = 300
    ) -> subprocess.CompletedProcess[str]:
        def late(*_: Any) -> None:
            pytest.fail(f"{words}: not done after {seconds} s")

        given = [*map(str, words)]
        printed, complaints = io.StringIO(), io.StringIO()
        before = signal.signal(signal.SIGALRM, late)
        signal.alarm(seconds)
        try:
            with (
                contextlib.chdir(folder),
                contextlib.redirect_stdout(printed),
                contextlib.redirect_stderr(complaints),
            ):
                status = cli.main(given)
        except SystemExit as stop:
            status = int(stop.code or 0)
        finally:
            signal.alarm(0)
            signal.signal(signal.SIGALRM, before)
        return subprocess.CompletedProcess(given, status, printed.getvalue(), complaints.getvalue())

    return call


@pytest.fixture
def drive(ehl: str, command: Driver, tmp_path: Path) -> Driver:
    """Run a driver in an empty folder: ``drive("ehl", "case.nml", "-o", "out")``."""
    environment = {k: v for k, v in os.environ.items() if k != "OMP_NUM_THREADS"}

    def call(driver: str, *words: str | Path) -> subprocess.CompletedProcess[str]:
        if driver == "pyehl":
            return command(tmp_path, "run", *words)
        return subprocess.run(
            [ehl, *map(str, words)],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )

    return call
