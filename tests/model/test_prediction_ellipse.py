# SPDX-License-Identifier: BSD-3-Clause
"""The prediction on elliptical contacts: stiffness, edge, circular limit, measured waves."""

import csv
import math
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from document_text import plain

import pyehl
from pyehl.contact.smooth import solve_contact, zone_of
from pyehl.errors import InputError
from pyehl.measured_response.folder import shipped_response
from pyehl.prediction.model import ModelOptions, model_error, outside_range
from pyehl.prediction.response import AXIS
from pyehl.theory.disc import RADIUS, disc_correction, monomials
from pyehl.theory.ellipse import Ellipse, ellipse
from pyehl.theory.ellipse_edge import EllipseEdge, Series
from pyehl.theory.line_contact import circle_with_same_inlet
from pyehl.theory.lubricant import Lubricant
from pyehl.theory.operating import OperatingPoint
from pyehl.theory.response import inlet_fit
from pyehl.theory.transport import LINES, free_stiffness, harmonics, line_pressure

# R_x/R_y of the ellipticities 2 and 0.4
WIDE, NARROW = 0.351771642284186, 3.998264475680259
ROUGH = {
    "surface.kind": "fractal",
    "surface.length_x": 3e-4,
    "surface.length_y": 3e-4,
    "surface.pixels": 96,
    "surface.rms_height": 2e-8,
    "surface.velocity_ratio": 1.02,
}


def corner(u, v):
    """Integral of 1/r over a rectangle from its corner (Love 1929)."""
    return u * np.arcsinh(v / np.abs(u)) + v * np.arcsinh(u / np.abs(v))


@pytest.mark.parametrize("ratio", [WIDE, pytest.param(NARROW, marks=pytest.mark.long)])
@pytest.mark.long
def test_pressure_of_waves_on_an_ellipse_against_elements(ratio):
    """Squares of constant pressure that deflect the ellipse by a wave plus a constant."""
    shape = ellipse(ratio)
    kappa = shape.ellipticity
    h = min(1.0, kappa) / (20.0 if kappa > 1.0 else 14.0)
    x, y = (np.arange(-reach + 0.5 * h, reach, h) for reach in (1.0, kappa))
    x, y = (v.ravel() for v in np.meshgrid(x, y, indexing="ij"))
    inside = np.hypot(x, y / kappa) < 1.0
    x, y = x[inside], y[inside]
    dx, dy = np.subtract.outer(x, x), np.subtract.outer(y, y)
    r = 0.5 * h
    deflection = corner(dx + r, dy + r) + corner(dx - r, dy - r)
    deflection -= corner(dx + r, dy - r) + corner(dx - r, dy + r)
    deflection *= 2.0 / math.pi**2 * shape.kernel_ratio
    qx, qy = np.array([1.5, 0.0, 2.0, 4.0]), np.array([0.0, 2.0, 1.5, 3.0])
    waves = np.exp(1j * (np.outer(x, qx) + np.outer(y, qy)))
    result = np.linalg.solve(deflection, np.column_stack([waves, np.ones(x.size)]))
    # zero load
    sums = result.sum(axis=0)
    result = result[:, :-1] - result[:, -1:] * (sums[:-1] / sums[-1])
    middle = np.hypot(x, y / kappa) < 0.7
    k = 0.25 * math.pi / shape.kernel_ratio * np.hypot(qx, qy)
    here = Series(shape, x, y / kappa, 14.0 * max(1.0, kappa)).of(qx, qy)
    assert (np.abs(here - result)[middle] / k).max() < 0.015
    # relative to that of the half-space, which is far away
    assert (np.abs(k * waves - result)[middle] / k).max() > 0.5


def test_circle_is_the_disc():
    qx, qy = np.array([1.0, 3.0, 0.0, 8.0]), np.array([0.0, 2.0, 4.0, -3.0])
    edge = EllipseEdge(Ellipse(1.0, 1.0, 1.0))
    line = np.linspace(-0.5, 0.5, 9)
    x, y = (v.ravel() for v in np.meshgrid(line, line, indexing="ij"))
    here = edge.correction(qx, qy).T @ edge.functions(x, y)
    disc = disc_correction(qx, qy).T @ monomials(x, y, axis=0)
    # the same polynomials, fitted at the same points
    assert np.abs(here - disc).max() < 1e-5 * np.abs(disc).max()


@pytest.mark.parametrize("kappa", [0.4, 3.0])
def test_polynomials_fit_the_edge(kappa):
    shape = ellipse({0.4: NARROW, 3.0: 0.18877599093046807}[kappa])
    edge = EllipseEdge(shape)
    rng = np.random.default_rng(4)
    q, turn = rng.uniform(0.5, edge.largest, 60), rng.uniform(0.0, math.pi, 60)
    qx, qy = q * np.sin(turn), q * np.cos(turn)
    x, y = rng.uniform(-0.75, 0.75, (2, 300))
    inside = np.hypot(x, y) < 0.75
    x, y = x[inside], y[inside]
    k = 0.25 * math.pi / shape.kernel_ratio * q
    waves = np.exp(1j * (np.outer(x, qx) + np.outer(kappa * y, qy)))
    wanted = Series(shape, x, y, edge.largest * max(1.0, kappa)).of(qx, qy) - k * waves
    assert (np.abs(edge.functions(x, y).T @ edge.correction(qx, qy) - wanted) / k).max() < 0.025
    assert RADIUS > 0.75


def test_circle_is_the_limit_of_ellipses():
    """At an ellipticity of nearly 1 the code for ellipses predicts the result for circles.

    Its film is that of a formula, and the pressure of oblique waves is calculated, not fitted.
    """
    contact = {"contact.moes_m": 300.0, "contact.moes_l": 10.0}
    result = [
        pyehl.predict(pyehl.Case.from_text("", contact | ROUGH | {"contact.radius_ratio": ratio}))
        for ratio in (1.0, 1.0 + 1e-6)
    ]
    here, near = result
    assert near.mu_ratio == pytest.approx(here.mu_ratio, rel=1e-3)
    assert near.summary["mu_ratio_tracks"] == pytest.approx(
        here.summary["mu_ratio_tracks"], rel=1e-3
    )
    for one, other in zip(here.bands, near.bands, strict=True):
        assert other.increase == pytest.approx(one.increase, abs=1e-3)
    assert "ellipticity" not in here.summary
    assert near.summary["ellipticity"] == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("ratio", [WIDE, NARROW, 1.0])
def test_circle_with_the_same_inlet(ratio):
    """Equal alpha_bar, and lambda_bar with heights for an equal stiffness of waves."""
    point = OperatingPoint.from_moes(400.0, 10.0, radius_ratio=ratio)
    circle = OperatingPoint.from_moes(*point.equivalent_moes)
    assert circle.alpha_bar == pytest.approx(point.alpha_bar, rel=1e-12)
    kernel = point.ellipse.kernel_ratio
    assert circle.speed_parameter == pytest.approx(point.speed_parameter / kernel**2, rel=1e-12)
    # E'/4 per |q| and height
    stiffness = 0.25 * math.pi / kernel * point.hertz_pressure / point.film_scale
    modulus = 0.25 * point.reduced_modulus / point.hertz_radius
    assert stiffness == pytest.approx(modulus, rel=1e-12)


def rows_of(path: Path) -> list[dict[str, float]]:
    with path.open() as stream:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(stream)]


def test_response_of_ellipses_fits_measured_waves(root: Path):
    """The response of the circle with the same inlet fits; those of other circles do not."""
    rows = rows_of(root / "docs" / "evidence" / "ellipse" / "response.csv")
    groups: dict[tuple[float, ...], list[dict[str, float]]] = {}
    for row in rows:
        key = row["ellipticity"], row["moes_m"], row["moes_l"], row["velocity_ratio"]
        groups.setdefault(key, []).append(row)
    assert {key[0] for key in groups} == {0.4, 0.6, 1.0, 2.0, 4.0}
    for (kappa, *_), part in groups.items():
        assert len(part) == 10
        rms = {}
        for name in ("circle", "dry", "houpert", "by_rx"):
            off = [complex(r[f"{name}_re"] - r["T_re"], r[f"{name}_im"] - r["T_im"]) for r in part]
            rms[name] = math.sqrt(sum(abs(v) ** 2 for v in off) / len(off))
        # 257 nodes give 0.024 on circles
        assert rms["circle"] < (0.026 if kappa > 0.5 else 0.06)
        if kappa != 1.0:
            assert rms["houpert"] > 2.0 * rms["circle"]
            assert rms["by_rx"] > 3.0 * rms["circle"]
        if kappa < 0.5 or kappa > 1.5:
            assert rms["circle"] < 0.9 * rms["dry"]
        mean = sum(r["circle_pressure"] / r["pressure"] for r in part) / len(part)
        assert mean == pytest.approx(1.0, abs=0.012 if kappa > 0.5 else 0.023)


def test_shipped_waves_are_those_of_the_table(root: Path, script):
    """The present response at the conditions of the table."""
    rows = rows_of(root / "docs" / "evidence" / "ellipse" / "response.csv")
    part = [row for row in rows if row["ellipticity"] == 0.4 and row["moes_m"] == 500.0]
    cases = script("docs/evidence/ellipse/cases.py")
    settings = cases.case_of_circle(0.4, 500.0, 10.0, 1.02).resolve()
    point, oil = OperatingPoint.from_settings(settings), Lubricant.from_settings(settings)
    smooth = solve_contact(settings)
    zone = zone_of(smooth, point, oil)
    moes = circle_with_same_inlet(point, oil, smooth.central_film)
    kx, ky = (np.array([row[name] for row in part]) for name in ("kx", "ky"))
    result = shipped_response(kx, ky, zone, moes, 1.02)[:, 1]
    there = np.array([complex(row["circle_re"], row["circle_im"]) for row in part])
    # the table has the film of its own grid
    assert np.abs(result - there).max() < 0.02


def test_off_the_centre_line(root: Path):
    """The inlet transmits less beside the centre line, as measured; nothing is fitted to it."""
    rows = rows_of(root / "docs" / "evidence" / "ellipse" / "off_centre.csv")
    for kappa in (0.4, 0.6, 2.0, 4.0):
        part = [r for r in rows if r["ellipticity"] == kappa and 8.0 < r["kx"] < 20.0]
        middle = {r["kx"]: r for r in part if r["y"] == 0.0}
        ratio = {0.4: NARROW, 0.6: 2.15607, 2.0: WIDE, 4.0: 0.120434}[kappa]
        kernel = ellipse(ratio).kernel_ratio
        point = OperatingPoint.from_moes(
            500.0 * kappa / kernel**1.25, 10.0 / kernel**0.25, radius_ratio=ratio
        )
        assert point.equivalent_moes == pytest.approx((500.0, 10.0), rel=1e-3)
        for row in (r for r in part if 0.4 < r["y"] < 0.6):
            one, other = (
                complex(inlet_fit(row["kx"], 0.0, (500.0, 10.0), 1.02, y, kappa))
                for y in (0.0, row["y"])
            )
            fall = row["modulus"] / middle[row["kx"]]["modulus"]
            assert abs(other / one) == pytest.approx(fall, abs=0.05 if kappa > 0.5 else 0.1)
            turn = math.radians(row["lag"] - middle[row["kx"]]["lag"])
            assert math.atan2((other / one).imag, (other / one).real) == pytest.approx(
                turn, abs=0.12
            )


def test_refused_predictions():
    ellipse_of = {"contact.moes_m": 300.0, "contact.moes_l": 10.0, "contact.radius_ratio": WIDE}
    for more, text in (
        ({"contact.angle": 30.0}, "contact.angle = 30: the response of an elliptical contact"),
        ({"psd.reduction": "amplitude"}, "for circular contacts"),
        ({"psd.smooth": "hertz"}, "for circular contacts"),
    ):
        with pytest.raises(InputError, match=text):
            pyehl.predict(pyehl.Case.from_text("", ellipse_of | ROUGH | more))
    with pytest.raises(InputError, match=r"contact\.angle = 30"):
        pyehl.response(pyehl.Case.from_text("", ellipse_of | ROUGH | {"contact.angle": 30.0}))


def test_share_below_a_film():
    """Computed on an ellipse as on a circle."""
    ellipse_of = {"contact.moes_m": 300.0, "contact.moes_l": 10.0, "contact.radius_ratio": WIDE}
    case = pyehl.Case.from_text("", ellipse_of | ROUGH)
    limit = pyehl.predict(case).summary["h_min_m"]
    result = pyehl.predict(case.with_options(f"psd.film_limit={limit!r}")).summary
    assert 0.0 < result["film_below_limit_share"] < 0.5


def test_outside_of_the_range_by_the_same_inlet():
    """An unmeasured ellipticity, and M that is within the range only by R_x."""
    for ratio, names in ((0.015, ["ellipticity"]), (NARROW, ["moes_m"]), (WIDE, []), (1.0, [])):
        point = OperatingPoint.from_moes(2900.0, 10.0, radius_ratio=ratio)
        assert outside_range(point, 1.02, ModelOptions()) == names
        # an oil that thins in the inlet more than any measured one
        assert outside_range(point, 1.02, ModelOptions(), 18.0) == [*names, "thinning"]


@pytest.fixture(scope="module")
def compare(root: Path):
    """The module compare.py of the evidence."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(root / "docs" / "evidence" / "ellipse"))
        import compare

        yield compare
        for name in ("compare", "cases"):
            sys.modules.pop(name)


@pytest.mark.parametrize(
    "name",
    ["k040b", "k080", *(pytest.param(n, marks=pytest.mark.long) for n in ("k200b", "k400a"))],
)
def test_table_is_what_is_predicted(compare, name):
    (row,) = (row for row in compare.read("cases.csv") if row["name"] == name)
    (line,) = (line for line in compare.read("table.csv") if line["name"] == name)
    (run,) = (run for run in compare.read("simulated.csv") if run["name"] == name)
    result = compare.prediction(row)
    assert result == pytest.approx(line["prediction"], rel=1e-3)
    assert line["mu_ratio"] == run["mu_ratio"]
    error = model_error(result, ellipticity=row["ellipticity"])
    assert error == pytest.approx(line["model_error"], abs=2e-4)
    assert abs(result - run["mu_ratio"]) <= error


def test_readme_states_the_numbers_of_the_table(compare):
    """Counts, largest deviations and coverage of the predictions made before the simulations."""
    text = plain(compare.HERE / "README.md").replace("−", "-")
    table = compare.read("table.csv")
    ended = [row for row in compare.read("simulated.csv") if row["status"] == "converged"]
    assert len(table) == len(ended) == len(compare.read("cases.csv")) - 1
    number = r" ([-\d.]+)(?: %)? \|"
    head = text.split("\n## ")[0]
    lines = re.findall(r"^\| [^|]+ \| (\d+) \|" + 6 * number + "$", head, re.M)
    limits = compare.LIMITS
    for low, high, words in zip(limits[:-1], limits[1:], lines, strict=True):
        part = [row for row in table if low < row["mu_ratio"] <= high]
        count, *reported = map(float, words)
        assert count == len(part)
        for (mean, largest, covered), end in ((reported[:3], "_before"), (reported[3:], "")):
            off = [row[f"deviation{end}_percent"] for row in part]
            assert mean == pytest.approx(sum(off) / len(off), abs=0.06)
            assert largest == pytest.approx(max(map(abs, off)), abs=0.06)
            assert covered == sum(row[f"covered{end}"] for row in part)
    stated = {row["name"]: row["model_error"] for row in compare.read("predicted.csv")}
    for row in table:
        off = abs(row["predicted_before"] - row["mu_ratio"])
        assert row["covered_before"] == (off <= stated[row["name"]])


def test_page_shows_the_finer_grid(compare):
    """1025 nodes along X: the deviations there, which the stated error covers."""
    text = plain(compare.HERE / "README.md")
    assert "\n".join(compare.fine_lines()) in text
    table = {row["name"]: row for row in compare.read("table.csv")}
    fine = {row["name"]: row for row in compare.read("fine.csv")}
    assert len(fine) == 3
    for name, run in fine.items():
        coarse = table[name]
        assert run["mu_ratio_error_grid"] == pytest.approx(
            abs(run["mu_ratio"] - coarse["mu_ratio"]), abs=1e-5
        )
        assert abs(coarse["prediction"] - run["mu_ratio"]) <= coarse["model_error"]
    run, stated = fine["k050b"], table["k050b"]["prediction"]
    limit = run["mu_ratio"] + run["mu_ratio_error_grid"] / 3.0
    assert (
        f"approaches {limit:.3f} with order 2, {100.0 * (1.0 - stated / limit):.1f} % above" in text
    )


def test_ridges_beside_the_centre_line(root: Path, compare, script):
    """Their calculated excess over the half-space is most of the measured one."""
    folder = root / "docs" / "evidence" / "ellipse"
    rows, text = rows_of(folder / "sides.csv"), plain(folder / "README.md")
    for key in {(row["ellipticity"], row["wavelength"]) for row in rows}:
        part = {row["y"]: row for row in rows if (row["ellipticity"], row["wavelength"]) == key}
        cells = [
            f"{part[y][name]:.3f}" if y in part else ""
            for y in (0.0, 0.25, 0.5)
            for name in ("gain", "predicted_gain")
        ]
        assert f"| {key[0]:g} | {key[1]:g} | {' | '.join(cells)} |" in text
    near = [row for row in rows if row["y"] <= 0.5]
    off = [row["predicted_gain"] - row["gain"] for row in near]
    assert min(off) > -0.1
    assert max(off) < 0.02
    # and the present prediction is that of the table
    sides = script("docs/evidence/ellipse/sides.py")
    settings = sides.case_of_circle(0.5, 300.0, 12.0, 1.0).resolve()
    _, gain = sides.predicted(settings, 0.25)
    (row,) = (r for r in rows if r["wavelength"] == 0.25 and r["moes_m"] == 300.0 and not r["y"])
    assert gain[sides.AXIS] == pytest.approx(row["predicted_gain"], abs=2e-3)


def test_waves_across_the_motion():
    """An amplitude that is equal on all lines is one wave; one that varies is a sum."""
    ky, level = np.array([5.0]), np.ones((LINES.size, 1), dtype=complex)
    wavenumbers, parts = harmonics(level)
    inside = np.abs(LINES) < 0.9
    there = np.exp(1j * np.outer(LINES, wavenumbers)) @ parts[:, 0]
    assert np.abs(there - 1.0)[inside].max() < 0.01
    # a hump is stiffer than a wave of the same height everywhere
    hump = level * (1.0 - np.square(LINES))[:, np.newaxis]
    here = line_pressure(level, 0.0 * ky, ky, 1.0, 1e3)[AXIS, 0]
    assert here == pytest.approx(free_stiffness(0.0 * ky, ky, 1.0)[0], rel=1e-2)
    wide, narrow = (
        line_pressure(hump, 0.0 * ky, ky, 1.0, kappa)[AXIS, 0].real for kappa in (1e3, 0.3)
    )
    assert narrow > 1.005 * wide


def test_static_ridges(root: Path):
    """Their pressure as measured, on circles and ellipses; worst for a wavelength of 1."""
    for row in rows_of(root / "docs" / "evidence" / "ellipse" / "ridges.csv"):
        off = row["predicted_pressure"] / row["pressure"] - 1.0
        assert abs(off) < (0.09 if row["wavelength"] == 1.0 else 0.045)
        assert abs(row["predicted_T"] - row["T"]) < (0.07 if row["ellipticity"] < 0.5 else 0.05)


def test_predictions_of_wide_contacts_are_reproduced(root: Path, script, monkeypatch):
    """The committed predictions are those of this build, and their errors cover the simulations."""
    monkeypatch.syspath_prepend(str(root / "docs" / "evidence" / "ellipse"))
    monkeypatch.delitem(sys.modules, "cases", raising=False)
    wide = script("docs/evidence/ellipse/wide.py")
    rows = wide.compare()
    assert len(rows) >= 6
    assert all(row["covered"] for row in rows)
    (row,) = (row for row in rows if row["name"] == "w01")
    result = pyehl.predict(wide.case_of(row), tracks=1).summary
    assert result["mu_ratio"] == pytest.approx(row["prediction"], rel=1e-3)
    assert result["mu_ratio_model_error"] == pytest.approx(row["model_error"], rel=1e-2)
    assert result["outside_range"] == []
    # film and pressure over the roughness were not compared
    assert result["h_min_rough_error_m"] is None
