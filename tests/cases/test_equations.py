# SPDX-License-Identifier: BSD-3-Clause
"""The written fields solve the discrete equations, which are implemented here once more.

Everything is evaluated anew in numpy from P and H alone: deflection by the exact integral of 1/r
over a cell and scipy's FFT, viscosity, density, conductances, both time schemes. Film, residual,
load and friction of the solver must agree to rounding.
"""

from typing import Any

import numpy as np
import pytest
from far_field import far_field
from numpy.typing import NDArray
from scipy import fft

import pyehl

Array = NDArray[np.float64]

ALPHA, P_0, Z = 2.2e-8, 1.96e8, 0.6684
AMPLITUDE, WAVELENGTH, VELOCITY, START = 8.2362474e-3, 0.5, 1.01, -1.2


def deflection(pressure: Array, h: float) -> Array:
    """(2/pi^2) int int P/r, P constant around each node (Johnson 1985, eq. 3.25)."""
    n = pressure.shape[0]

    def corner(x: Array, y: Array) -> Array:
        return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))

    west = h * (np.arange(1 - n, n) - 0.5)
    x, y = np.meshgrid(west, west, indexing="ij")
    kernel = corner(x + h, y + h) - corner(x, y + h) - corner(x + h, y) + corner(x, y)
    m = fft.next_fast_len(3 * n)
    full = fft.irfft2(fft.rfft2(pressure, (m, m)) * fft.rfft2(kernel, (m, m)), (m, m))
    return 2.0 / np.pi**2 * full[n - 1 : 2 * n - 1, n - 1 : 2 * n - 1]


class State:
    """P and H of a run and the quantities that follow from them."""

    def __init__(self, run: Any) -> None:
        self.x, self.y = run.field("X"), run.field("Y")
        self.p, self.film = run.field("P"), run.field("H")
        self.h = self.x[1] - self.x[0]
        pressure = self.p * run["hertz_pressure_Pa"]
        self.eta = np.exp(ALPHA * P_0 / Z * ((1.0 + pressure / P_0) ** Z - 1.0))
        self.mass = (5.9e8 + 1.34 * pressure) / (5.9e8 + pressure) * self.film
        speed = (128.0 * np.pi**3 / (3.0 * run["moes_m"] ** 4)) ** (1.0 / 3.0)
        self.eps = self.mass * self.film**2 / (self.eta * speed)

    def rigid_separation(self, roughness: Array | float = 0.0) -> Array:
        """H - X^2/2 - Y^2/2 + RR - deflection: H00 everywhere."""
        shape = 0.5 * self.x[:, None] ** 2 + 0.5 * self.y**2
        return self.film - shape + roughness - deflection(self.p, self.h)

    def flux(self, axis: int) -> Array:
        """Poiseuille flux -eps dP/dX (axis 0) or -eps dP/dY (axis 1) between neighbours."""
        p, e = np.moveaxis(self.p, axis, 0), np.moveaxis(self.eps, axis, 0)
        return np.moveaxis(-0.5 * (e[1:] + e[:-1]) * (p[1:] - p[:-1]) / self.h, 0, axis)

    def divergence(self) -> Array:
        """Divergence of the Poiseuille flux at the interior nodes, 0 at the border."""
        values = np.zeros_like(self.p)
        values[1:-1, 1:-1] = np.diff(self.flux(0), axis=0)[:, 1:-1] / self.h
        values[1:-1, 1:-1] += np.diff(self.flux(1), axis=1)[1:-1, :] / self.h
        return values

    def couette(self) -> Array:
        """d(rho H)/dX, upstream of second order, of first in the first interior column."""
        m, values = self.mass, np.zeros_like(self.mass)
        values[2:] = (1.5 * m[2:] - 2.0 * m[1:-1] + 0.5 * m[:-2]) / self.h
        values[1] = (m[1] - m[0]) / self.h
        return values

    def residual(self, transport: Array) -> Array:
        """Divergence plus transport; where P = 0 only the part that would raise the pressure."""
        values = self.divergence() + transport
        values[[0, -1]] = 0.0
        values[:, [0, -1]] = 0.0
        values[(self.p <= 0.0) & (values > 0.0)] = 0.0
        return values


def rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def residual_bound(done: Any) -> float:
    """Largest residual (rms) of the last step, with a margin for the two steps before it."""
    last, before, earlier = done.history["residual"][:-4:-1]
    return last + 4.0 / 3.0 * before + earlier / 3.0


@pytest.mark.parametrize("engine", ["mlmi", "fft"])
@pytest.mark.parametrize(("moes_m", "points"), [(200.0, 129), (1000.0, 257)])
def test_smooth(solve, moes_m: float, points: int, engine: str):
    settings = {"lubricant.roelands_z": Z, "solver.deflection": engine}
    done = solve((moes_m, 10.0), points, settings, fields=True)
    state = State(done)
    assert state.p.min() >= 0.0
    border = np.ones_like(state.p, dtype=bool)
    border[1:-1, 1:-1] = False
    wanted = 2.0 * np.pi / 3.0
    if moes_m < 500.0:
        # those of a flooded contact by the film before the last cycle
        upper = state.y >= 0.0
        x, y = (a.ravel() for a in np.meshgrid(state.x, state.y[upper], indexing="ij"))
        expected, beyond = far_field(x, y, state.film[:, upper].ravel(), state.h)
        speed = (128.0 * np.pi**3 / (3.0 * moes_m**4)) ** (1.0 / 3.0)
        expected = speed * expected.reshape(-1, upper.sum())
        edge = border[:, upper]
        assert state.p[:, upper][edge] == pytest.approx(expected[edge], rel=2e-3)
        wanted -= speed * beyond
    else:
        assert not state.p[border].any()
    # Exact sums agree to rounding; mlmi to at most a tenth of the discretisation error of H_c
    separation = state.rigid_separation()
    exact = 1e-12 if engine == "fft" else 0.1 * done["H_c_error"]
    assert np.ptp(separation) < exact
    # each with the contribution of its own node, 8/pi^2 asinh(1) h for a square cell, relative to
    # the Poiseuille term, 4 eps/h^2
    own = 8.0 / np.pi**2 * np.arcsinh(1.0)
    share = own / (own + 4.0 * state.eps / state.h**2)
    residual = rms(share * state.residual(state.couette()))
    assert residual == pytest.approx(done["residual"], rel=1e-6)
    load = state.p.sum() * state.h**2 / wanted - 1.0
    assert load == pytest.approx(done["load_error"], abs=1e-13 if moes_m >= 500.0 else 1e-5)
    friction = (state.eta / state.film).sum() * state.h**2
    assert friction == pytest.approx(done["F"], rel=1e-12)


@pytest.fixture(
    scope="module",
    params=[
        ("narrow", 1000.0, 10.0),
        ("paper", 1000.0, 10.0),
        ("narrow", 600.0, 14.0),
        ("narrow", 700.0, 8.0),
        ("paper", 1600.0, 12.0),
    ],
    ids=lambda row: f"{row[0]}-M{row[1]:g}-L{row[2]:g}",
)
def march(run_from, tmp_path_factory, request) -> tuple[str, Any, list[State]]:
    """Three consecutive states while the front of a waviness crosses the contact, newest first."""
    scheme, moes_m, moes_l = request.param
    settings = {
        "lubricant.roelands_z": Z,
        "surface.kind": "harmonic",
        "surface.amplitude": AMPLITUDE,
        "surface.wavelength": WAVELENGTH,
        "surface.x_start": START,
        "time.scheme": scheme,
        # The balance below is a small difference of large numbers
        "solver.accuracy": 2.5e-6,
    }
    settings |= {"contact.moes_m": moes_m, "contact.moes_l": moes_l, "grid.points": 129}
    settings |= {"time.steps": 24, "time.estimate_error": False}
    folder = tmp_path_factory.mktemp("march")
    with pyehl.Solver(pyehl.Case.from_text("", settings)) as solver:
        for step in solver:
            if (steps := step.summary.get("steps", 0)) >= 22:
                solver.write(folder / str(steps))
    runs = [run_from(folder / str(steps)) for steps in (24, 23, 22)]
    return scheme, runs[0], [State(run) for run in runs]


def storage(states: list[State]) -> Array:
    """d(rho H)/dT, backward of second order with the time step h."""
    now, before, earlier = (state.mass for state in states)
    return (1.5 * now - 2.0 * before + 0.5 * earlier) / states[0].h


def test_time_step(march):
    scheme, done, states = march
    now = states[0]
    if scheme == "paper":
        transport = now.couette() + storage(states)
    else:
        m, before, earlier = (state.mass for state in states)
        transport = np.zeros_like(m)
        transport[2:] = (1.5 * m[2:] - 2.0 * before[1:-1] + 0.5 * earlier[:-2]) / now.h
        transport[1] = (m[1] - before[0]) / now.h
    assert done.history["residual"].max() <= done["step_residual_allowed"]
    assert rms(now.residual(transport)) <= (1.0 + 1e-5) * residual_bound(done)
    # The roughness is in the right place, and its peaks thin the film
    distance = now.x - (START + VELOCITY * done["T"])
    along = 10.0 ** (-10.0 * np.maximum(0.0, distance / WAVELENGTH) ** 2)
    along *= AMPLITUDE * np.cos(2.0 * np.pi * distance / WAVELENGTH)
    roughness = along[:, None] * np.cos(2.0 * np.pi * now.y / WAVELENGTH)
    # agreement of mlmi, as above
    assert np.ptp(now.rigid_separation(roughness)) < 0.1 * done["H_c_error"]
    assert np.ptp(now.rigid_separation()) > AMPLITUDE


def test_mass_balance(march):
    """Inflow into a part of the contact less outflow is stored there."""
    scheme, done, states = march
    now = states[0]
    m, before, earlier = (state.mass for state in states)
    h = now.h
    west, east = np.searchsorted(now.x, (-0.7, 0.7))
    south, north = np.searchsorted(now.y, (-0.5, 0.5))
    i, j = slice(west, east + 1), slice(south, north + 1)
    assert now.p[i, j].min() > 0.0

    def convected(k: int) -> float:
        """Couette flux between columns k and k + 1, whose differences are those of rho H."""
        if scheme == "paper":
            return (1.5 * m[k, j] - 0.5 * m[k - 1, j]).sum() * h
        # The difference along the characteristic, sorted by time, has the storage term of the other
        # scheme, and a flux of earlier times
        return (2.0 * before[k, j] - 0.5 * earlier[k, j] - 0.5 * earlier[k - 1, j]).sum() * h

    stored = storage(states)[i, j].sum() * h**2
    along, across = now.flux(0), now.flux(1)
    inflow = convected(west - 1) + along[west - 1, j].sum() * h
    outflow = convected(east) + along[east, j].sum() * h
    outflow += (across[i, north] - across[i, south - 1]).sum() * h
    # The sum of the residuals is bounded by their rms over the whole plane (Cauchy-Schwarz)
    allowed = residual_bound(done) * h**2 * np.sqrt(m[i, j].size * m.size)
    assert abs(stored + outflow - inflow) < allowed
    # which is small compared with the terms of the balance
    assert abs(stored) > 20.0 * allowed
    assert abs(outflow - inflow) > 20.0 * allowed
