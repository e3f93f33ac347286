# SPDX-License-Identifier: BSD-3-Clause
"""Logic of the page, without a browser: controls, cases, words, pictures."""

import resource
import threading
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

import pyehl
from pyehl import namelist
from pyehl.app import answers, downloads, drawing, words
from pyehl.app.controls import CONTROLS, STEPS, Control
from pyehl.app.figures import TICKS, Pictures
from pyehl.app.position import Position, from_case
from pyehl.case import Case
from pyehl.errors import InputError
from pyehl.plots.outline import Outline
from pyehl.theory.moes_film import nijenbanning_venner_moes, regime


@pytest.fixture
def start() -> Position:
    return from_case(Case())[0]


def always() -> bool:
    return True


@pytest.mark.parametrize(
    "name", [name for name, control in CONTROLS.items() if isinstance(control, Control)]
)
def test_sliders_reach_their_ends(name):
    control = CONTROLS[name]
    assert control.at(0) == pytest.approx(control.low)
    assert control.at(STEPS) == pytest.approx(control.high)
    values = [control.at(place) for place in range(STEPS + 1)]
    assert values == sorted(values)
    # values have three digits, which may be coarser than a step
    assert all(abs(control.place(float(v)) - k) <= 3 for k, v in enumerate(values))


@pytest.mark.parametrize("text", ["", "abc", "1,5", "nan", "inf", "1e400"])
def test_a_control_refuses_texts_that_are_no_numbers(text):
    with pytest.raises(InputError, match="load w = "):
        CONTROLS["load"].read(text)


def test_a_seed_is_a_whole_number():
    for text in ("1.5", "9" * 400):
        with pytest.raises(InputError, match="expected a whole number"):
            CONTROLS["seed"].read(text)


def test_start_is_the_default_case(start):
    """Untouched controls give the default case with smooth surfaces, bit for bit."""
    ours, theirs = start.case(129).resolve(), Case(grid={"points": 129}).resolve()
    for group in ("contact", "lubricant", "grid", "surface"):
        assert ours[group] == theirs[group]


CASES = {
    "thinning": "&contact slide_to_roll = 0.5 /"
    " &lubricant shear_law = 'eyring' eyring_stress = 7e6 /",
    "carreau": "&lubricant shear_law = 'carreau' carreau_stress = 4e6 carreau_exponent = 0.7 /",
    "sheet": "&lubricant kinematic_viscosity_40 = 46.0 kinematic_viscosity_100 = 6.8"
    " temperature = 60.0 density_15 = 900.0 /",
    "name": "&lubricant name = 'fva3' temperature = 60.0 /",
    "ellipse": "&contact radius_x = 0.01 radius_y = 0.03 /",
    "fractal": "&surface kind = 'fractal' rms_height = 3e-8 hurst = 0.7 seed = 5 pixels = 128 /",
    "kept": "&solver threads = 2 / &grid y_extent = 2.5 / &psd film_thickness = 2e-7 /",
}


@pytest.mark.parametrize("text", CASES.values(), ids=CASES)
def test_opened_case_is_the_case(text):
    """A case that is opened in the page and read back has the same values of all keys."""
    case = Case.from_text(text, {"grid.points": 65})
    position, note = from_case(case)
    assert not note
    ours, theirs = position.case(65).resolve(), case.resolve()
    for group, keys in theirs.items():
        for key, value in keys.items():
            if key == "alpha_origin":
                continue  # the control returns it as a number
            assert ours[group][key] == (pytest.approx(value, rel=1e-11) if isinstance(value, float)
                                        else value), f"{group}.{key}"  # fmt: skip
    again, _ = from_case(Case.from_text(position.text(65)))
    assert again.values == position.values


@pytest.mark.parametrize(
    "keys", ["kind='fractal' ra=5e-8", "kind='fractal' rq=5e-8", "finish='honed'"]
)
def test_a_height_in_another_form_becomes_the_rms_height(keys):
    case = Case.from_text(f"&surface {keys} /")
    position, _ = from_case(case)
    made, own = position.case(129)["surface"], case["surface"]
    for key in ("rms_height", "hurst", "lay_ratio", "rolloff_wavenumber"):
        assert made[key] == pytest.approx(own[key], rel=1e-11)
    assert position.changed("surface", "smooth").case(129)["surface"]["kind"] == "smooth"


def test_oil_of_a_data_sheet_can_be_replaced():
    position, _ = from_case(Case.from_text(CASES["sheet"]))
    assert position.values["oil"] == "of the data sheet"
    changed = position.changed("oil", "at the inlet").changed("viscosity", 0.05)
    assert changed.case(65).resolve()["lubricant"]["viscosity"] == 0.05
    assert changed.changed("oil", "of the data sheet").case(65).text == position.case(65).text


def test_bodies_become_radii_and_modulus():
    text = "&bodies radius_x1 = 0.01 radius_y1 = 0.01 radius_x2 = 0.04 radius_y2 = -0.011 /"
    case = Case.from_text(text)
    position, _ = from_case(case)
    ours, theirs = (
        pyehl.OperatingPoint.from_settings(c.resolve()) for c in (position.case(65), case)
    )
    assert ours.moes_m == pytest.approx(theirs.moes_m, rel=1e-10)
    assert ours.radius_ratio == pytest.approx(theirs.radius_ratio, rel=1e-10)


def test_moduli_of_the_bodies_of_a_case_are_kept():
    bodies = (
        "radius_x1 = 0.01 radius_y1 = 0.01 modulus_1 = 208e9 poisson_1 = 0.28 modulus_2 = 207e9"
    )
    case = Case.from_text(f"&bodies {bodies} /")
    position, note = from_case(case)
    assert not note
    result = [
        position.values[name] for name in ("modulus_1", "poisson_1", "modulus_2", "poisson_2")
    ]
    assert result == [208.0, 0.28, 207.0, 0.3]
    # to the opened case and back: the controls do not jump
    back = position.changed("modulus_1", 150.0).changed("modulus_1", 208.0)
    expected = case.resolve()["contact"]["reduced_modulus"]
    assert back.reduced_modulus() == pytest.approx(expected, rel=1e-10)
    _, note = from_case(Case.from_text("&contact reduced_modulus = 1.4e11 /"))
    assert "E' = 140 GPa until a modulus is changed" in note


def test_a_rotated_ellipse_is_drawn_at_its_angle():
    text = "&contact radius_x = 0.01 radius_y = 0.03 angle = 30.0 load = 100.0 /"
    result = answers.film(from_case(Case.from_text(text))[0], 65, always)
    assert result.converged
    made, edge = drawing.film_map(result), Outline(result.point.ellipse.ellipticity, 30.0)
    radius = result.point.hertz_radius * 1e3
    for half, axis in zip(edge.reach, (made.x, made.y), strict=True):
        # the picture shows the whole ellipse and a margin
        assert half * radius < axis[-1] <= drawing.VIEW * half * radius
    for half, line in zip(edge.chords, drawing.centre_lines(result).values(), strict=True):
        inside = np.abs(line["place"]) < half * radius
        assert np.array_equal(line["hertz"] > 0.0, inside)
    assert "rotated by 30°" in dict(words.film_rows(result))["semi-axes"]


def test_the_film_is_kept_while_the_surface_changes(start, monkeypatch):
    position = start.changed("load", 100.0)
    known = {65: answers.film(position, 65, always)}
    formulas = answers.api.film
    asked = []
    monkeypatch.setattr(answers.api, "film", lambda case: asked.append(1) or formulas(case))
    rough = position.changed("surface", "fractal").changed("seed", 7)
    assert answers.film(rough, 65, always, known) is known[65]
    # on another grid the formulas are the same
    finer = answers.film(rough, 129, always, known)
    assert finer.points == 129
    assert not asked
    again = answers.film(rough.changed("load", 101.0), 65, always, known)
    assert again.point.moes_m > known[65].point.moes_m
    assert asked


def test_contours_are_lines_of_equal_film(start):
    made = drawing.film_map(answers.film(start.changed("load", 100.0), 65, always))
    x, y = drawing.contour_lines(made)
    assert np.array_equal(np.isnan(x), np.isnan(y))
    inner = ~np.isnan(x)
    film = RegularGridInterpolator((made.y, made.x), made.film)(np.stack([y[inner], x[inner]], 1))
    levels = np.unique(film.round(6))
    assert 5 <= levels.size <= 30
    assert np.ptp(np.diff(levels)) < 1e-5


def test_moes_numbers_become_si(root: Path):
    position, note = from_case(Case(root / "cases/quick.nml"))
    assert "M = 200" in note
    result = pyehl.OperatingPoint.from_settings(position.case(65).resolve())
    assert result.moes_m == pytest.approx(200.0, rel=1e-9)
    assert result.moes_l == pytest.approx(10.0, rel=1e-9)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("&surface kind = 'dent' amplitude = 0.1 /", "surface.kind = 'dent'"),
        ("&second_surface kind = 'fractal' /", "second_surface"),
    ],
)
def test_cases_beyond_the_controls_are_refused(text, why):
    with pytest.raises(InputError, match=why):
        from_case(Case.from_text(text))


def test_moduli_of_the_bodies(start):
    changed = start.changed("modulus_1", 70.0)
    expected = 2.0 / (0.91 / 70e9 + 0.91 / 206e9)
    assert changed.reduced_modulus() == pytest.approx(expected, rel=1e-10)
    with pytest.raises(InputError, match="body 1"):
        start.changed("poisson_1", 0.7).case(65)


def test_film_is_that_of_a_run(start):
    position = start.changed("load", 200.0)
    result = answers.film(position, 65, always)
    run = pyehl.solve(position.case(65))
    assert result.summary["h_c_m"] == float(run.h_c_m)
    assert np.array_equal(result.film, run.H.values)
    rows = dict(words.film_rows(result))
    error = float(run.H_c_error) * result.point.film_scale * 1e9
    assert rows["h_c"] == f"{words.with_error(float(run.h_c_m) * 1e9, error, 'nm')} (grid)"
    assert rows["regime"] == "rigid to elastic-piezoviscous"


def test_ellipse_has_a_film_and_says_why_there_is_no_prediction(start):
    position = start.changed("load", 100.0).changed("radius_y", 40.0).changed("surface", "fractal")
    result = answers.film(position, 65, always)
    assert result.converged
    assert "semi-axes, along × across" in dict(words.film_rows(result))
    x, y = drawing.outline(result)
    assert y.max() / x.max() == pytest.approx(result.point.ellipse.ellipticity, rel=1e-3)
    rough = answers.rough(position)
    if rough.prediction is None:
        assert words.rough_rows(rough) == [("no prediction", rough.why)]
        assert "circular" in rough.why


def test_no_solution_is_no_number(start):
    result = answers.film(start.changed("load", 4000.0).changed("velocity", 0.1), 65, always)
    assert not result.converged
    rows = dict(words.film_rows(result))
    assert rows["h_c"] == rows["h_min"] == "no solution"
    assert words.status_line(result).startswith("No solution on 65 × 65 nodes: the status is")
    assert result.film.size == 0


def test_superseded_computations_end(start):
    assert answers.film(start, 65, lambda: False) is None


def test_rough_contact_is_that_of_a_prediction(start):
    position = start.changed("surface", "fractal")
    result = answers.rough(position)
    prediction = pyehl.predict(position.case(257))
    rows = dict(words.rough_rows(result))
    error = words.with_error(prediction.mu_ratio, prediction.model_error)
    assert rows["μ_r/μ_s of one track"] == f"{error} (model)"
    mean = rows["μ_r/μ_s, mean and scatter of 8 tracks"]
    assert mean == words.with_error(*prediction.tracks)
    assert list(rows.values()).index(mean) < list(rows).index("μ_r/μ_s of one track")
    # the film ratio is that of the film and roughness shown beside it, on any grid
    film = answers.film(position, 129, lambda: True)
    h_min, sigma = float(film.summary["h_min_m"]), prediction.summary["rms_height_m"]
    shown = dict(words.rough_rows(result, film))["film ratio Λ = h_min/σ"]
    assert shown.startswith(f"{h_min / sigma:.4g}: ")
    assert h_min != pytest.approx(prediction.summary["h_min_m"], rel=1e-3)
    before, after, width, _, top = drawing.tiles(result.prediction)
    assert before.shape == after.shape == (256, 256)
    assert np.abs(before).max() == pytest.approx(top)
    assert width == pytest.approx(0.829)
    assert sum(drawing.octaves(result.prediction)["increase"]) == pytest.approx(
        prediction.mu_ratio - 1.0, abs=1e-6
    )


def test_film_breakdown_suggests_a_cut_off(start):
    position = start.changed("surface", "fractal").changed("rms", 400.0)
    rows = words.rough_rows(answers.rough(position))
    names = [name for name, _ in rows]
    assert "suggested cut-off" in names
    assert "minimum rough film" not in names
    assert not any(name.startswith("μ_r/μ_s") for name, _ in rows)


def test_python_lines_give_the_numbers(start, capsys):
    position = start.changed("load", 200.0).changed("surface", "fractal")
    exec(words.python_lines(position, 65), {})
    lines = capsys.readouterr().out.split()
    result = answers.film(position, 65, always)
    assert float(lines[0]) == result.summary["h_c_m"]
    prediction = pyehl.predict(position.case(65))
    assert float(lines[2]) == prediction.mu_ratio


def test_case_file_is_short_and_complete(start):
    position = start.changed("shear_law", "eyring").changed("surface", "fractal")
    text = position.text(257)
    assert "!" not in text
    assert Case.from_text(text).resolve() == position.case(257).resolve()
    assert set(namelist.values(text)) == {"contact", "lubricant", "surface", "grid"}


def test_downloads(start):
    import io
    import zipfile

    position = start.changed("load", 100.0)
    page = downloads.report_page(position, 65)
    assert b"Full film" in page
    data = downloads.figures(position, 65, "svg", 0.084)
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.namelist() == ["centre_lines.svg", "film.svg"]
        # 84 mm are 238.1 points
        assert b'width="238.110236pt"' in archive.read("film.svg")


def test_curve(start):
    position = start.changed("load", 100.0)
    values = answers.places(position, "velocity", 3)
    assert values == [0.21, 0.84, 3.36]
    *_, last = answers.curve(position, "velocity", values, always, 65)
    assert [p.place for p in last] == values
    assert last[0].h_c < last[1].h_c < last[2].h_c
    assert not list(answers.curve(position, "velocity", values, lambda: False, 65))


@pytest.mark.parametrize(
    ("moes_m", "moes_l", "name", "power"),
    [
        (0.5, 0.0, "rigid-isoviscous", -2.0),
        (2000.0, 0.01, "elastic-isoviscous", -2.0 / 15.0),
        (5.0, 40.0, "rigid-piezoviscous", 0.0),
        (1e5, 10.0, "elastic-piezoviscous", -1.0 / 12.0),
    ],
)
def test_regimes(moes_m, moes_l, name, power):
    """The film follows M with the exponent of the regime that is named."""
    assert regime(moes_m, moes_l) == name
    films = [nijenbanning_venner_moes(m, moes_l) * m ** (2 / 3) for m in (moes_m, 1.01 * moes_m)]
    slope = np.log(films[1] / films[0]) / np.log(1.01)
    assert slope == pytest.approx(power, abs=0.03)


@pytest.mark.long
def test_many_changes_leave_no_memory_behind(start):
    """Changed positions leave no solver, no thread and no memory."""

    def film_and_back() -> None:
        for k in range(100):
            position = start.changed("load", 100.0 + k).changed("velocity", 2.0)
            assert answers.film(position, 33, always) is not None

    film_and_back()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    threads = threading.active_count()
    for _ in range(4):
        film_and_back()
    # kilobytes: less than 20 per change
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 8_000
    # threads of earlier tests may end
    assert threading.active_count() <= threads


def test_contact_without_friction_of_the_boundary_film():
    """An opened case may have a boundary film, for which the page has no control."""
    text = """&contact load = 20.0 mean_velocity = 0.3 radius = 0.0127 slide_to_roll = 0.1 /
    &lubricant shear_law = 'eyring' boundary_film = 1.3e-7 {} /
    &surface kind = 'fractal' rms_height = 3e-8 length_x = 1.2e-4 length_y = 1.2e-4 pixels = 32 /"""
    for friction, known in (("", False), ("boundary_friction = 0.1", True)):
        position, _ = from_case(Case.from_text(text.format(friction)))
        rows = dict(words.rough_rows(answers.rough(position)))
        assert ("boundary_friction" in rows.get("μ_r/μ_s", "")) != known
        assert ("over the passage" in rows) == ("friction μ" in rows) == known
        assert not [row for row in rows.values() if "nan" in row]
    # friction of the smooth contact is shown twice, each time with its grid
    assert "; smooth 0." in rows["friction μ"]
    assert rows["friction μ"].endswith("solved on 257 x 257 nodes, extrapolated")
    thick, _ = from_case(Case.from_text(text.format(friction).replace("1.3e-7", "1e-9")))
    shown = dict(words.film_rows(answers.film(thick, 65, always)))
    assert shown["friction μ_s, smooth"].endswith("on 65 × 65 nodes")


def test_pictures_without_data_are_replaced_by_a_sentence(monkeypatch):
    """A sentence replaces empty axes; the browser gets only pictures that exist."""
    pictures = Pictures()
    rough = (pictures.before, pictures.after, pictures.bands, pictures.over)
    assert not any(picture.visible for picture in (*rough, *pictures.curves))
    assert all(hint.visible and hint.text for hint in pictures.hints.values())
    sent = []
    monkeypatch.setattr(
        pictures.changes, "of", lambda model, **values: sent.append((model, values))
    )
    pictures.show_curve([answers.CurvePoint(0.5, 1e-7, 1e-9)], [0.5, 1.0], "speed", "a curve")
    for picture in pictures.curves:
        assert (picture, {"visible": True}) in sent
    assert (pictures.hints["curve_hint"], {"visible": False}) in sent
    assert not any(model in rough for model, values in sent if "visible" in values)


def test_axis_numbers_fit_the_axes():
    for name, picture in Pictures().figures.items():
        if name.endswith("_hint") or name == "bands":
            continue
        # a number of six characters takes 40 pixels
        assert picture.xaxis[0].ticker.desired_num_ticks == TICKS
        assert TICKS * 40 < picture.width - 100
