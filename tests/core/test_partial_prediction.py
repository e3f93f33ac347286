# SPDX-License-Identifier: BSD-3-Clause
"""Prediction of contact at a boundary film."""

import functools
import math

import numpy as np
import pandas as pd
import pytest

import pyehl
from pyehl import cli
from pyehl.commands.predict import report
from pyehl.contact import smooth
from pyehl.contact.smooth import touching_points
from pyehl.plots import surface
from pyehl.plots.stribeck import draw_stribeck
from pyehl.prediction import mixed_lubrication
from pyehl.prediction.predict import predict
from pyehl.schema import summary_of as scalars_of
from pyehl.studies.curve import CONTACT, CONTACT_EHL, EMPIRICAL, UNITS
from pyehl.theory import elastic_contact
from pyehl.theory.elastic_contact import Compliance, contact_pressures
from pyehl.theory.friction import OF_ROUGH
from pyehl.theory.transition import BREAKDOWN, FULL_FILM, Curve, lift_off

TEXT = """
&contact load = 20.0 mean_velocity = {} radius = 0.0127 slide_to_roll = 0.1 /
&lubricant shear_law = 'eyring' boundary_film = {} boundary_friction = {} /
&surface kind = 'fractal' rms_height = 3e-8 seed = 11 length_x = 1.2e-4 length_y = 1.2e-4
 pixels = 32 shortest_wavelength = 3e-5 /
"""


def predicted(boundary_film: float, friction: float = 0.1, velocity: float = 0.3):
    text = TEXT.format(velocity, boundary_film, friction if boundary_film else 0.0)
    return summary_of(text)


@functools.cache
def summary_of(text: str):
    # the tested values are not the mean over tracks
    return pyehl.predict(pyehl.Case.from_text(text), tracks=1).summary


def test_full_film_equals_that_without_a_boundary_film():
    """With a boundary film thinner than every film."""
    without, held = predicted(0.0), predicted(5e-9)
    assert held["contact_load_share"] == held["contact_area_share"] == 0.0
    more = {"boundary_film", *(name for name in held if name.startswith("contact_"))}
    timed = {"wall_seconds", "pressure_viscosity_note", "mu_note"}
    assert {k: v for k, v in held.items() if k not in more | timed} == {
        k: v for k, v in without.items() if k not in timed
    }


def test_error_of_the_smooth_film_is_one_of_the_load_share():
    """A nearly smooth surface has hardly any other error."""
    text = TEXT.format(0.1, 3e-8, 0.1).replace("rms_height = 3e-8", "rms_height = 1e-11")
    result = summary_of(text)
    assert result["contact_load_share"] > 0.0
    assert result["contact_load_share_error"] > 0.1 * result["contact_load_share"]
    assert result["h_min_rough_error_m"] > 0.1 * result["h_min_error_m"]


@pytest.mark.long
def test_share_grows_with_the_boundary_film_up_to_dry_contact():
    result = [predicted(boundary_film) for boundary_film in (9e-8, 1.1e-7, 1.3e-7, 4e-7)]
    shares = [summary["contact_load_share"] for summary in result]
    assert 0.0 < shares[0] < 0.1
    assert (np.diff(shares) > 0.05).all()
    assert shares[-1] == pytest.approx(1.0, abs=0.02)
    # friction is only that of the boundary film there
    assert result[-1]["mu"] == pytest.approx(0.1, rel=0.05)
    assert all(s["contact_load_share_error"] >= 0.0 for s in result[:-1])
    # in dry contact no film determines the deviation from that of the smooth contact
    assert result[-1]["contact_load_share_error"] is None
    assert "no film has the load share" in result[-1]["contact_load_share_error_note"]
    assert all(s["status"] == "predicted" for s in result)
    assert "mixed film" in result[1]["assessment"]


@pytest.mark.parametrize(
    ("velocity", "boundary_film"), [(0.3, 1.3e-7), pytest.param(0.02, 2e-8, marks=pytest.mark.long)]
)
def test_smooth_films_are_those_of_a_run_with_the_boundary_film(velocity, boundary_film):
    """Films, pressure and Lambda of a run, a prediction and a curve are the same."""
    values = predicted(boundary_film, velocity=velocity)
    case = pyehl.Case.from_text(TEXT.format(velocity, boundary_film, 0.1), {"grid.points": 129})
    run = scalars_of(pyehl.solve(case.with_options({"surface.kind": "smooth"})))
    for name in ("c", "min"):
        error = run[f"H_{name}_error"] * run["film_scale_m"]
        limit = run[f"H_{name}_extrapolated"] * run["film_scale_m"]
        assert values[f"h_{name}_m"] == pytest.approx(limit, abs=error)
    assert values["h_min_m"] == pytest.approx(values["lambda_ratio"] * values["rms_height_m"])
    assert values["p_max_Pa"] == pytest.approx(run["p_max_Pa"], rel=0.01)
    assert values["h_min_rough_m"] < values["h_min_m"]
    row = pyehl.stribeck(case, {"contact.mean_velocity": [velocity]}, jobs=1)
    for name in ("h_c_m", "h_min_m", "lambda_ratio", "lambda_ratio_deformed"):
        assert values[name] == pytest.approx(float(row[name][0]), rel=0.02), name


def test_smooth_contact_with_the_boundary_film_that_does_not_converge(monkeypatch):
    """Films of a contact without a boundary film do not replace the missing ones."""
    monkeypatch.setattr(
        smooth, "_solved_with_boundary_film", lambda *_: (None, "it does not converge")
    )
    settings = pyehl.Case.from_text(TEXT.format(0.3, 1.3e-7, 0.1)).resolve()
    prediction = predict(settings, tracks=1)
    summary = prediction.summary
    names = "h_c_m", "h_min_m", "h_c_error_m", "p_max_Pa", "lambda_ratio", "lambda_ratio_deformed"
    assert [summary[name] for name in names] == [None] * len(names)
    assert "does not converge" in summary["h_c_source"]
    assert "p_max      not known, up to" in report(prediction)
    assert summary["contact_load_share"] > 0.0
    assert summary["mu"] > 0.0


def test_friction_of_the_boundary_film_is_not_known():
    summary = predicted(1.3e-7, friction=0.0)
    assert summary["contact_load_share"] > 0.0
    assert (summary["mu"], summary["mu_ratio"]) == (None, None)
    assert "lubricant.boundary_friction" in summary["mu_ratio_error_note"]
    assert summary["mu_note"] == summary["mu_ratio_error_note"]


@pytest.mark.parametrize(
    ("ratio", "texts", "labels"),
    [([np.nan] * 4, ["not known"], []), ([1.0, np.nan, 1.2, 1.1], [], ["smooth"])],
)
def test_picture_of_friction_that_is_not_known(ratio, texts, labels):
    """Missing at all positions, or at some."""
    ax = surface.passage(np.arange(4) * 1e-4, np.array(ratio), 4e-4)
    assert [text.get_text() for text in ax.texts] == texts
    assert ax.get_legend_handles_labels()[1] == labels


def curve_of(status: str, **columns: float | None) -> Curve:
    """A curve of two equal points, whose columns are 1 unless given."""
    names = [*UNITS, *CONTACT, *CONTACT_EHL, *EMPIRICAL]
    row = {"contact.mean_velocity": 1.0, "status": status} | dict.fromkeys(names, 1.0) | columns
    return Curve("", "contact.mean_velocity", pd.DataFrame([row, row], dtype=object))


@pytest.mark.parametrize(("share", "rows"), [(None, 1), (0.0, 3)])
def test_picture_of_a_curve_with_unknown_contact(share, rows):
    """As with two surfaces: no panels without a line."""
    shares = {"contact_load_share": share, "contact_load_share_ehl": share}
    figure = draw_stribeck([curve_of(FULL_FILM, **shares)], "two surfaces")
    assert {ax.get_subplotspec().get_gridspec().nrows for ax in figure.axes} == {rows}


def test_picture_of_a_curve_without_friction():
    none = dict.fromkeys(("mu_ratio", "mu", "mu_ratio_ehl", "mu_empirical"))
    figure = draw_stribeck([curve_of(BREAKDOWN, contact_load_share=0.4, **none)], "contact")
    labels = [ax.get_ylabel() for ax in figure.axes]
    assert [label for label in labels if label] == ["load, area (dashed)", "minimum film [nm]"]


def test_curve_states_why_it_has_no_friction(tmp_path, capsys):
    case = tmp_path / "case.nml"
    case.write_text(TEXT.format(0.3, 1.3e-7, 0.0) + "&grid points = 65 /\n")
    words = ["stribeck", str(case), "--speed", "0.3", "--jobs", "1", "-o"]
    assert cli.main([*words, str(tmp_path / "out")]) == 0
    assert "mu         not reported: the bodies touch, and the friction" in capsys.readouterr().out
    # shares and films are drawn even if no point has friction
    assert (tmp_path / "out" / "stribeck.png").is_file()


HOT = TEXT.format(3.0, "{}", 0.1).replace("&lubricant", "&lubricant temperature_viscosity = 0.04")


def test_boundary_film_without_contact_changes_no_bit_of_friction_with_heat():
    without = summary_of(HOT.format(0.0).replace("boundary_friction = 0.1", ""))
    with_boundary_film = summary_of(HOT.format(5e-9))
    for name in without:
        if name.startswith(("mu", "temperature_rise")):
            assert with_boundary_film[name] == without[name], name
    assert without["mu"] < 0.95 * without["mu_isothermal"]


@pytest.mark.long
def test_heat_where_bodies_touch():
    """With heat: friction of a full film where contact begins, then that of the boundary film."""
    # a load at which M is in the range of the prediction
    text = HOT.replace("load = 20.0", "load = 120.0").replace("= 3e-8", "= 1e-7")
    touching = [summary_of(text.format(boundary_film)) for boundary_film in (2.6e-7, 3.6e-7)]
    full = summary_of(text.format(1e-9))
    reduction = [s["mu"] / s["mu_isothermal"] for s in (full, *touching)]
    assert touching[0]["contact_load_share"] < 0.01 < touching[1]["contact_load_share"]
    assert reduction[1] == pytest.approx(reduction[0], rel=0.02)
    # friction of the boundary film does not depend on the temperature
    assert reduction[1] < reduction[2]
    for summary in touching:
        assert summary["mu_smooth"] is None
        assert "mu_smooth" in summary["mu_note"]
        product = summary["mu_ratio"] * summary["mu_smooth_isothermal"]
        assert summary["mu_isothermal"] == pytest.approx(product, rel=1e-12)
        assert summary["temperature_rise_max_K"] > full["temperature_rise_max_K"]


@pytest.mark.parametrize(
    ("heat", "surfaces"), [("auto", 2), pytest.param("never", 1, marks=pytest.mark.long)]
)
def test_friction_of_a_curve_is_its_ratio_times_that_of_the_smooth_contact(heat, surfaces):
    """In every row, or mu_smooth is missing and the row states the reason."""
    case = pyehl.Case.from_text(HOT.format(1.3e-7) + "&grid points = 65 /\n")
    case = case.with_options({"lubricant.thermal_friction": heat})
    speeds = {"contact.mean_velocity": [0.3, 3.0] if heat == "auto" else [0.3]}
    curve = pyehl.stribeck(case, speeds, surfaces=surfaces, jobs=1)
    isothermal = curve.mu_ratio.values * curve.mu_smooth_isothermal.values
    assert curve.mu_isothermal.values == pytest.approx(isothermal, rel=1e-12)
    assert "mixed film" in curve.status.values
    product = curve.mu_ratio.values * curve.mu_smooth.values
    known = np.isfinite(product)
    assert curve.mu.values[known] == pytest.approx(product[known], rel=1e-12)
    assert known[-1]
    if heat == "never":
        assert known.all()
    assert all(OF_ROUGH in message for message in curve.message.values[~known])


def test_smooth_contact_of_a_curve_resolves_its_inlet():
    """Where it may touch it uses more nodes than the case, elsewhere those of the case."""
    case = pyehl.Case.from_text(TEXT.format(0.02, 1e-8, 0.1) + "&grid points = 65 /\n")
    points = touching_points(case.resolve())
    assert points > 65
    alone = case.with_options({"surface.kind": "smooth"})
    run = scalars_of(pyehl.solve(alone))
    assert "contact_load_share" not in run
    assert f"grid.points = {points} or more" in run["mu_note"]
    curve = pyehl.stribeck(alone, {"contact.mean_velocity": [0.02]}, jobs=1)
    assert curve.status.values == ["mixed film"]
    assert curve.mu.values < 0.09
    assert abs(run["h_c_m"] - float(curve.h_c_m[0])) <= run["h_c_error_m"]
    fast = case.with_options({"contact.mean_velocity": 1.0})
    assert touching_points(fast.resolve()) == 65


def test_contact_where_a_full_film_breaks_down(tmp_path, capsys):
    """Numbers of a full film are missing then, and neither table nor pictures need them."""
    case = tmp_path / "case.nml"
    case.write_text(TEXT.format(0.3, 1.3e-7, 0.1).replace("rms_height = 3e-8", "rms_height = 2e-7"))
    assert cli.main(["predict", str(case), "-o", str(tmp_path / "out"), "--tracks", "1"]) == 0
    summary = scalars_of(pyehl.load(tmp_path / "out"))
    assert summary["message"].startswith("partial film")
    assert summary["contact_load_share"] > 0.1
    names = "p_rise_rms_Pa", "p_rise_max_Pa", "mu_ratio_tracks"
    assert [summary.get(name) for name in names] == [None] * 3
    stated = capsys.readouterr().out
    assert "deformed   rms" in stated
    assert "maximum increase" not in stated
    assert (tmp_path / "out" / "passage.png").is_file()


NOTHING = "full film; the bodies touch at the boundary film, to an unknown extent: "
TABLE1 = {
    "lubricant.shear_law": "eyring",
    "lubricant.boundary_friction": 0.12,
    "lubricant.boundary_film": 4e-9,
    "surface.rms_height": 2e-7,
}


@pytest.mark.parametrize(
    ("velocity", "boundary_film", "note", "message"),
    [
        pytest.param(
            *(0.3, 2e-8, "waves are too short", "full film; the bodies touch at the boundary film"),
            marks=pytest.mark.long,
        ),
        pytest.param(
            *(0.6, 2.5e-8, "waves are too short", "the bodies touch at the boundary film"),
            marks=pytest.mark.long,
        ),
        pytest.param(
            *(0.12, 4e-9, "outside the range of the response by moes_m", NOTHING),
            marks=pytest.mark.long,
        ),
        (0.413, 4e-9, "the film ends between the positions", NOTHING),
    ],
)
def test_no_number_of_contact_outside_the_range(cases, velocity, boundary_film, note, message):
    """Bodies touch to an unknown extent: a missing value with the reason, and no friction."""
    case = pyehl.Case(cases / "table1.nml", TABLE1)
    options = {"contact.mean_velocity": velocity, "lubricant.boundary_film": boundary_film}
    summary = pyehl.predict(case.with_options(options), tracks=1).summary
    assert summary["status"] == "film breakdown"
    assert message in summary["message"]
    assert note in summary["contact_load_share_error_note"]
    assert summary["message"].endswith(summary["contact_load_share_error_note"])
    names = [name for name in summary if name.startswith("contact_") and "note" not in name]
    names += ["mu_ratio", "mu_ratio_min", "mu", "mu_isothermal", "h_min_rough_m"]
    assert {name: summary[name] for name in names} == dict.fromkeys(names)
    # there is no film that could have this error
    assert summary["h_min_rough_error_m"] is None


def test_waves_too_short_for_the_points_of_the_contact(monkeypatch):
    """Solid contact on a fifth of the usual points, which do not resolve the waves."""
    monkeypatch.setattr(mixed_lubrication, "CONTACT_POINTS", (12.0, 12.0))
    case = pyehl.Case.from_text(TEXT.format(0.3, 1.3e-7, 0.1))
    summary = pyehl.predict(case, tracks=1).summary
    for name in ("contact_load_share", "contact_area_share", "mu_ratio", "mu"):
        assert summary[name] is None
    assert "waves are too short" in summary["contact_load_share_error_note"]
    assert "the bodies touch at the boundary film" in summary["message"]


def test_no_contact_is_certain_outside_the_range(cases):
    """Where no body touches within the error of the film: 0."""
    case = pyehl.Case(cases / "table1.nml", TABLE1 | {"surface.rms_height": 1e-8})
    summary = pyehl.predict(case.with_options("contact.mean_velocity=0.15"), tracks=1).summary
    assert summary["outside_range"] == ["moes_m"]
    assert summary["contact_load_share"] == summary["contact_load_share_error"] == 0.0
    assert summary["status"] == "predicted"


def test_hardness_is_left_out():
    text = TEXT.format(0.3, 1.3e-7, 0.1)
    hard = text.replace("&contact ", "&contact hardness = 3e9 ", 1)
    assert hard != text
    elastic, left = (summary_of(t) for t in (text, hard))
    assert left["contact_load_share"] == elastic["contact_load_share"] > 0.0
    assert left["contact_load_share_error"] is left["contact_area_share_error"] is None
    assert "contact.hardness is ignored" in left["contact_load_share_error_note"]


def test_two_surfaces_have_no_contact_prediction():
    text = TEXT.format(0.3, 1.3e-7, 0.1)
    second = text[text.index("&surface") :].replace("surface", "second_surface").replace("11", "12")
    summary = summary_of(text + second)
    assert summary["contact_load_share"] is None
    assert "single rough surface" in summary["contact_load_share_error_note"]


@pytest.mark.parametrize("load", [np.inf, 40.0])
def test_contact_pressures(load):
    """All conditions of the solution, with enough pressure to lift and with too little."""
    rng = np.random.default_rng(3)
    gap = rng.standard_normal((48, 48)) + 0.5
    gap[:, :4] = np.inf
    q = np.hypot(np.fft.rfftfreq(60)[:, None], np.fft.fftfreq(60)[None])
    kernel = np.divide(1.0, q, out=np.zeros_like(q), where=q > 0.0)
    compliance = Compliance(kernel, (60, 60))
    result = contact_pressures(gap, compliance, 0.1, load)
    assert result is not None
    assert (result.pressure >= 0.0).all()
    assert (result.pressure[:, :4] == 0.0).all()
    left = gap + result.lift
    assert left.min() >= -2e-3
    assert np.abs(left[result.pressure > 0.0]).max() <= 1e-2
    rise = result.lift - compliance(result.pressure)
    if np.isfinite(load):
        assert result.pressure.sum() == pytest.approx(load)
        assert rise.min() > 0.0
    else:
        assert np.abs(rise).max() < 1e-12


@pytest.mark.parametrize("share", [0.5, 2.0])
def test_contact_sustains_no_more_than_it_can(monkeypatch, share):
    """Where the iteration without a uniform lift fails, one with the load may solve the problem.

    Not if the contact sustains less than the load: pressures of that sum would lower the film.
    """
    gap = np.random.default_rng(3).standard_normal((48, 48)) + 0.5
    q = np.hypot(np.fft.rfftfreq(60)[:, None], np.fft.fftfreq(60)[None])
    compliance = Compliance(np.divide(1.0, q, out=np.zeros_like(q), where=q > 0.0), (60, 60))
    free = contact_pressures(gap, compliance, 0.1, math.inf)
    assert free is not None
    solved = elastic_contact.iterated

    def failing(*arguments, fixed_load=False):
        return solved(*arguments, fixed_load=True) if fixed_load else None

    monkeypatch.setattr(elastic_contact, "iterated", failing)
    load = share * float(free.pressure.sum())
    result = contact_pressures(gap, compliance, 0.1, load)
    if share > 1.0:
        assert result is None
    else:
        assert result is not None
        assert result.pressure.sum() == pytest.approx(load)
        assert (result.lift - compliance(result.pressure)).min() > 0.0


def test_lift_off_with_its_error():
    """With a share that falls tenfold each time the speed doubles."""
    speeds = np.array([0.8, 0.4, 0.2, 0.1])
    rows = [
        {
            "contact_load_share": share,
            "contact_load_share_error": error,
            "lambda_ratio": 10.0 * speed,
            "theta_2": None,
        }
        for speed, share, error in zip(
            speeds, (0.0, 0.005, 0.05, 0.5), (0.0, 0.004, 0.03, 0.1), strict=True
        )
    ]
    result = lift_off(speeds, pd.DataFrame(rows))
    assert result is not None
    part = (0.05 - 0.01) / (0.05 - 0.005)
    assert result.speed == pytest.approx(0.2 * 2.0**part)
    lower = 0.2 * 2.0 ** ((0.02 - 0.01) / (0.02 - 0.001))
    assert result.error == pytest.approx(result.speed - lower)
    assert result.lambda_ratio == pytest.approx(10.0 * result.speed)
    assert "Lambda" in result.words
    assert "theta_2" not in result.words
    # no speed if its error is unknown: beyond the curve, or next to a point without one
    for error in (1.0, None):
        unknown = [row | {"contact_load_share_error": error} for row in rows]
        lost = lift_off(speeds, pd.DataFrame(unknown))
        assert lost is not None
        assert np.isnan([lost.speed, lost.error, lost.lambda_ratio]).all()
        assert lost.words.startswith("lift-off   not known: the curve ends within the error")
    assert Curve("", "contact.load", pd.DataFrame(rows)).lift_off is None
    assert lift_off(speeds[:2], pd.DataFrame(rows[:2])) is None


@pytest.mark.long
def test_curve_with_a_boundary_film():
    case = pyehl.Case.from_text(TEXT.format(0.3, 1e-7, 0.1) + "&grid points = 65 /\n")
    curve = pyehl.stribeck(case, {"contact.mean_velocity": [0.2, 1.2]}, jobs=1)
    assert curve.status.values[0] == "mixed film"
    # at the higher speed M is below the range of the response
    assert curve.status.values[1] == "outside the range"
    assert curve.contact_load_share.values[0] > 0.05
    assert curve.contact_load_share.values[1] == 0.0
    speed, error = (float(curve[f"transition_speed_{n}m_s"]) for n in ("", "error_"))
    assert 0.2 < speed < 1.2
    assert 0.0 < error < 1.0
