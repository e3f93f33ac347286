# SPDX-License-Identifier: BSD-3-Clause
"""The response T(q; X) of a contact to waves of roughness, measured with the solver.

Waves of 4 a down to a/32, each on a grid with at least eight nodes a wavelength, in tiers: a
coarse grid and a long tile for long waves, finer grids and shorter tiles for short ones. A tier is
one transient run (:mod:`pyehl.studies.superposition`) in a process of its own, and one file of the
result folder; a tier whose file is there is not run again.
"""

from __future__ import annotations

import json
import multiprocessing as mp
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, replace
from importlib import metadata
from pathlib import Path
from queue import Empty
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyehl.case import Case
from pyehl.destination import Destination, file_errors, new_file
from pyehl.errors import EhlError, InputError
from pyehl.studies.journal import difference
from pyehl.studies.pool import processors
from pyehl.studies.ridges import ridges
from pyehl.studies.superposition import superpose
from pyehl.studies.tiers import TIERS, Tier, ridge_wavelengths, tier_waves
from pyehl.theory.operating import OperatingPoint

__all__ = ["measure", "with_tiers"]

Array = NDArray[np.float64]
Progress = Callable[[str, int, int], object]


def _identity(settings: Mapping[str, Mapping[str, Any]], velocity_ratio: float, tier: Tier) -> str:
    """Tell what a tier depends on, as text."""
    o = OperatingPoint.from_settings(settings)
    values = {
        "pyehl version": metadata.version("pyehl"),
        "contact": [o.load, o.mean_velocity, o.radius, o.reduced_modulus],
        "lubricant": dict(settings["lubricant"]),
        "velocity_ratio": velocity_ratio,
        "tier": asdict(tier),
    }
    return json.dumps(values, sort_keys=True)


def _file(folder: Path, tier: Tier) -> Path:
    return folder / f"tier_{tier.name}.npz"


def run_tier(
    text: str, velocity_ratio: float, tier: Tier, threads: int, path: Path, progress: Progress
) -> None:
    """Run a tier of a resolved case and write its file, whole or not at all."""
    settings = Case.from_text(text).resolve()
    began = time.perf_counter()

    def report(done: int, total: int) -> None:
        progress(tier.name, done, total)

    if tier.ridges:
        found: dict[str, Any] = ridges(
            settings,
            ridge_wavelengths(tier),
            points=tier.points,
            solver={"threads": threads},
            progress=report,
        )
    else:
        waves = tier_waves(tier)
        found = {name: getattr(waves, name) for name in ("tile", "along", "across", "phase")}
        found |= asdict(
            superpose(
                settings,
                waves,
                points=tier.points,
                velocity_ratio=velocity_ratio,
                solver={"threads": threads},
                progress=report,
            )
        )
    with new_file(path) as partial, partial.open("wb") as stream:
        np.savez(
            stream,
            identity=_identity(settings, velocity_ratio, tier),
            seconds=time.perf_counter() - began,
            **found,
        )


def _child(
    text: str,
    velocity_ratio: float,
    tier: Tier,
    threads: int,
    path: Path,
    queue: Any,  # noqa: ANN401
) -> None:
    """Run a tier in a process of its own, as long as there is somebody to read the queue."""
    parent = mp.parent_process()

    def report(*now: Any) -> None:  # noqa: ANN401
        if parent is not None and not parent.is_alive():
            raise KeyboardInterrupt
        queue.put(("step", now))

    try:
        run_tier(text, velocity_ratio, tier, threads, path, report)
        queue.put(("end", (tier.name, "")))
    except (EhlError, OSError, ValueError) as error:
        queue.put(("end", (tier.name, str(error))))
    except KeyboardInterrupt:
        queue.put(("end", (tier.name, "interrupted")))


def with_tiers(place: Destination) -> Destination:
    """Give a place with the tiers in it, which stay."""
    folder = Path(place.folder)
    tiers = [_file(folder, tier).name for tier in TIERS]
    there = [path.name for path in folder.iterdir()] if folder.is_dir() else []
    return replace(place, kept=tuple(name for name in there if name in tiers))


def _check_folder(
    place: Destination, settings: Mapping[str, Mapping[str, Any]], velocity_ratio: float
) -> list[Tier]:
    """Tiers that are there already; refuses a folder with anything else in it."""
    with_tiers(place).check()
    done = []
    for tier in TIERS:
        path = _file(Path(place.folder), tier)
        if not path.is_file():
            continue
        try:
            with np.load(path, allow_pickle=False) as stored:
                found = json.loads(str(stored["identity"]))
        except (OSError, ValueError, KeyError, EOFError) as error:
            raise InputError(f"{path}: cannot be read ({error}); remove it") from error
        wrong = difference(found, json.loads(_identity(settings, velocity_ratio, tier)))
        if wrong:
            raise InputError(
                "\n  ".join(
                    [f"{path}: is of another response; use another folder. It differs in", *wrong]
                )
            )
        done.append(tier)
    return done


def measure(
    case: Case,
    place: Destination,
    *,
    tiers: Sequence[Tier] = TIERS,
    jobs: int = 2,
    progress: Progress = lambda name, done, total: None,
) -> dict[str, dict[str, Any]]:
    """Measure the response at the operating point and velocity ratio of a case.

    Its groups contact and lubricant and `surface.velocity_ratio` are used. Tiers that are in the
    folder are not run again; `jobs` run at a time and share the processors. `progress` is called
    with the name of a tier, its steps done and its steps in all.

    By the name of the tier what :class:`pyehl.studies.superposition.Superposition` has, with tile
    [a], along, across, phase [rad] and seconds. InputError if the velocity ratio is not positive,
    or the folder holds something else; FileError if it cannot be made; EhlError if a tier fails:
    those that have ended stay.
    """
    settings = case.resolve()
    OperatingPoint.from_settings(settings).need_round("the response of the contact")
    ratio = float(settings["surface"]["velocity_ratio"])
    if not ratio > 0.0:
        raise InputError(
            f"surface.velocity_ratio = {ratio:g}: a surface at rest makes no waves in time; "
            "expected: a positive number"
        )
    if jobs < 1:
        raise InputError(f"jobs = {jobs}; expected: 1 or more")
    folder = Path(place.folder)
    done = _check_folder(place, settings, ratio)
    with file_errors(folder, "cannot be made"):
        folder.mkdir(parents=True, exist_ok=True)
    wanted = [tier for tier in tiers if tier not in done]
    _run_all(case.text, ratio, wanted, jobs, folder, progress)
    found = {}
    for tier in tiers:
        with np.load(_file(folder, tier), allow_pickle=False) as stored:
            found[tier.name] = {name: stored[name] for name in stored.files}
    return found


def _run_all(
    text: str,
    velocity_ratio: float,
    tiers: Sequence[Tier],
    jobs: int,
    folder: Path,
    progress: Progress,
) -> None:
    """Run tiers side by side, the largest first."""
    context = mp.get_context("spawn")
    queue: Any = context.Queue()
    waiting = sorted(tiers, key=lambda tier: tier.points)
    threads = max(1, processors() // max(1, min(jobs, len(waiting))))
    running: dict[str, Any] = {}
    failed: list[str] = []
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                tier = waiting.pop()
                arguments = (text, velocity_ratio, tier, threads, _file(folder, tier), queue)
                process = context.Process(target=_child, args=arguments, daemon=True)
                process.start()
                running[tier.name] = process
            try:
                kind, values = queue.get(timeout=1.0)
            except Empty:
                for name in [n for n, p in running.items() if not p.is_alive() and queue.empty()]:
                    code = running.pop(name).exitcode
                    failed.append(f"tier '{name}': its process ended with status {code}")
                continue
            if kind == "step":
                progress(*values)
                continue
            name, message = values
            running.pop(name).join()
            if message:
                failed.append(f"tier '{name}': {message}")
    finally:
        for process in running.values():
            process.terminate()
            process.join()
    if failed:
        raise EhlError("; ".join(failed))
