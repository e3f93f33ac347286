# SPDX-License-Identifier: BSD-3-Clause
"""Figure 6: the roughness deformed in the contact, by simulation and by two predictions."""

from dataclasses import dataclass

import numpy as np
import pictures
from conditions import SEED, deformed_run, tile
from piece import Check, Finding, Level, References, Result
from runs import Made, Runs

from pyehl import results
from pyehl.contact.smooth import solve_contact, zone_of
from pyehl.theory.amplitude import component_amplitude_ratio
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_base, inlet_fit
from pyehl.theory.transport import INLET, Zone, transport
from pyehl.types import Array, Complex, Mask

NAME = "figure 6"
TITLE = "Deformed roughness by simulation and by prediction"
# Radius of the zone of high pressure, and radius within which nearly all friction arises [a]
RADIUS = 0.85
FRICTION = 0.6
# Lines Y at which the inlet is computed [a]; between them it is interpolated
LINES = np.linspace(-0.9, 0.9, 9)


@dataclass(frozen=True, slots=True)
class Deformed:
    """Fields on the nodes around the contact, (nx, ny) [m]."""

    # Coordinates [a], (nx,) and (ny,)
    x: Array
    y: Array
    # Roughness before, and deformed: by simulation, by our prediction, by the paper's model
    undeformed: Array
    simulated: Array
    response: Array
    paper: Array
    # Rms difference of the roughness computed here from that of the solver, over its rms
    at_node: float
    made: Made

    @property
    def inside(self) -> Mask:
        """Nodes of the zone of high pressure."""
        return np.asarray(np.hypot(self.x[:, None], self.y[None, :]) <= RADIUS)


def run(runs: Runs, level: Level) -> Deformed:
    """Simulate the surface, and predict its deformed roughness at the same instant."""
    made = deformed_run(runs, level)
    made.solved(0)
    data = results.load(made.kept[0])
    settings = results.settings_of(data)
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    surface, _ = tile(SEED)
    near_x = np.abs(data.X.values) <= 1.0
    near_y = np.abs(data.Y.values) <= 1.0
    x, y = data.X.values[near_x], data.Y.values[near_y]
    scale = point.film_scale
    fields = [data[name].values[np.ix_(near_x, near_y)] * scale for name in ("RR", "A_d")]
    velocity = float(settings["surface"]["velocity_ratio"])
    origin = float(settings["surface"]["x_start"]) + velocity * float(data.attrs["T"])
    values = np.fft.fft2(surface.heights, norm="forward")
    values[0, 0] = 0.0
    mesh = float(data.X.values[1] - data.X.values[0])
    lengths = surface.length_x / point.hertz_radius, surface.length_y / point.hertz_radius
    qx, qy = (
        np.asarray(2.0 * np.pi * np.fft.fftfreq(n, length / n), dtype=np.float64)
        for n, length in zip(surface.shape, lengths, strict=True)
    )
    # as in the solver, waves of two mesh sizes or less are omitted, in space and in time
    values[np.abs(qx) * max(velocity, 1.0) * mesh >= np.pi] = 0.0
    values[:, np.abs(qy) * mesh >= np.pi] = 0.0
    waves = _Waves(values, qx, qy, x - origin, y)
    paper = waves.field(
        component_amplitude_ratio(qx[:, None], qy[None, :], 1.0, point.moes_m, point.moes_l).astype(
            complex
        )
    )
    zone = zone_of(solve_contact(settings), point, oil)
    lines = _response(waves, zone, point, velocity, x)
    place = (np.clip(y, LINES[0], LINES[-1]) - LINES[0]) / (LINES[1] - LINES[0])
    low = np.minimum(place.astype(int), LINES.size - 2)
    weight = place - low
    columns = np.arange(y.size)
    response = (1.0 - weight) * lines[low, :, columns].T + weight * lines[low + 1, :, columns].T
    whole = waves.field(np.ones(values.shape, complex))
    difference = float(np.std(whole - fields[0]) / np.std(fields[0]))
    return Deformed(x, y, fields[0], fields[1], response, paper, difference, made)


@dataclass(frozen=True, slots=True)
class _Waves:
    """Fourier components of a tile, and the coordinates of its field: x from its origin, y [a]."""

    values: Complex
    qx: Array
    qy: Array
    x: Array
    y: Array

    def field(self, factor: Complex) -> Array:
        """Real field (nx, ny) of the components times a factor of each."""
        along = np.exp(1j * np.outer(self.x, self.qx))
        across = np.exp(1j * np.outer(self.qy, self.y))
        return np.asarray((along @ (self.values * factor) @ across).real)


def _response(waves: _Waves, zone: Zone, point: OperatingPoint, velocity: float, x: Array) -> Array:
    """Fields (lines, nx, ny) with the responses of strips at `LINES`."""
    half = waves.qx >= 0.0
    kx, ky = np.meshgrid(waves.qx[half], waves.qy, indexing="ij")
    shape = kx.shape
    chosen, back = np.unique(np.clip(x, INLET + 0.01, 0.99), return_inverse=True)
    parts = transport(zone, kx.ravel(), ky.ravel(), velocity, chosen)
    moes = point.moes_m, point.moes_l
    base = inlet_base(zone, kx, ky, moes, velocity)
    inlets = [
        base
        * inlet_fit(kx, ky, moes, velocity, offset)
        * np.exp(1j * kx * (velocity - 1.0) * np.sqrt(1.0 - offset * offset))
        for offset in LINES
    ]
    # twice: the conjugates with qx < 0 contribute as much to a real field
    weight = np.where(kx == 0.0, 1.0, 2.0) * waves.values[half]
    across = np.exp(1j * np.outer(waves.qy, waves.y))
    out = np.empty((LINES.size, x.size, waves.y.size))
    for i in range(x.size):
        driven, free = (part.reshape(shape) for part in parts[back[i]])
        here = weight * np.exp(1j * waves.qx[half] * waves.x[i])[:, None]
        convected = free * np.exp(1j * waves.qx[half] * (velocity - 1.0) * x[i])[:, None]
        for k, inlet in enumerate(inlets):
            out[k, i] = ((here * (driven + convected * inlet)).sum(axis=0) @ across).real
    return out


def _agreement(ours: Array, simulated: Array) -> tuple[float, float]:
    """Correlation with the simulation, and rms over that of the simulation."""
    return float(np.corrcoef(ours, simulated)[0, 1]), float(np.std(ours) / np.std(simulated))


def show(data: Deformed, references: References, level: Level) -> Result:
    """Draw all fields on one scale with their height distributions."""
    inside = data.inside
    fields = {
        "undeformed": data.undeformed,
        "simulation": data.simulated,
        "our prediction": data.response,
        "paper's prediction": data.paper,
    }
    centred = {name: field - field[inside].mean() for name, field in fields.items()}
    rows = [
        (data.x[i], data.y[j], *(float(field[i, j]) for field in fields.values()))
        for i, j in np.argwhere(inside)
    ]
    core = np.hypot(data.x[:, None], data.y[None, :]) <= FRICTION
    ours, theirs = (
        _agreement(field[core], data.simulated[core]) for field in (data.response, data.paper)
    )
    before, after = (float(np.abs(centred[n][inside]).max()) for n in ("undeformed", "simulation"))
    checks = [
        Check(
            f"correlation of our prediction with the simulation, r <= {FRICTION:g} a",
            ours[0], 1.0, 0.05,
            "0.95 or more", "simulation of this surface",
        ),
        Check(
            f"rms of our prediction over that of the simulation, r <= {FRICTION:g} a",
            ours[1], 1.0, None,
            "the response is that of fine grids", "simulation of this surface",
        ),
        Check.of("largest height, undeformed", before, references["fig6.largest"]),
        Check.of("largest height, deformed, by simulation", after,
                 references["fig6.largest_deformed"]),
    ]  # fmt: skip
    caption = (
        "Roughness before, by simulation, by our prediction and by that of the paper, on one "
        "scale; below, height distributions and the centre line."
    )
    return Result(
        checks,
        (("X", "Y", "undeformed_m", "simulated_m", "response_m", "paper_m"), rows),
        pictures.deformed(data.x, data.y, inside, centred),
        caption,
        *_notes_and_findings(data, ours, theirs),
        [data.made],
    )


def _notes_and_findings(
    data: Deformed, ours: tuple[float, float], theirs: tuple[float, float]
) -> tuple[list[str], list[Finding]]:
    """Describe the agreement, and the deviation of the model of the paper."""
    ours_wide, theirs_wide = (
        _agreement(field[data.inside], data.simulated[data.inside])
        for field in (data.response, data.paper)
    )
    notes = [
        f"Heights about their mean. Correlation with the simulation inside r <= {FRICTION:g} a, "
        f"where nearly all friction arises: our prediction {ours[0]:.3f}, the paper's model "
        f"{theirs[0]:.3f}; rms over that of the simulation {ours[1]:.3f} and {theirs[1]:.3f}. "
        f"Inside r <= {RADIUS:g} a: {ours_wide[0]:.3f} and {theirs_wide[0]:.3f}; "
        f"{ours_wide[1]:.3f} and {theirs_wide[1]:.3f}. Towards the sides the inlet is oblique, "
        "and the response uses the normal of the edge at each line.",
        f"The roughness of the predictions agrees with that of the solver within "
        f"{100 * data.at_node:.2g} % of its rms (the solver interpolates it along X).",
    ]
    findings = [
        Finding(
            "Free waves and slip in the deformed roughness",
            "In the paper the deformed roughness moves with the rough surface. Its correlation "
            f"with the simulation is {theirs[0]:.3f}. That of our prediction, whose free waves are "
            "generated in the inlet and transported at the mean velocity, is "
            f"{ours[0]:.3f}. The paper compares only height distributions, which a shift does not "
            "change.",
        )
    ] if theirs[0] < ours[0] else []  # fmt: skip
    return notes, findings
