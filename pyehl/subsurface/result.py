# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl.stress``: stress below the surface as a labelled Dataset, as a folder, and as text."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from pyehl import blas
from pyehl.destination import Destination, write_json
from pyehl.errors import InputError
from pyehl.given import path_of
from pyehl.netcdf import write_netcdf
from pyehl.results import load
from pyehl.schema import VERSION
from pyehl.subsurface.cycle import Fatigue, a_iso, incomplete, kappa_of, over_depth
from pyehl.subsurface.half_space import COMPONENTS
from pyehl.subsurface.loads import Loads, loads_of, predicted_loads
from pyehl.subsurface.passage import Peak, Profile, largest, near_surface, profile
from pyehl.subsurface.traction import check_friction

if TYPE_CHECKING:
    from pyehl.prediction.result import Prediction


NOTES = "surface_note", "cycle_note"


def text(data: xr.Dataset) -> str:
    """Return the lines that ``pyehl stress`` prints."""
    return "\n".join(f"{name:10} {words}" for name, words in facts(data))


def facts(data: xr.Dataset) -> list[tuple[str, str]]:
    """Return name and text of each result."""
    si = "principal_shear_max_Pa" in data
    unit, length = ("MPa", "um") if si else ("p_h", "a")

    def stress_of(name: str) -> float:
        return float(data[f"{name}_Pa"]) * 1e-6 if si else float(data[name])

    def length_of(name: str) -> float:
        return float(data[f"{name}_m"]) * 1e6 if si else float(data[name])

    def quantity(name: str, end: str = "") -> str:
        depth = length_of(f"{name}{end}_depth")
        return f"{stress_of(name + end):.4g} {unit} at a depth of {depth:.3g} {length}"

    def percent(name: str, over: str) -> str:
        return f"{100.0 * float(data[name]) / float(data[over]):.2g} %"

    body = f"Poisson ratio {data.attrs['poisson']:g}; {data.attrs['friction_note']}"
    error = percent("principal_shear_max_error", "principal_shear_max")
    result = [
        (f"body {data.attrs['body']}", body),
        ("shear", f"{quantity('principal_shear_max')} (principal shear, +- {error})"),
        ("von Mises", quantity("von_mises_max")),
    ]
    if "ratio_to_smooth" in data:
        words = f"{quantity('principal_shear_max', '_smooth')}; rough over smooth "
        words += f"{float(data.ratio_to_smooth):.3f}; {data.attrs['instants']} instants"
        result.append(("smooth", words))
    layer = f"the layer down to {length_of('near_surface_depth'):.3g} {length}"
    words = f"{stress_of('near_surface_shear'):.4g} {unit} in {layer}"
    if "near_surface_shear_error" in data:
        at_edge, inner = (
            percent(f"{name}_error", name)
            for name in ("near_surface_shear", "near_surface_shear_inner")
        )
        words += f", +- {at_edge} ({inner} within 0.6 semi-axes)"
    result.append(("near", words))
    if "near_surface_share" in data:
        words = (
            f"{100.0 * float(data.near_surface_share):.3g} % of {layer} is above the given shear"
        )
        if "near_surface_share_smooth" in data:
            words += f" (smooth: {100.0 * float(data.near_surface_share_smooth):.3g} %)"
        result.append(("above", words))
    if "shear_amplitude" in data:
        k = int(data.shear_amplitude.values.argmax())
        row = data.isel(Z=k)
        depth = float(row.z_m) * 1e6 if si else float(row.Z)
        amplitude = float(row.shear_amplitude_Pa) * 1e-6 if si else float(row.shear_amplitude)
        words = f"{amplitude:.4g} {unit} of the deviator over the passage, at {depth:.3g} {length}"
        result.append(("amplitude", words))
    result += [("note", data.attrs[name]) for name in NOTES if name in data.attrs]
    if "fatigue_stress_Pa" in data:
        words = f"{float(data.fatigue_stress_Pa) * 1e-6:.4g} MPa, "
        words += f"{float(data.fatigue_ratio):.3f} of the fatigue limit in torsion"
        result.append(("fatigue", words))
    if "kappa" in data:
        words = f"{float(data.kappa):.3g} by Lambda^1.3 (ISO 281, for comparison)"
        result.append(("kappa", words))
    if "a_iso" in data:
        factor = float(data.a_iso)
        known = f"{factor:.3g}" if math.isfinite(factor) else "not defined below kappa = 0.1"
        result.append(("a_ISO", known))
    return result


# Minimum number of depths of a profile
MIN_DEPTHS = 4
STEEP = "not at depth 0: the traction ends in a step, where the stress at the surface is not finite"
FILES = ("case.nml", "summary.json", "stress.nc", "section.png", "depth.png")


@blas.one_thread()
def stress(
    results: xr.Dataset | Prediction | str | os.PathLike[str],
    *,
    body: int | None = None,
    friction: str | float = "run",
    above: float | None = None,
    near: float | None = None,
    depths: Sequence[float] | None = None,
    fatigue: str | None = None,
    torsion_limit: float | None = None,
    bending_limit: float | None = None,
    contamination: float | None = None,
    bearing: str = "ball",
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    progress: bool = False,
) -> xr.Dataset:
    """Compute the stress below the surface of a solid under a result.

    For a smooth contact the steady stress; for a rough one also the largest over the frames of its
    run, or that at its end if it has no frames (``output.frame_interval``).

    Parameters
    ----------
    results
        What `solve`, `predict` or `load` returns, or a result folder of a solution or prediction.
    body
        1 or 2; default: the one with the surface of the case.
    friction
        'run': shear traction by the shear law of the oil, scaled to the friction of the result;
        none if that has no coefficient. 'none': no friction. Or a coefficient of friction, traction
        over pressure.
    above
        Principal shear stress [Pa] for the fraction of the near-surface volume that exceeds it.
    near
        Depth of the near-surface volume under the dry contact [m]; default: a quarter of the depth
        of the largest shear of the smooth contact.
    depths
        Depths of the profile [m], ascending, four or more; None: from the waves of the pressure.
    fatigue
        'dang-van' or 'crossland', with `torsion_limit` and `bending_limit`, the fatigue limits of
        the material in fully reversed torsion and bending [Pa].
    contamination
        e_C C_u/P [-] for a_ISO of a `bearing`, 'ball' or 'roller' (ISO 281), with the Lambda of the
        rough contact.
    output
        Result folder; None: nothing is kept on disk.
    force
        Other files may be in the folder; they stay.
    progress
        Show a bar on standard error.

    Returns
    -------
    xarray.Dataset
        Over depth (Z [a], z_m [m]): ``principal_shear``, ``von_mises``, ``octahedral_shear``,
        ``hydrostatic``, each the largest over x, y and time [p_h], with ``..._Pa``; the same for
        the smooth contact with ``_smooth``. On y = 0 over x and depth: ``sigma_xx`` to ``sigma_yz``
        [p_h], tension positive, z into the solid, at the instant of the largest shear, and
        ``section_shear``, the principal shear, largest over time. Scalars: ``principal_shear_max``
        with depth, x, y, time and error. Names with _Pa, _m and _s exist if the case is in SI.

    Raises
    ------
    InputError
        If `results` is no solution with fields or prediction, or an option is invalid.
    FileError
        If the folder cannot be written.

    Examples
    --------
    >>> import pyehl
    >>> ds = pyehl.solve("cases/quick.nml", {"grid.points": 65})
    >>> below = pyehl.stress(ds)
    >>> round(float(below.principal_shear_max), 2)
    0.31
    """
    check_friction(friction)
    _check_depths(depths)
    criterion = _criterion(fatigue, torsion_limit, bending_limit)
    for name, value in (("above", above), ("near", near), ("contamination", contamination)):
        if value is not None and not (math.isfinite(value) and value > 0.0):
            raise InputError(f"{name} = {value!r}: expected a number > 0")
    if contamination is not None:
        a_iso(1.0, contamination, bearing)
    place = None
    if output is not None:
        inputs = (results,) if isinstance(results, str | os.PathLike) else ()
        place = Destination(path_of(output, "output"), "stress", FILES, inputs, force=force)
        place.check()
    loads, summary = _loads(results, body, friction)
    case = str(summary.attrs["case"])
    si = loads.operating.si
    if not si and (above or near or criterion or depths):
        raise InputError("above, near, depths, fatigue are in SI units: give the case in SI units")
    partial = incomplete(loads)
    if criterion and partial:
        raise InputError(f"fatigue = {fatigue!r}: {partial}")
    p_h, a = loads.operating.hertz_pressure, loads.operating.hertz_radius
    result = profile(
        loads,
        above=None if above is None else above / p_h,
        fatigue=criterion,
        at=None if depths is None else np.array(depths) / a,
        progress=progress,
    )
    data = _dataset(loads, result)
    predicted = summary.attrs.get("kind") == "prediction"
    scalars = near_surface(result, near and near / a, above, predicted=predicted)
    for name, value, unit, meaning in scalars:
        _add(data, loads, name, value, unit, meaning)
    if "near_surface_shear_error" in data:
        # the largest shear may lie in the layer: include the error there
        highest = float(data.near_surface_shear + data.near_surface_shear_error)
        name, words = "principal_shear_max_error", "; near-surface layer of a prediction"
        error = max(float(data[name]), highest - float(data.principal_shear_max))
        _add(data, loads, name, error, "Pa", f"{data[name].long_name}{words}")
    if criterion:
        rows = result.rows
        equivalent = max(row.fatigue for row in rows) * p_h
        data["fatigue_stress_Pa"] = _scalar(equivalent, "Pa", f"{fatigue}, equivalent stress")
        ratio = equivalent / criterion.torsion_limit
        meaning = "equivalent stress over the fatigue limit in torsion"
        data["fatigue_ratio"] = _scalar(ratio, "1", meaning)
    _add_life(data, summary, contamination, bearing)
    data.attrs |= {
        "kind": "stress",
        "schema_version": VERSION,
        "body": loads.body,
        "poisson": loads.poisson,
        "friction_note": loads.friction_note,
        "instants": int(loads.times.size) or 1,
        "short_side": loads.short_side,
        "case": case,
    }
    notes = {
        "cycle_note": partial,
        "surface_note": STEEP if result.rows[0].depth > (depths[0] if depths else 0.0) / a else "",
    }
    data.attrs |= {name: words for name, words in notes.items() if words}
    if place is not None:
        _write(data, place)
    return data


def _check_depths(given: Sequence[float] | None) -> None:
    """Raise InputError if depths are negative, not ascending, or too few."""
    if given is None:
        return
    result = np.array(given, dtype=float)
    right = result.ndim == 1 and result.size >= MIN_DEPTHS and np.isfinite(result).all()
    if not right or result[0] < 0.0 or (np.diff(result) <= 0.0).any():
        raise InputError(f"depths = {given!r}: expected {MIN_DEPTHS} or more ascending depths [m]")


def _criterion(name: str | None, torsion: float | None, bending: float | None) -> Fatigue | None:
    if name is None:
        if torsion is not None or bending is not None:
            raise InputError(
                "torsion_limit and bending_limit belong to fatigue, which is not given"
            )
        return None
    if torsion is None or bending is None:
        raise InputError(
            f"fatigue = {name!r}: expected torsion_limit and bending_limit, the fatigue limits of "
            "the material [Pa]"
        )
    return Fatigue(name, torsion, bending)


def _loads(
    results: xr.Dataset | Prediction | str | os.PathLike[str],
    body: int | None,
    friction: str | float,
) -> tuple[Loads, xr.Dataset]:
    data = getattr(results, "data", results) if not isinstance(results, xr.Dataset) else results
    if isinstance(data, str | bytes | os.PathLike):
        data = load(path_of(data, "results"))
    if not isinstance(data, xr.Dataset) or "case" not in data.attrs:
        raise InputError(
            f"results of type {type(results).__name__}: expected a result of solve, predict or "
            "load, or a result folder"
        )
    if data.attrs.get("kind") == "prediction":
        return predicted_loads(data, body=body, friction=friction), data
    return loads_of(data, body=body, friction=friction), data


def _scalar(value: float, unit: str, meaning: str) -> xr.Variable:
    return xr.Variable((), value, {"units": unit, "long_name": meaning})


def _add(data: xr.Dataset, loads: Loads, name: str, value: float, unit: str, meaning: str) -> None:
    """Add a scalar in Hertz units and, if the case has SI values, in an SI unit; '1' for none."""
    data[name] = _scalar(value, "1", meaning)
    if loads.operating.si and unit != "1":
        scales = {"Pa": "hertz_pressure", "m": "hertz_radius", "s": "time_scale"}
        value *= float(getattr(loads.operating, scales[unit]))
        data[f"{name}_{unit}"] = _scalar(value, unit, meaning)


def _dataset(loads: Loads, result: Profile) -> xr.Dataset:
    """Return profiles, section and peaks in Hertz units and in SI units."""
    point = loads.operating
    p_h, a = point.hertz_pressure, point.hertz_radius
    z = np.array([row.depth for row in result.rows])
    data = xr.Dataset(
        coords={
            "X": ("X", loads.x, {"units": "1", "long_name": "along the motion, x/a"}),
            "Z": ("Z", z, {"units": "1", "long_name": "depth, z/a"}),
        }
    )
    if point.si:
        data = data.assign_coords(
            x_m=("X", loads.x * a, {"units": "m", "long_name": "along the motion"}),
            z_m=("Z", z * a, {"units": "m", "long_name": "depth"}),
        )

    def add(name: str, dims: tuple[str, ...], values: Any, meaning: str) -> None:  # noqa: ANN401
        data[name] = (dims, values, {"units": "1", "long_name": f"{meaning}, over p_h"})
        if point.si:
            data[f"{name}_Pa"] = (dims, values * p_h, {"units": "Pa", "long_name": meaning})

    for rows, end in ((result.rows, ""), (result.smooth if result.rough else [], "_smooth")):
        if not rows:
            continue
        of = " of the smooth contact" if end else ""
        shear = np.array([row.shear.value for row in rows])
        mises = np.array([row.mises.value for row in rows])
        tension = np.array([row.tension for row in rows])
        add(f"principal_shear{end}", ("Z",), shear, f"largest principal shear stress{of}")
        add(f"von_mises{end}", ("Z",), mises, f"largest von Mises stress{of}")
        octahedral = math.sqrt(2.0) / 3.0 * mises
        add(f"octahedral_shear{end}", ("Z",), octahedral, f"largest octahedral shear stress{of}")
        add(f"hydrostatic{end}", ("Z",), tension, f"largest hydrostatic stress{of}")
        _add_peak(data, loads, f"principal_shear_max{end}", *largest(rows))
        _add_peak(data, loads, f"von_mises_max{end}", *largest(rows, "mises"))
        cycles = [row.cycle for row in rows if row.cycle]
        if cycles:
            for name, values, meaning in over_depth(cycles):
                add(f"{name}{end}", ("Z",), values, f"{meaning}{of}")
    images = max(row.error for row in result.rows)
    pressure = loads.pressure_error
    error = images + (pressure * float(data.principal_shear_max) if pressure > 0.0 else 0.0)
    of = "periodic images" + (" and pressure" if pressure > 0.0 else "; pressure: not known")
    add("principal_shear_max_error", (), error, f"estimate of its error: {of}")
    if result.rough:
        ratio = float(data.principal_shear_max) / float(data.principal_shear_max_smooth)
        data["ratio_to_smooth"] = _scalar(
            ratio, "1", "largest shear over that of the smooth contact"
        )
    section = np.stack([row.section for row in result.rows if row.section is not None], axis=1)
    add("section_shear", ("X", "Z"), section, "principal shear on y = 0, largest over time")
    for k, name in enumerate(COMPONENTS):
        meaning = f"{name} on y = 0 when the shear is largest"
        add(f"sigma_{name}", ("X", "Z"), result.components[k], meaning)
    return data


def _add_peak(
    data: xr.Dataset, loads: Loads, name: str, value: float, depth: float, peak: Peak
) -> None:
    rows = [("", value, "Pa", "largest value")]
    rows += [
        (f"_{axis}", v, "m", f"{axis} of the largest value")
        for axis, v in zip(("depth", "x", "y"), (depth, peak.x, peak.y), strict=True)
    ]
    if math.isfinite(peak.time):
        rows.append(("_time", peak.time, "s", "time of the largest value"))
    for end, number, unit, meaning in rows:
        _add(data, loads, f"{name}{end}", number, unit, meaning)


def _add_life(
    data: xr.Dataset, summary: xr.Dataset, contamination: float | None, bearing: str
) -> None:
    """Add kappa and a_ISO from Lambda; InputError if a_ISO is requested without Lambda."""
    ratio = float(summary["lambda_ratio"]) if "lambda_ratio" in summary else math.nan
    if not math.isfinite(ratio):
        if contamination is not None:
            raise InputError("contamination: a_ISO needs Lambda, which a rough contact has")
        return
    kappa = kappa_of(ratio)
    data["kappa"] = _scalar(kappa, "1", "Lambda^1.3, for comparison with ISO 281")
    if contamination is not None:
        factor = a_iso(kappa, contamination, bearing)
        meaning = f"life modification factor of ISO 281, radial {bearing} bearing, for comparison"
        data["a_iso"] = _scalar(factor, "1", meaning)


def _write(data: xr.Dataset, place: Destination) -> None:
    """Write the folder: summary.json, stress.nc, pictures."""
    from pyehl.plots.style import save  # noqa: PLC0415 (matplotlib is slow to import)
    from pyehl.plots.subsurface import stress_figures  # noqa: PLC0415

    with place.fresh() as folder:
        write_netcdf(folder / "stress.nc", data.transpose(*reversed(list(data.dims))))
        for name, figure in stress_figures(data).items():
            save(figure, folder / f"{name}.png")
        (folder / "case.nml").write_text(data.attrs["case"].rstrip() + "\n", encoding="utf-8")
        write_json(folder / "summary.json", summary_of(data, folder))


def summary_of(data: xr.Dataset, folder: Path) -> dict[str, Any]:
    """Return attributes and scalars, for summary.json."""
    scalars = {str(k): float(v) for k, v in data.data_vars.items() if v.ndim == 0}
    known = {k: v for k, v in scalars.items() if math.isfinite(v)}
    files = sorted(["summary.json", *(path.name for path in folder.iterdir())])
    words = {k: v for k, v in data.attrs.items() if k != "case"}
    return {**words, **known, "files": files}
