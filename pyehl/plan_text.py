# SPDX-License-Identifier: BSD-3-Clause
"""The plan of a run as text: what will be solved and how, with a table of the levels."""

import math
from collections.abc import Iterator
from typing import Any

from pyehl.number_text import digits, fixed, memory, percent, power
from pyehl.reasons import REASONS, Results, alpha_note, few_positions, heat_words, law_note
from pyehl.types import Settings, Values

INDENT = " " * 11
SCHEMES = {True: "narrow upstream", False: "as in the paper"}
# Ratio of semi-axes above which the solver may restart with damped cycles (3 to 9 times as long)
LONG = 1.5
# Bytes and seconds to generate one pixel of a fractal surface
PIXEL_BYTES, PIXEL_SECONDS = 16.0, 8e-8


def plan_text(plan: Results, settings: Settings) -> str:
    """Give the plan: a few lines, names in the first 11 columns, and a table of the levels."""
    v = {**plan.values, "heat": plan.codes["heat"]}
    return "\n".join([
        *_contact(v),
        *_lubricant(v, settings),
        *_friction(v, settings),
        *_surfaces(v, settings),
        *_duty(v, settings),
        *_domain(v),
        f"deflection {v['deflection']}, threads {v['threads']}",
        _cycles(v),
        _stop(v),
        *_need(v),
        *_levels(v),
        *_too_coarse(v),
    ])  # fmt: skip


def making_text(pixels: int) -> str:
    """State memory and time to generate a fractal surface; '' if both are small."""
    count = float(pixels) ** 2
    if PIXEL_SECONDS * count < 1.0:
        return ""
    return (
        f"surface    {pixels} x {pixels} pixels take about {memory(PIXEL_BYTES * count)} of memory "
        f"and {_duration(PIXEL_SECONDS * count)} to generate"
    )


def _contact(v: Values) -> Iterator[str]:
    yield (
        f"contact    M = {digits(v['moes_m'])}, L = {digits(v['moes_l'])}, alpha p_h = "
        f"{digits(v['alpha_bar'])}, speed parameter = {power(v['speed_parameter'], 3)}"
    )
    if v["has_size"]:
        yield f"{INDENT}a = {power(v['length'], 4)} m, p_h = {power(v['pressure'], 4)} Pa"
    if v["line"]:
        yield (
            "line       M and L are those of a line, a = b is half its width; the round contact "
            f"with the same speed parameter has M = {digits(v['round_m'])}"
        )
    elif v["roller"]:
        yield (
            "roller     M, L, p_h and a = b are those of a line under the mean load per length; "
            f"length {digits(2.0 * v['y_extent'])} b"
        )
        yield _cells(v)
    elif not v["round"]:
        yield (
            "ellipse    semi-axis across the motion over a, that along it: "
            f"{digits(v['ellipticity'])}; R_x/R_y = {digits(v['radius_ratio'])}"
        )
        yield _cells(v)


def _cells(v: Values) -> str:
    return (
        f"cells      {digits(v['mesh_y'] / v['mesh_x'], 4)} times as long across the motion as "
        f"along it: {v['points']} x {v['points_y']} nodes"
    )


def _lubricant(v: Values, settings: Settings) -> Iterator[str]:
    for note in (law_note(settings, v["pressure"]), alpha_note(settings)):
        if note:
            yield f"lubricant  {note}"


def _friction(v: Values, settings: Settings) -> Iterator[str]:
    """Describe sliding, shear law, boundary film, hardness, and shear heating of the inlet."""
    flow = "the flow obeys it, too" if v["thins_flow"] else "the flow is Newtonian"
    speed = abs(v["slide_to_roll"]) * v["mean_velocity"]
    shown = f" ({power(speed, 3)} m/s)" if v["mean_velocity"] > 0.0 else ""
    yield (
        f"friction   {settings['lubricant']['shear_law']} shear stress, slide-to-roll ratio "
        f"{fixed(v['slide_to_roll'], 4)}{shown}; {flow}"
    )
    yield f"{INDENT}coefficients are {heat_words(v['heat'], v['heat_estimate_K'])}"
    if v["boundary_film"] > 0.0:
        friction = v["boundary_friction"]
        known = f"{fixed(friction, 3)} of the pressure" if friction > 0.0 else "not known"
        yield (
            f"boundary   bodies touch at a film of {power(v['boundary_film'] * v['film'], 3)} m at "
            f"ambient pressure; their friction there is {known}"
        )
    if v["inlet_in_doubt"]:
        yield INDENT + REASONS[5].format_map(v)
    if v["hardness"] > 0.0:
        yield (
            f"hardness   the solids yield at {power(v['hardness'] * v['pressure'], 3)} Pa, "
            f"{fixed(v['hardness'], 3)} p_h"
        )
    if v["thermal_loading"] > 0.0:
        yield (
            "heat       shear heating of the inlet (Gupta et al. 1992): film times "
            f"{fixed(v['thermal_reduction'], 4)} by an inlet viscosity of "
            f"{power(v['inlet_viscosity'], 3)} Pa s, from which M and L follow"
        )


def _surfaces(v: Values, settings: Settings) -> Iterator[str]:
    """Describe the surfaces, their time steps, and the waves that the grid resolves."""
    count = v["surfaces"]
    if not count:
        yield (
            "problem    smooth, in time"
            if v["duty"]
            else ("problem    smooth and steady: no time levels, no roughness")
        )
        return
    members = [_member(v, k + 1) for k in range(count)]
    for member in members:
        label = f"&{member['group']}: " if count > 1 else ""
        yield f"problem    {label}{_surface(v, member, settings)}"
    if count > 1 and v["move"] and not (v["some_stationary"] or v["pass_once"] or v["duty"]):
        yield INDENT + _common_period(v)
    if v["some_stationary"]:
        yield f"{INDENT}the smooth contact is solved first, then that with the roughness at rest"
    else:
        yield f"{INDENT}the smooth contact is solved first, once"
    if v["move"] and not v["duty"]:
        yield from _time(v)
    if v["coarse_run"]:
        yield "error      of the friction ratio: computed on the next coarser grid too"
    yield from _waves(v, members)


def _duty(v: Values, settings: Settings) -> Iterator[str]:
    """Describe the keys that change with time, the time range and the number of steps."""
    if not v["duty"]:
        return
    duty = settings["duty"]
    names = [key for key, value in duty.items() if isinstance(value, tuple) and key != "time"]
    steps = f"in about {v['duty_steps']:.0f} time steps" if v["duty_steps"] else "nothing changes"
    yield (
        f"duty       {', '.join(names)} at {len(duty['time'])} times, {duty['interpolation']}; to "
        f"{power(v['duty_end'], 4)} s: {steps}"
    )
    if not v["duty_steps"]:
        yield f"{INDENT}the steady contact is the solution at all times"
    if v["duty_begin"] < 0.0:
        yield (
            f"{INDENT}from {power(v['duty_begin'], 3)} s on the contact changes from the case to "
            "the first time"
        )
    turns = [*duty.get("mean_velocity", ()), 0.0]
    turns += [a + b for a, b in zip(duty.get("u1", ()), duty.get("u2", ()), strict=False)]
    if min(turns) < 0.0:
        yield f"{INDENT}the mean velocity reverses: an inlet on both sides, a symmetric domain"


def _member(v: Values, number: int) -> dict[str, Any]:
    prefix = f"surface_{number}_"
    return {name.removeprefix(prefix): v[name] for name in v if name.startswith(prefix)}


def _surface(v: Values, s: Values, settings: Settings) -> str:
    """Say what a surface is and how it moves."""
    still = f" at rest{'' if v['move'] else ', steady contact'}; "
    velocity = f", velocity ratio {fixed(s['velocity_ratio'], 4)}"
    start = f"X = x_start = {fixed(s['x_start'], 4)}"
    if "width" not in s:
        period = f"period {fixed(s['period'], 3)} a"
        if s["at_rest"]:
            return f"roughness{still}{period}, over the whole domain, its origin at {start}"
        return f"moving roughness, {period}{velocity}"
    kind = f"a {settings[s['group']]['kind']}"
    if s["at_rest"]:
        text = f"{kind}{still}its centre at {start}"
    else:
        arrival = (s["reach"] - s["x_start"]) / s["velocity_ratio"]
        text = f"{kind} passes once{velocity}, its centre at X = 0 at T = {fixed(arrival, 4)}"
    length = f" and {fixed(s['length'], 4)} a long" if s["length"] > 0.0 else ", without ends"
    height = ""
    if s["amplitude"] > 0.0:
        raised = settings[s["group"]]["kind"] in ("bump", "ridge")
        height = f", {power(s['amplitude'], 3)} a^2/R {'high' if raised else 'deep'}"
    size = f"{fixed(s['width'], 4)} a wide{length}{height}, at Y = {fixed(s['y_start'], 4)}"
    if s["spacing_y"] > 0.0:
        size += f", repeated along Y every {fixed(s['spacing_y'], 4)} a"
    return f"{text}\n{INDENT}{size}"


def _common_period(v: Values) -> str:
    """State the common period of both surfaces."""
    if not v["enough_positions"]:
        return few_positions(v["repeats"], v["whole_periods"])
    period = f"{fixed(v['period'], 4)} a/u"
    if v["mismatch"] > 0.0:
        return (
            f"no common period: means over {v['repeats']} periods of the slowest, {period},\n"
            f"{INDENT}after which a surface is off its start by {fixed(v['mismatch'], 4)} of a "
            "period; the error of that is part of mu_ratio_error"
        )
    return f"both repeat after {period}, {v['repeats']} periods of the slowest"


def _time(v: Values) -> Iterator[str]:
    """Describe the time steps, and the end of the run."""
    mesh = fixed(v["mesh_x"], 6)
    yield f"time       {SCHEMES[v['narrow_scheme']]}, step = mesh size = {mesh}"
    if v["predicted_start"]:
        yield "start      with the contact filled with roughness, from the predicted pressure"
    if "fallback_reason" in v:
        yield f"start      behind a front, without a prediction: {v['fallback_reason']}"
    if v["steps"] > 0:
        yield f"end        after {v['steps']} steps"
    elif v["pass_once"]:
        yield (
            "end        when the feature and the film that it formed in the inlet have left: "
            f"T = {fixed(v['end_of_passage'], 4)}"
        )
    else:
        yield (
            "end        when the mean of mu_r/mu_s over whole periods changes by less than "
            f"{power(v['time_tolerance'], 1)}"
        )


def _waves(v: Values, members: list[dict[str, Any]]) -> Iterator[str]:
    """Describe how much of the surfaces the finest grid resolves."""
    if v["has_spectrum"] and v["has_size"]:
        for member in members:
            label = f"&{member['group']}: " if len(members) > 1 else ""
            yield from _height(member, label, v["film"])
        # an amplitude relative to the film is not known yet
        if len(members) > 1 and all(member["rms_height"] > 0.0 for member in members):
            together = ""
            if v["correlation"] is not None:
                together = f"; both move together, correlation {fixed(v['correlation'], 2)}"
            slope = v["rms_slope"] * v["film"] / v["length"]
            yield (
                f"surface    composite rms height {power(v['rms_height'] * v['film'], 2)} m, rms "
                f"slope {fixed(slope, 5)}{together}"
            )
    text = (
        f"waves      with fewer than 8 nodes per period hold {_percent(v['unresolved'])} of the "
        "variance of "
    )
    if v["pass_once"] and len(members) == 1:
        yield f"{text}its profile"
    else:
        left_out = _percent(v["left_out"])
        yield f"{text}the surface; {left_out} of it, with 2 and fewer, is left out"


def _height(s: Values, label: str, film: float) -> Iterator[str]:
    """Rms height of a surface with a spectrum, also before its cut-off; `film` [m] is the scale."""
    if s["rms_height"] > 0.0:
        text = f"surface    {label}rms height {power(s['rms_height'] * film, 2)} m"
        if s["variance"] < s["variance_whole"]:
            whole = power(math.sqrt(s["variance_whole"]) * film, 2)
            text += f", of {whole} m before its spectrum was cut"
        yield text
    elif label:
        yield f"surface    {label}rms height relative to the film, which is not known yet"


def _percent(fraction: float) -> str:
    """Write a fraction of the variance in per cent."""
    if not fraction > 0.0:
        return "0 %"
    return "less than 0.01 %" if fraction < 1e-4 else percent(fraction)


def _domain(v: Values) -> Iterator[str]:
    """Describe the borders, the error due to them, and whether symmetry halves the domain."""
    error = "it is far too small for a flooded contact"
    if v["domain_error"] < 1.0:
        of = "film" if v["starved"] else "flooded film"
        error = f"its error is at most {fixed(100.0 * v['domain_error'], 2)} % of the {of}"
    inlet, outlet, side = (digits(v[name]) for name in ("x_inlet", "x_outlet", "y_extent"))
    sides = "" if v["line"] else f", |Y| <= {side}"
    yield f"domain     {inlet} <= X <= {outlet}{sides}; {error}"
    pressure = "the pressure of a fully flooded contact" if v["flooded"] else "P = 0"
    if v["starved"]:
        pressure += ", the position of the meniscus"
        if v["layer"] > 0.0:
            pressure = f"P = 0; an oil layer of {digits(v['layer'])} a^2/R"
    half = "the whole domain is solved"
    if v["mirror"]:
        half = "symmetric in Y: only Y >= 0 is solved"
    if v["line"]:
        width = v["strip_width"]
        half = f"a strip of {digits(width)} that repeats along Y" if width else "one row of nodes"
    yield f"{INDENT}at its border {pressure}; {half}"


def _cycles(v: Values) -> str:
    """Describe the cycles with their pre- and post-relaxation sweeps."""
    text = f"cycles     {v['cycle']}({v['pre']},{v['post']})"
    if v["second_is_v"]:
        text += f", the second on a finer grid V({v['second_pre']},{v['second_post']})"
    if v.get("move") or v["duty"]:
        coarsening = "Alcouffe" if v["alcouffe"] else "classical"
        text += (
            f", time steps {v['step_cycle']}({v['step_pre']},{v['step_post']}) (no pre-sweeps "
            f"where the extrapolation is accurate), {coarsening} coarsening"
        )
        if v["coarsening_may_change"]:
            text += ", Alcouffe when a cycle is slow"
    return text


def _stop(v: Values) -> str:
    if v["target_error"] > 0.0:
        wanted = power(v["target_error"], 1)
        return f"stop       at the first grid whose relative error of H_c is below {wanted}"
    return (
        f"stop       on the finest grid, algebraic error below {fixed(v['accuracy'], 2)} of the "
        f"discretisation error and {fixed(100.0 * v['max_error'], 1)} % of the film, load error "
        "below 1e-6"
    )


def _need(v: Values) -> Iterator[str]:
    """Estimate memory and time, and the number of frames."""
    text = (
        f"need       about {memory(v['bytes'])} of memory and {_duration(v['seconds'])} on one "
        "thread"
    )
    if v["ellipticity"] > LONG or v["ellipticity"] < 1.0 / LONG:
        text += ", up to ten times as long with damped cycles"
    if v["boundary_film"] > 0.0 and not v["surfaces"]:
        text += ", up to thirty times as long with solid contact"
    if v["target_error"] > 0.0:
        text += ", if it reaches the finest grid"
    if v.get("move") and not v["steps"] and not v["duty"]:
        text += ", if the mean settles at the earliest time"
    yield text
    minimum, maximum = v["frames_min"], v["frames_max"]
    if maximum > 0.0:
        every = "after every step: output.frame_interval is no longer than a step"
        if v["frame_interval"] > v["mesh_x"]:
            every = f"one in {v['frame_interval']} a/u"
        at_most = f", at most {maximum:.0f}," if maximum > minimum else ""
        yield f"frames     {every}, about {minimum:.0f}{at_most} of P and H"


def _duration(seconds: float) -> str:
    if seconds < 1.0:
        return "less than a second"
    return f"{seconds:.0f} s" if seconds < 3600.0 else f"{seconds / 3600.0:.1f} h"


def _levels(v: Values) -> Iterator[str]:
    yield "level  points    stored nodes  mesh size   use"
    points, rows = v["coarsest_points"], v["coarsest_rows"]
    mesh = (v["x_outlet"] - v["x_inlet"]) / (points - 1)
    for level in range(1, v["levels"] + 1):
        use = "correction, solved directly" if level == 1 else "correction"
        if level >= v["start_level"]:
            use = "solution"
        if level == v["start_level"]:
            use = f"solution, from the {'dry' if v['roller'] else 'Hertz'} pressure"
        yield f"{level:5d}{points:8d}{points * rows:16d}{mesh:11.6f}   {use}"
        points, mesh = 2 * points - 1, 0.5 * mesh
        rows = 2 * rows if v["strip_width"] else 2 * rows - 1


def _too_coarse(v: Values) -> Iterator[str]:
    if v["points_for_solution"] > v["points"]:
        yield "warning    " + REASONS[6].format_map(v)
