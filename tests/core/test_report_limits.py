# SPDX-License-Identifier: BSD-3-Clause
"""Assessment, limits and conditions on the page of ``pyehl report``."""

import pytest

import pyehl
from pyehl.reports.assessment import assess
from pyehl.reports.conditions import conditions
from pyehl.reports.folder import named_files
from pyehl.reports.limits import limits, warnings


def test_heating_included_in_the_friction_is_no_warning(root):
    settings = pyehl.Case(root / "cases/table1.nml").resolve()
    hot = {"kind": "solution", "status": "converged", "flash_temperature_K": 14.3}
    assert "not fed back" in " ".join(limits(settings, hot))
    assert "14.3 K" in " ".join(warnings(hot))
    heated = hot | {"temperature_rise_max_K": 17.0}
    assert "The friction includes the temperature of film and walls" in " ".join(
        limits(settings, heated)
    )
    assert "not fed back" not in " ".join(limits(settings, heated))
    assert warnings(heated) == []


GOOD = {
    "kind": "solution",
    "status": "converged",
    "H_c": 0.02,
    "H_c_error": 0.0004,
    "H_min": 0.01,
    "H_min_error": 0.0002,
}


@pytest.mark.parametrize(
    ("changed", "word", "why", "kind"),
    [
        ({}, "Full film", "Smooth surfaces", "pass"),
        ({"H_c_error": 0.002}, "Full film", "H_c is uncertain by 10 %", "care"),
        ({"H_c_error": None}, "Full film", "the error of H_c is not known", "care"),
        ({"flash_temperature_K": 40.0}, "Full film", "40.0 K", "care"),
        # the friction already includes it
        (
            {"flash_temperature_K": 40.0, "temperature_rise_max_K": 9.0},
            "Full film",
            "Smooth surfaces",
            "pass",
        ),
        ({"h_min_m": 5e-9}, "Thin film", "The minimum film is 5.00 nm", "care"),
        ({"status": "diverged"}, "No result", "'diverged'", "fail"),
    ],
)
def test_assessment(changed, word, why, kind):
    result = assess(GOOD | changed)
    assert (result.word, result.kind) == (word, kind)
    assert why in result.why


def test_a_roller_is_no_infinite_line(tmp_path):
    table = tmp_path / "profile.csv"
    table.write_text("-0.005, 1e-5\n0, 0\n0.005, 1e-5\n")
    keys = {"shape": "roller", "length": 0.01, "load": 2000.0}
    case = pyehl.Case(contact={**keys, "profile": "file", "profile_file": str(table)})
    assert "infinitely long" not in " ".join(limits(case.resolve(), {"kind": "solution"}))
    shown = conditions(case.resolve())
    assert (shown["roller, load w"], shown["length"]) == ("2000 N", "10 mm")
    assert shown["mean load per length w"] == "200000 N/m"
    (tmp_path / "case.nml").write_text(case.text)
    assert named_files(tmp_path) == {str(table)}


def test_limits_of_a_result(root):
    settings = pyehl.Case(root / "cases/table1.nml").resolve()
    reported = " ".join(limits(settings, {"kind": "prediction"}))
    assert "Newtonian" in reported
    assert "one track" in reported
    thinning = pyehl.Case(root / "cases/table1.nml", "lubricant.shear_law=eyring").resolve()
    plain = {**thinning, "lubricant": {**thinning["lubricant"], "flow": "newtonian"}}
    for kind in ("prediction", "solution"):
        # flow = 'consistent', unless a case states otherwise
        reported = " ".join(limits(thinning, {"kind": kind}))
        assert "film and waves are Newtonian" not in reported
        assert "film and waves are Newtonian" in " ".join(limits(plain, {"kind": kind}))
    flooded, solved = "The inlet is fully flooded", {"kind": "solution"}
    assert flooded in reported
    starved = (
        pyehl.Case(root / "cases/table1.nml", {"inlet.position_hertz": 1.5}).smooth().resolve()
    )
    assert flooded not in " ".join(limits(starved, solved))
    assert "starved" in " ".join(limits(starved, solved))
    # the page never excludes contact at a boundary film
    boundary = pyehl.Case(root / "cases/table1.nml", "lubricant.boundary_film=4e-8").resolve()
    touching = {"kind": "prediction", "status": "predicted", "contact_load_share": 0.1423}
    for groups, summary, words in (
        (
            boundary,
            touching,
            "Mixed lubrication: 14 % of the load is on the boundary film of 40",
        ),
        (boundary, touching | {"contact_load_share": 0.0}, "There is no solid contact"),
        (boundary, touching | {"contact_load_share": None}, "Whether there is solid contact"),
        (thinning, {"kind": "prediction", "status": "film breakdown"}, "The film ends"),
        (thinning, {"kind": "solution", "status": "converged"}, "there is no mixed lubrication"),
    ):
        assert words in limits(groups, summary)[0]
    # a measured response has no friction
    assert len(limits(thinning, {"kind": "response"})) == 2
    assert warnings({"status": "converged"}) == []
    assert "moes_m" in warnings({"status": "predicted", "outside_range": ["moes_m"]})[0]
