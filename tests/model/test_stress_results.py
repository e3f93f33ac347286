# SPDX-License-Identifier: BSD-3-Clause
"""Stress below the surface of results: `pyehl.stress`, its command, options and evidence."""

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl.cli import main
from pyehl.subsurface.result import text

CASES = Path(__file__).resolve().parents[2] / "cases"


def test_smooth_contact() -> None:
    """A Moes case is in Hertz units; at M = 1000 close to the value of the dry contact."""
    ds = pyehl.solve(pyehl.Case(contact={"moes_m": 1000.0, "moes_l": 10.0}), "grid.points=129")
    below = pyehl.stress(ds)
    assert float(below.principal_shear_max) == pytest.approx(0.310, rel=0.01)
    assert float(below.principal_shear_max_depth) == pytest.approx(0.48, abs=0.02)
    assert "z_m" not in below.coords
    with pytest.raises(pyehl.InputError, match="in SI units"):
        pyehl.stress(ds, above=1e8)


def test_friction_of_a_run() -> None:
    """Its integral is the friction of the run; a run without friction has none, as stated."""
    ds = pyehl.solve(CASES / "mtm.nml", "grid.points=65")
    # the surface, and as few depths below it as there may be
    places = [0.0, 2e-5, 4e-5, 6e-5]
    below = pyehl.stress(ds, depths=places)
    surface = below.sigma_xz_Pa.isel(Z=0)
    # body 1 is the faster one: the film retards it, so that xz is positive
    assert float(surface.max()) > 1e7
    assert float(pyehl.stress(ds, body=2, depths=places).sigma_xz_Pa.isel(Z=0).min()) < -1e7
    assert f"mu_smooth = {float(ds.mu):.4g}" in below.attrs["friction_note"]
    newtonian = pyehl.solve(CASES / "mtm.nml", "grid.points=65", "lubricant.shear_law=newtonian")
    note = pyehl.stress(newtonian, depths=places).attrs["friction_note"]
    assert note.startswith("without friction: ")


@pytest.mark.long
def test_rough_contact(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The command on a run with frames: the dent raises the shear near the surface."""
    run, out = tmp_path / "run", tmp_path / "stress"
    pyehl.solve(CASES / "dent.nml", "grid.points=65", output=run)
    words = ["stress", str(run), "-o", str(out), "--friction", "0.05", "--above", "2e8"]
    words += ["--fatigue", "dang-van", "--torsion-limit", "4e8", "--bending-limit", "6.5e8"]
    assert main(words) == 0
    reported = capsys.readouterr().out
    assert "rough over smooth" in reported
    assert "of the fatigue limit in torsion" in reported
    summary = json.loads((out / "summary.json").read_text())
    assert summary["near_surface_share"] > summary["near_surface_share_smooth"]
    assert sorted(path.name for path in out.iterdir()) == sorted(summary["files"])
    # a dent in pure rolling: the same histories as under the smooth contact, except near it
    assert 0.3 < summary["fatigue_ratio"] < 0.8


def test_mean_and_amplitude() -> None:
    """Amplitude and mean of a smooth contact, used by both criteria of fatigue.

    A passage from zero stress to p and back has mean and amplitude of p/2 in its hydrostatic part.
    """
    ds = pyehl.solve(CASES / "mtm.nml", "grid.points=65")
    inside = np.maximum(1.0 - ds.X**2 - ds.Y**2, 0.0)
    ds["P"] = (ds.P.dims, np.sqrt(inside).transpose(*ds.P.dims).values)
    options = {"torsion_limit": 4e8, "bending_limit": 6.5e8, "friction": "none"}
    below = pyehl.stress(ds, fatigue="crossland", **options)  # type: ignore[arg-type]
    deep = below.sel(Z=0.5, method="nearest")
    assert float(deep.hydrostatic_mean) == pytest.approx(
        -float(deep.hydrostatic_amplitude), rel=0.1
    )
    assert float(deep.sigma_zz_mean) == pytest.approx(-float(deep.sigma_zz_amplitude), rel=0.1)
    # the orthogonal shear is antisymmetric, with 0.21 p_h below the centre line of a circle
    assert float(deep.sigma_xz_mean) == pytest.approx(0.0, abs=0.002)
    assert float(below.sigma_xz_amplitude.max()) == pytest.approx(0.2148, abs=0.003)
    weight = 3.0 * 4e8 / 6.5e8 - math.sqrt(3.0)
    highest = below.shear_amplitude_Pa + weight * (
        below.hydrostatic_mean_Pa + below.hydrostatic_amplitude_Pa
    )
    assert float(below.fatigue_stress_Pa) >= float(highest.max()) * (1.0 - 1e-9)


def test_mean_and_amplitude_need_a_passage() -> None:
    """A rough contact with too few instants has neither, as stated."""
    rough = pyehl.solve(CASES / "dent.nml", "grid.points=33", "output.frame_interval=0")
    below = pyehl.stress(rough, friction="none")
    assert "shear_amplitude" not in below
    assert "the surface moves 0 a; mean and amplitude need" in below.attrs["cycle_note"]
    words = "fatigue = 'crossland': during the 1 instants of the run .*frame_interval"
    with pytest.raises(pyehl.InputError, match=words):
        pyehl.stress(rough, fatigue="crossland", torsion_limit=4e8, bending_limit=6.5e8)


@pytest.mark.parametrize(
    ("power", "singular"),
    [(0.0, True), (0.5, False), pytest.param(1.0, False, marks=pytest.mark.long)],
)
def test_depth_of_0_with_a_singular_edge(power: float, *, singular: bool) -> None:
    """A traction with a step at its edge has infinite stress at the surface: no depth of 0."""
    ds = pyehl.solve(pyehl.Case(contact={"moes_m": 100.0, "moes_l": 5.0}), "grid.points=65")
    inside = np.maximum(1.0 - ds.X**2 - ds.Y**2, 0.0).transpose(*ds.P.dims).values
    ds["P"] = (ds.P.dims, np.where(inside > 0.0, inside**power, 0.0))
    below = pyehl.stress(ds, friction=0.1)
    assert ("surface_note" in below.attrs) is singular
    assert (float(below.Z[0]) > 0.0) is singular
    if singular:
        assert "ends in a step, where the stress at the surface is not finite" in text(below)
        assert float(pyehl.stress(ds, friction="none").Z[0]) == 0.0


def test_predicted_contact() -> None:
    """A prediction includes the smooth contact, and more shear near the surface."""
    result = pyehl.predict(CASES / "table1.nml", "surface.pixels=64")
    below = pyehl.stress(result, contamination=0.3)
    assert float(below.principal_shear_max_smooth) == pytest.approx(0.3115, rel=0.01)
    near = float(below.Z.sel(Z=0.01, method="nearest"))
    rough, smooth = (below[f"principal_shear{end}"].sel(Z=near) for end in ("", "_smooth"))
    assert float(rough) > 1.15 * float(smooth)
    assert float(below.a_iso) > 0.1
    # the contribution of the roughness is known to 15 % except at the edge, which it shifts
    added = float(below.near_surface_shear_inner - below.near_surface_shear_inner_smooth)
    assert float(below.near_surface_shear_inner_error) == pytest.approx(0.15 * added, rel=0.3)
    assert float(below.near_surface_shear_error) >= float(below.near_surface_shear_inner_error)
    assert "% within 0.6 semi-axes" in text(below)
    # a point is followed through the whole contact, over several lengths of the tile
    assert float(below.sigma_zz_amplitude.max()) > 0.5


def test_a_body_at_rest_has_no_passage() -> None:
    result = pyehl.predict(CASES / "table1.nml", "surface.pixels=64", "contact.slide_to_roll=2.0")
    below = pyehl.stress(result, body=2, depths=[1e-5, 3e-5, 1e-4, 3e-4])
    assert "is at rest" in below.attrs["cycle_note"]
    assert "shear_amplitude" not in below


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"friction": "wet"}, "expected 'run', 'none', or a coefficient"),
        ({"friction": -0.1}, "expected 'run', 'none', or a coefficient"),
        ({"body": 3}, "body = 3: expected 1 or 2"),
        ({"above": -1.0}, "above = -1.0: expected a number > 0"),
        ({"fatigue": "goodman", "torsion_limit": 1.0, "bending_limit": 1.5}, "dang-van, crossland"),
        ({"fatigue": "dang-van"}, "expected torsion_limit and bending_limit"),
        ({"torsion_limit": 1e8}, "belong to fatigue"),
        ({"contamination": 0.3, "bearing": "needle"}, "expected one of ball, roller"),
        ({"contamination": 0.3}, "a_ISO needs Lambda"),
        ({"depths": [1e-6, 1e-5]}, "expected 4 or more ascending depths"),
        ({"depths": [1e-6, 1e-5, 1e-5, 2e-5]}, "expected 4 or more ascending depths"),
    ],
)
def test_bad_options(options: dict[str, object], expected: str) -> None:
    ds = pyehl.solve(CASES / "quick.nml", "grid.points=33")
    with pytest.raises(pyehl.InputError, match=expected):
        pyehl.stress(ds, **options)  # type: ignore[arg-type]


def test_results_without_fields() -> None:
    bare = pyehl.solve(CASES / "quick.nml", "grid.points=33", "output.fields=false")
    with pytest.raises(pyehl.InputError, match=r"output\.fields = \.false\."):
        pyehl.stress(bare)
    with pytest.raises(pyehl.InputError, match="expected a result of solve"):
        pyehl.stress(3)  # type: ignore[arg-type]


def test_evidence_is_what_the_page_shows(root: Path) -> None:
    """Each row of the table of predicted and simulated stress."""
    folder = root / "docs" / "evidence" / "subsurface"
    page = (folder / "README.md").read_text(encoding="utf-8")
    with (folder / "table.csv").open(newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    near = []
    for row in rows:
        value = {key: float(text) for key, text in row.items() if key != "name"}
        cells = [row["name"], f"{value['near_smooth']:.4f}"]
        for layer in ("near", "inner"):
            simulated, predicted, error = (
                value[f"{layer}_{of}"] for of in ("simulated", "predicted", "error")
            )
            off = f"{predicted / simulated - 1.0:+.1%}"
            cells += [f"{simulated:.4f}", f"{predicted:.4f}", off, f"{error / predicted:.1%}"]
            # the stated error covers the deviation
            assert abs(predicted - simulated) <= error, (row["name"], layer)
        largest = value["largest_predicted"] / value["largest_simulated"] - 1.0
        assert f"| {' | '.join([*cells, f'{largest:+.2%}'])} |".replace("%", " %") in page
        near.append((value["near_simulated"] / value["near_smooth"], cells[4]))
    # those in which the roughness raises the near-surface shear by more than 10 %
    rough = [off for rise, off in near if rise > 1.1]
    assert len(rough) >= 6
    assert sum(abs(float(off[:-1])) < 5.0 for off in rough) >= 6
