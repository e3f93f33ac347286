# SPDX-License-Identifier: BSD-3-Clause
"""Run the tasks of a Stribeck curve, write its table and what ``pyehl stribeck`` prints."""

import os
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from pyehl.case import Case
from pyehl.destination import AnyPath, Destination
from pyehl.errors import InputError, did_you_mean
from pyehl.given import Option, check_kind, options_of, path_of
from pyehl.netcdf import write_netcdf
from pyehl.studies.curve import CONCLUSION, curve_table, curves_of, units_of
from pyehl.studies.curve_plan import KEYS, CurvePlan, plan_curve
from pyehl.studies.journal import FILES as JOURNAL
from pyehl.studies.measured_friction import Measured
from pyehl.studies.pool import check_jobs
from pyehl.studies.study import Axis, axes_of
from pyehl.studies.sweep import Outcome, gather, over, write_csv
from pyehl.theory.load_share import AIHARA, LoadShare
from pyehl.theory.transition import FULL_FILM, MIXED, OUTSIDE, Curve
from pyehl.types import Row

COLUMNS = {
    "h_c_m": "h_c [m]",
    "h_min_m": "h_min [m]",
    "h_min_rough_m": "rough [m]",
    "lambda_ratio": "Lambda",
    "theta_2": "theta_2",
    "hersey": "Hersey",
    "mu_ratio": "mu_r/mu_s",
    "mu_ratio_model_error": "+- model",
    "mu": "mu",
    "mu_isothermal": "isothermal",
    "temperature_rise_max_K": "dT [K]",
    "contact_load_share": "contact",
    "contact_load_share_error": "+- contact",
    "contact_area_share": "area",
    "mu_empirical": "empirical",
    "mu_ratio_ehl": "simulated",
}


def absolute_friction(plan: CurvePlan, table: pd.DataFrame) -> bool:
    """Whether all results of sliding contacts are coefficients of friction.

    Points whose smooth contact has no solution do not count, nor do those without a ratio beyond
    the range of the prediction.
    """
    sliding = np.array([bool(p.settings["contact"]["slide_to_roll"]) for p in plan.points])
    result = table[sliding & table["status"].isin((FULL_FILM, MIXED, OUTSIDE))]
    result = result[(result["status"] != OUTSIDE) | result["mu_ratio"].notna()]
    return bool(len(result) and result["mu"].notna().all())


def report(plan: CurvePlan, table: pd.DataFrame) -> str:
    """Return the table that is printed."""
    keys = plan.study.keys
    names = [name for name in COLUMNS if name in table and table[name].notna().any()]
    head = [*(f"{key:>21}" for key in keys), *(f"{COLUMNS[name]:>10}" for name in names)]
    lines = ["  ".join([*head, "status"])]
    for row in table.to_dict("records"):
        cells = [f"{row[key]:>21}" for key in keys]
        cells += [f"{'-' if pd.isna(row[n]) else format(row[n], '.4g'):>10}" for n in names]
        lines.append("  ".join([*cells, row["status"]]))
    for curve in curves_of(plan, table):
        lines.append(f"{curve.label + ': ' if curve.label else ''}{curve.ends}")
        if lift_off := curve.lift_off:
            lines.append(lift_off.words)
    if plan.load_share is not None:
        lines.append(plan.load_share.words)
    return "\n".join(lines)


def last_lines(plan: CurvePlan, table: pd.DataFrame) -> str:
    """Report the point with the minimum film in full, and count the assessments of all points."""
    film = table["h_min_rough_m"].fillna(table["h_min_m"]).astype(float)
    film = film[table["h_min_m"].notna()]
    if film.empty:
        return "assessment no result: no point has a film"
    at_minimum = int(film.idxmin())
    words = table["assessment"].str.partition(":")[0].where(table["status"] != OUTSIDE, OUTSIDE)
    counts = ", ".join(f"{word} at {n}" for word, n in Counter(words).items())
    return (
        f"the minimum film is at {plan.points[at_minimum].point}:\n"
        f"{table[CONCLUSION][at_minimum]}\n"
        f"curve      {counts} of {len(table)} points"
    )


def deviation(curve: Curve, measured: Measured) -> list[str]:
    """Report the deviation of a curve from measured friction."""
    lines = []
    for name in (measured.ordinate, "mu_empirical"):
        if name not in curve.table:
            continue
        result = measured.deviation(name, curve)
        known = np.isfinite(result)
        if not known.any():
            lines.append(f"measured   no point of the curve there has {name}")
            continue
        worst = int(np.nanargmax(np.abs(result)))
        lines.append(
            f"measured   {name} is off by {np.mean(result[known]):+.1%} in the mean, "
            f"{np.sqrt(np.mean(result[known] ** 2)):.1%} rms, {result[worst]:+.1%} at most "
            f"({measured.abscissa} = {measured.places[worst]:.4g}); {known.sum()} of "
            f"{known.size} points"
        )
    return lines


CSV, NETCDF, PICTURE = "stribeck.csv", "stribeck.nc", "stribeck.png"
FILES = (CSV, NETCDF, PICTURE)


def curve_axes(vary: Mapping[str, Any]) -> list[Axis]:
    """Give the axes of a curve, from values by key.

    InputError if there are none, a curve cannot vary a key, or values are not numbers.
    """
    axes, known = axes_of(vary), list(KEYS.values())
    for one in axes:
        if one.key not in known:
            raise InputError(f"vary: '{one.key}'{expected_keys()}{did_you_mean(one.key, known)}")
    if not axes:
        raise InputError(f"nothing is varied{expected_keys()}")
    return axes


def expected_keys() -> str:
    """List the keys that a curve may vary, as the end of a message."""
    return f"\nexpected: values of at least one of {', '.join(KEYS.values())}"


def perform(
    plan: CurvePlan,
    folder: AnyPath | None,
    *,
    inputs: Iterable[AnyPath] = (),
    force: bool = False,
    **options: Any,  # noqa: ANN401 (as in `gather`)
) -> tuple[Outcome, pd.DataFrame]:
    """Run the missing tasks of a curve; returns the outcome and the table.

    A folder gets the journal, ``stribeck.csv`` and ``stribeck.nc``; `inputs` are files that must
    not be replaced. InputError if the folder holds another curve or something else, or is in use;
    FileError if it cannot be written.
    """
    if folder is None:
        outcome = gather(plan.tasks, plan.identity(), **options)
        return outcome, curve_table(plan, outcome.rows)
    folder, inputs = Path(folder), tuple(inputs)
    if {os.path.realpath(folder / name) for name in FILES} & set(map(os.path.realpath, inputs)):
        raise InputError(
            f"{folder}: error: this command reads a file of it\nexpected: another folder"
        )

    def write(done: Mapping[int, Row]) -> None:
        write_csv(folder / CSV, curve_table(plan, done).drop(columns=CONCLUSION))

    place = Destination(folder, "stribeck", (*JOURNAL, *FILES), inputs, force=force)
    outcome = gather(plan.tasks, plan.identity(), place, write=write, **options)
    result = curve_table(plan, outcome.rows)
    write_netcdf(folder / NETCDF, dataset(plan, result))
    return outcome, result


def dataset(plan: CurvePlan, result: pd.DataFrame) -> xr.Dataset:
    """Give a curve as a Dataset whose dimensions are the varied keys."""
    attributes, transition = {"title": "Stribeck curve of pyehl"}, {}
    if len(plan.study.keys) == 1 and (lift_off := curves_of(plan, result)[0].lift_off):
        speeds = {
            "transition_speed_m_s": lift_off.speed,
            "transition_speed_error_m_s": lift_off.error,
        }
        transition = {name: ((), value, {"units": "m/s"}) for name, value in speeds.items()}
    if plan.load_share is not None:
        attributes["empirical"] = plan.load_share.words
    columns = result.drop(columns=CONCLUSION)
    return over(plan.study, columns, units_of(plan), attributes, float).assign(transition)


def stribeck(
    case: Case | str | os.PathLike[str],
    vary: Mapping[str, Any],
    *options: Option,
    ehl: int = 0,
    surfaces: int = 1,
    boundary_friction: float | None = None,
    load_share: tuple[float, float] = AIHARA,
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    jobs: int = 0,
    scheduler: str = "",
) -> xr.Dataset:
    """Compute friction over speed, viscosity, load, temperature or slide-to-roll ratio.

    At each point the smooth contact is solved and the friction of the roughness predicted.

    Parameters
    ----------
    case
        A case in SI units, or the path of a case file.
    vary
        Values of contact.mean_velocity [m/s], lubricant.viscosity [Pa s], contact.load [N],
        contact.load_per_length [N/m], lubricant.temperature [degC], contact.slide_to_roll [-], as
        in `sweep`; the points are all combinations.
    *options
        Values that replace those of the case, as for `Case`.
    ehl
        Number of points at which the passage of the surface is solved in full.
    surfaces
        Number of surfaces at each point, with consecutive seeds from that of the case.
    boundary_friction
        Coefficient of friction of the asperities [-]: adds friction by an empirical law for thin
        films (``mu_empirical``); None: without it.
    load_share
        B and C of that law: exp(-B (h_c/sigma)^C) of the load is on asperities.
    output
        Folder for journal and table, from which an interrupted curve is resumed; None: no files
        are written.
    force
        Accept other files in that folder; they stay.
    jobs
        Worker processes; 0: as many as processors.
    scheduler
        Address of a dask scheduler (extra ``cluster``), whose workers are used instead.

    Returns
    -------
    xarray.Dataset
        Its dimensions are the varied keys, named as in `sweep`; columns as in ``stribeck.csv``
        with units, NaN for a missing number; ``status`` of each point.

    Raises
    ------
    InputError
        If any case is not acceptable (nothing runs then), or `output` holds something else.
    FileError
        If `output` cannot be written.
    KeyboardInterrupt
        If it was interrupted; `output` has all finished tasks.

    Examples
    --------
    >>> import pyehl
    >>> speeds = {"contact.mean_velocity": [0.6, 1.2]}
    >>> ds = pyehl.stribeck("cases/table1.nml", speeds, {"grid.points": 129}, jobs=1)
    >>> ds.mu_ratio.dims, ds.status.values.tolist()
    (('mean_velocity',), ['full film', 'full film'])
    >>> bool(ds.h_c_m[0] < ds.h_c_m[1]), ds.h_c_m.attrs["units"]
    (True, 'm')
    """
    for name, count in (("ehl", ehl), ("surfaces", surfaces)):
        check_kind(count, int, name, "a whole number")
    check_jobs(jobs)
    law = None if boundary_friction is None else LoadShare(boundary_friction, *load_share)
    plan = plan_curve(
        case,
        curve_axes(vary),
        options=options_of(options),
        ehl=ehl,
        seeds=surfaces,
        load_share=law,
    )
    outcome, result = perform(
        plan,
        None if output is None else path_of(output, "output"),
        inputs=() if isinstance(case, Case) else (path_of(case, "case"),),
        force=force,
        jobs=jobs,
        scheduler=scheduler,
    )
    if outcome.interrupted:
        raise KeyboardInterrupt
    return dataset(plan, result)
