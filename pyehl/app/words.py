# SPDX-License-Identifier: BSD-3-Clause
"""Texts of the page: numbers with errors, formulas beside them, Python lines."""

import json
import math
from collections.abc import Mapping
from pathlib import Path

from pyehl import namelist
from pyehl.app.answers import Film, Rough
from pyehl.app.position import Position
from pyehl.display import with_error
from pyehl.theory.moes_film import regime

NM = 1e9
# Film ratios below which a film is thinner than the roughness, and from which it is thick
THIN, THICK = 1.0, 3.0


def status_line(result: Film) -> str:
    """Describe the solution that is shown."""
    grid = _grid(result)
    if not result.converged:
        return f"No solution on {grid} nodes: the status is '{result.summary['status']}'."
    return f"Converged on {grid} nodes."


def _grid(result: Film) -> str:
    s = result.summary
    return f"{s['points']} × {s.get('points_y', s['points'])}"


def film_rows(result: Film) -> list[tuple[str, str]]:
    """Give names and values of the smooth contact."""
    point, s = result.point, result.summary
    rows = [
        ("Moes load M", f"{point.moes_m:.4g}"),
        ("Moes material L", f"{point.moes_l:.4g}"),
        ("Hertz pressure p_h", f"{point.hertz_pressure * 1e-9:.4g} GPa"),
    ]
    if point.radius_ratio == 1.0:
        rows.append(("contact radius a", f"{point.hertz_radius * 1e6:.4g} µm"))
    else:
        both = f"{point.hertz_radius * 1e6:.4g} × {point.semi_axis_y * 1e6:.4g} µm"
        angle = float(s.get("angle_deg") or 0.0)
        if angle:
            rows.append(("semi-axes", f"{both}, rotated by {angle:g}° against the motion"))
        else:
            rows.append(("semi-axes, along × across", both))
    rows.append(("regime", regime(point.moes_m, point.moes_l, point.ellipse)))
    for small, big in (("h_c", "H_c"), ("h_min", "H_min")):
        rows.append((small, _film(s, small, big, point.film_scale, converged=result.converged)))
    for formula in result.sheet["formulas"]:
        if not formula["applies"]:
            continue
        h_min = formula["h_min_m"]
        text = f"h_c {formula['h_c_m'] * NM:.4g} nm"
        text += "" if h_min is None else f", h_min {h_min * NM:.4g} nm"
        rows.append(
            (formula["name"], text + (" (outside its range)" if formula["outside"] else ""))
        )
    if result.converged:
        rows.append(("maximum pressure", f"{s['p_max_Pa'] * 1e-9:.4g} GPa"))
        if s.get("mu_smooth") is not None:
            mu = f"{s['mu_smooth']:.4f} on {_grid(result)} nodes"
            rows.append(("friction μ_s, smooth", mu))
    return rows


def _film(s: Mapping[str, float], small: str, big: str, scale: float, *, converged: bool) -> str:
    if not converged:
        return "no solution"
    error = s[f"{big}_error"]
    if error is None:
        return with_error(s[f"{small}_m"] * NM, None, "nm")
    return f"{with_error(s[f'{small}_m'] * NM, error * scale * NM, 'nm')} (grid)"


def rough_rows(result: Rough, film: Film | None = None) -> list[tuple[str, str]]:
    """Give names and values of the rough contact; `film` is the smooth contact that is shown."""
    p = result.prediction
    if p is None:
        return [("no prediction", result.why)]
    s = p.summary
    rows = []
    if p.friction.status == "predicted" and not math.isfinite(p.mu_ratio):
        rows.append(("μ_r/μ_s", f"not known: {p.why_no_error}"))
    elif p.friction.status == "predicted":
        if math.isfinite(p.tracks[0]):
            name = f"μ_r/μ_s, mean and scatter of {p.track_count} tracks"
            rows.append((name, with_error(*p.tracks)))
        known = math.isfinite(p.model_error)
        track = with_error(p.mu_ratio, p.model_error if known else None)
        rows.append(("μ_r/μ_s of one track", f"{track} (model)" if known else track))
        rows.append(("over the passage", f"{s['mu_ratio_min']:.4g} … {s['mu_ratio_max']:.4g}"))
        if not known:
            rows.append(("error of the model", "not known"))
    else:
        rows.append(("no prediction", f"{p.friction.status}: {p.friction.message}"))
    if s["mu"] is not None:
        # on the grid of the prediction, not that of the film shown above
        of = (
            f"; smooth {s['mu_smooth']:.4f}, {s['h_c_source']}"
            if s["mu_smooth"] is not None
            else ""
        )
        rows.append(("friction μ", f"{s['mu']:.4f}{of}"))
    if p.outside_range:
        rows.append(("outside of the range", ", ".join(p.outside_range)))
    # the film shown above, whose grid differs from that of the prediction
    h_min = film.summary["h_min_m"] if film is not None and film.converged else s["h_min_m"]
    sigma = s["rms_height_m"]
    if h_min is not None and sigma > 0.0:
        rows.append(("film ratio Λ = h_min/σ", f"{h_min / sigma:.4g}: {_lambda(h_min / sigma)}"))
    rows.append(("rms height σ", f"{sigma * NM:.4g} nm"))
    rows.append(("rms in the contact", f"{s['rms_deformed_m'] * NM:.4g} nm"))
    if p.friction.status == "predicted" and s["h_min_rough_m"] is not None:
        rows.append(("minimum rough film", f"{s['h_min_rough_m'] * NM:.4g} nm"))
    if p.advice is not None:
        rows += [("suggested cut-off", line) for line in p.advice.report()]
    return rows


def _lambda(ratio: float) -> str:
    if ratio < THIN:
        return "thinner than the roughness, which the contact flattens"
    return "thick film" if ratio >= THICK else "film of the order of the roughness"


def python_lines(position: Position, points: int) -> str:
    """Give the lines that compute the same numbers."""
    text = namelist.given(position.case(points).text)
    groups = namelist.values(text)
    if position.file:
        groups["surface"]["file"] = Path(position.file).name
    inner = []
    for group, keys in groups.items():
        items = "".join(f"        {_quoted(key)}: {_quoted(v)},\n" for key, v in keys.items())
        inner.append(f"    {group}={{\n{items}    }},\n")
    smooth = ', "surface.kind=smooth"' if position.rough else ""
    lines = [
        "import pyehl",
        "",
        f"case = pyehl.Case(\n{''.join(inner)})",
        f"ds = pyehl.solve(case{smooth})",
        "print(float(ds.h_c_m), float(ds.h_min_m))",
    ]
    if position.rough:
        lines += ["p = pyehl.predict(case)", "print(p.mu_ratio, p.model_error)"]
    return "\n".join(lines) + "\n"


def _quoted(value: bool | int | float | str) -> str:
    """Write a value as in Python, texts in double quotes."""
    return json.dumps(value) if isinstance(value, str) else repr(value)
