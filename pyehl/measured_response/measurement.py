# SPDX-License-Identifier: BSD-3-Clause
"""Response T(q; X) of a contact to waves of roughness, measured with the solver.

The waves are from 4 a down to a/32 long, on grids with at least eight nodes per wavelength, in
tiers: a coarse grid and a long tile for long waves, finer grids and shorter tiles for short ones. A
tier is one transient run (:mod:`pyehl.measured_response.superposition`) and one file of the result
folder; a tier whose file exists is not run again.
"""

import json
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np

from pyehl.case import Case
from pyehl.destination import Destination, file_errors, new_file
from pyehl.errors import EhlError, InputError
from pyehl.measured_response.superposition import WaveSet, step_counts, superpose
from pyehl.prediction.predict import oblique
from pyehl.studies.journal import difference
from pyehl.studies.pool import processors
from pyehl.theory.operating import OperatingPoint
from pyehl.types import Settings

# Angles of the crests to those across the motion, cyclically for successive waves [deg]
DIRECTIONS = (0, 45, 80, 26, 0, 63, 15, 75, 0, 56, 35, 70, 0, 45, 62, 20)
NODES = 8
"""Minimum number of nodes per wavelength."""
Progress = Callable[[str, int, int], object]


@dataclass(frozen=True, slots=True)
class Tier:
    """One transient run."""

    name: str  # of the tier and of its file
    tile: float  # side of the tile [a]
    points: int  # nodes per side of the domain, 4 a by 4 a
    # Longest wavelength along the motion, and shortest wavelength in any direction [a]
    longest: float
    shortest: float

    def steps(self, velocity_ratio: float) -> int:
        """Count the steps of the run."""
        return step_counts(self.points, self.tile, velocity_ratio)[1]


TIERS = (
    Tier("long", 4.0, 257, 4.0, 0.125),
    Tier("middle", 1.0, 513, 0.5, 0.0625),
    Tier("short", 0.5, 1025, 0.125, 0.03125),
)
"""The tiers of the command; a quick measurement omits the last."""


def tier_waves(tier: Tier) -> WaveSet:
    """Return the waves of a tier: up to 24 wavelengths that it resolves, in various directions.

    ValueError if the grid has fewer than NODES nodes for the shortest wave.
    """
    nodes = tier.shortest * (tier.points - 1) / 4.0
    if nodes < NODES - 1e-9:
        raise ValueError(f"tier '{tier.name}': {nodes:g} nodes for the shortest wave, not {NODES}")
    first, last = round(tier.tile / tier.longest), round(tier.tile / tier.shortest)
    along = np.unique(np.round(np.geomspace(first, last, 24)).astype(np.int64))
    angles = np.resize(np.array(DIRECTIONS, dtype=float), along.size)
    across = np.round(along * np.tan(np.radians(angles))).astype(np.int64)
    # no oblique wave is shorter than `shortest`
    limit = np.floor(np.sqrt(last**2 - along**2)).astype(np.int64)
    phase = np.random.default_rng(5).uniform(0.0, 2.0 * np.pi, along.size)
    return WaveSet(tier.tile, along, np.minimum(across, limit), phase)


def _identity(settings: Settings, velocity_ratio: float, tier: Tier) -> str:
    """Return the inputs of a tier as text."""
    o = OperatingPoint.from_settings(settings)
    shape = [] if o.radius_ratio == 1.0 else [o.radius_ratio]
    values = {
        "pyehl version": metadata.version("pyehl"),
        "contact": [o.load, o.mean_velocity, o.radius, o.reduced_modulus, *shape],
        "lubricant": dict(settings["lubricant"]),
        "velocity_ratio": velocity_ratio,
        "tier": asdict(tier),
    }
    return json.dumps(values, sort_keys=True)


def _file(folder: Path, tier: Tier) -> Path:
    return folder / f"tier_{tier.name}.npz"


def with_tiers(place: Destination) -> Destination:
    """Return the destination with its existing tiers marked to be kept."""
    folder = Path(place.folder)
    there = tuple(path.name for tier in TIERS if (path := _file(folder, tier)).exists())
    return replace(place, kept=there)


def _check_folder(place: Destination, settings: Settings, velocity_ratio: float) -> list[Tier]:
    """Return the tiers that exist already; refuse a folder with any other file."""
    with_tiers(place).check()
    done = []
    for tier in TIERS:
        path = _file(Path(place.folder), tier)
        if not path.is_file():
            continue
        try:
            with np.load(path, allow_pickle=False) as stored:
                result = json.loads(str(stored["identity"]))
        except (OSError, ValueError, KeyError, EOFError) as error:
            raise InputError(f"{path}: cannot be read ({error}); remove it") from error
        wrong = difference(result, json.loads(_identity(settings, velocity_ratio, tier)))
        if wrong:
            message = f"{path}: belongs to another response; use another folder. It differs in"
            raise InputError("\n  ".join([message, *wrong]))
        done.append(tier)
    return done


def measure(
    case: Case,
    place: Destination,
    *,
    tiers: Sequence[Tier] = TIERS,
    progress: Progress = lambda name, done, total: None,
) -> dict[str, dict[str, Any]]:
    """Measure the response at the operating point and velocity ratio of a case.

    Its groups contact and lubricant and `surface.velocity_ratio` are used. Tiers whose files exist
    are not run again; tiers run one after the other, each on all processors. `progress` is called
    with the name of a tier, its steps done and its total of steps.

    Returns by the name of the tier the arrays of
    :class:`pyehl.measured_response.superposition.Superposition`, with tile [a], along, across,
    phase [rad] and seconds. InputError if the velocity ratio is not positive, or the folder has
    other files; FileError if it cannot be created; EhlError if a tier fails: the files of finished
    tiers remain.
    """
    settings = case.resolve()
    why = oblique(settings)
    if why:
        raise InputError(why)
    ratio = float(settings["surface"]["velocity_ratio"])
    if not ratio > 0.0:
        raise InputError(
            f"surface.velocity_ratio = {ratio:g}: a surface at rest makes no waves in time; "
            "expected: a positive number"
        )
    folder = Path(place.folder)
    done = _check_folder(place, settings, ratio)
    new = not folder.exists()
    with file_errors(folder, "cannot be made"):
        folder.mkdir(parents=True, exist_ok=True)
    result = {}
    try:
        for tier in tiers:
            path = _file(folder, tier)
            if tier not in done:
                _run_tier(settings, ratio, tier, path, partial(progress, tier.name))
            with np.load(path, allow_pickle=False) as stored:
                result[tier.name] = {name: stored[name] for name in stored.files}
    except KeyboardInterrupt as stop:
        kept = f"kept in {folder}: {', '.join(result)}; the same command resumes from there"
        raise KeyboardInterrupt(kept if result else "no run has ended: nothing is kept") from stop
    finally:
        if new and not any(folder.iterdir()):
            folder.rmdir()
    return result


def _run_tier(
    settings: Settings,
    velocity_ratio: float,
    tier: Tier,
    path: Path,
    progress: Callable[[int, int], object],
) -> None:
    """Run a tier and write its file, completely or not at all."""
    began = time.perf_counter()
    waves = tier_waves(tier)
    try:
        result = superpose(
            settings,
            waves,
            points=tier.points,
            velocity_ratio=velocity_ratio,
            solver={"threads": processors()},
            progress=progress,
        )
    except EhlError as error:
        raise EhlError(f"tier '{tier.name}': {error}") from error
    with new_file(path) as fresh, fresh.open("wb") as stream:
        np.savez(
            stream,
            identity=_identity(settings, velocity_ratio, tier),
            seconds=time.perf_counter() - began,
            **asdict(waves),
            **asdict(result),
        )
