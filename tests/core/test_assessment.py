# SPDX-License-Identifier: BSD-3-Clause
"""The last lines of a result, its assessment, and the words for codes of the library."""

import re
from pathlib import Path
from typing import Any

import pytest

from pyehl.assessment import HOLDS, MUCH_MASS_DEFECT, NO_RESULT, WITH_CARE, assess
from pyehl.conclusion import conclude
from pyehl.reasons import REASONS

GOOD = {"status": "converged", "H_c": 0.02, "H_c_error": 1e-4, "h_min_m": 3e-8}
FULL = "full film: the minimum film is 30.0 nm: Lambda = 3 with an rms roughness of 10.0 nm"


def test_codes_are_those_of_the_library(root: Path):
    text = (root / "fortran/base/reason.f90").read_text()
    codes = dict(re.findall(r"((?:reason|friction)_\w+) = (\d+)", text))
    assert len(codes) > 30
    assert {int(code) for name, code in codes.items() if name != "reason_none"} == set(REASONS)
    touching = (root / "fortran/reynolds/touching.f90").read_text()
    assert f"much_mass_defect = {MUCH_MASS_DEFECT}_dp" in touching


def test_no_solution():
    none: dict[str, Any] = {"status": "cycle limit", "H_c": None}
    stated = "assessment no result: the status is 'cycle limit'"
    assert str(conclude(none)) == stated
    assert str(conclude(none | {"message": "too coarse"})) == f"{stated}: too coarse"


@pytest.mark.parametrize(
    ("shape", "words"),
    [
        ({}, "the contact radius is 0.20 of the radius of curvature (p_h/E' = 0.064)"),
        (
            {"shape": "line"},
            "the half width of the contact is 0.20 of the radius of curvature (p_h/E' = 0.050)",
        ),
    ],
)
def test_wide_contact(shape: dict[str, str], words: str):
    """Hertz: p_h/E' is a/(pi R) of a circle, and b/(4 R) of a line."""
    values = GOOD | {"hertz_radius_m": 1e-4, "film_scale_m": 2e-5} | shape
    assert words in assess(values).text


def test_smooth_contact_without_a_size():
    values = {
        "status": "converged",
        "H_c": 0.024369,
        "H_c_error": 0.000266,
        "H_min": 0.008315,
        "H_min_error": None,
    }
    assert str(conclude(values)) == (
        "H_c        0.02437 +- 0.00027 (grid)\n"
        "H_min      0.008315, error not known\n"
        "assessment full film: smooth surfaces; the case gives no size in metres; but the error of "
        "H_min is not known"
    )


def test_last_lines():
    values: dict[str, Any] = {
        "status": "converged",
        "H_c": 0.024369,
        "H_c_error": 0.0266,
        "h_c_m": 233.6e-9,
        "h_c_error_m": 255e-9,
        "P_max": 1.0049,
        "p_max_Pa": 1.0215e9,
        "p_max_rough_Pa": 1.0684e9,
        "mu_ratio": 1.1849,
        "mu_ratio_error": 0.0484,
        "lambda_ratio": 1.59,
        "lambda_ratio_central": 4.67,
        "mu": 0.04,
        "mu_smooth": 0.0338,
        "shear_law": "eyring",
    }
    lines = conclude(values).lines
    assert lines["H_c"] == "0.024 +- 0.027, h_c 234 +- 255 nm (grid)"
    assert lines["p_max"] == "1.0049 p_h, error not known, 1.0215 GPa; rough 1.0684 GPa"
    assert lines["mu_r/mu_s"] == "1.185 +- 0.048 (grid)"
    assert lines["Lambda"].startswith("1.590 (h_c/sigma 4.670), smooth films")
    assert lines["mu"] == "0.04000, smooth contact 0.03380; law 'eyring'"
    values |= {"mu_ratio_error": None, "mu_ratio_error_note": "no coarser run"}
    assert conclude(values).lines["mu_r/mu_s"] == "1.18490, error not known: no coarser run"
    # as in a prediction
    values |= {"P_max": None, "p_rise_max_Pa": 8.53e7}
    assert conclude(values).lines["p_max"] == (
        "1.0215 GPa; rough 1.0684 GPa, up to 0.0853 GPa above the smooth contact, error not known"
    )
    values |= {"p_max_rough_Pa": None, "p_rise_max_error_Pa": 1.2e7}
    assert conclude(values).lines["p_max"] == (
        "1.0215 GPa; rough 0.085 +- 0.012 GPa above the smooth contact (model)"
    )


@pytest.mark.parametrize(
    ("more", "words", "confidence"),
    [
        ({}, FULL, HOLDS),
        ({"H_c_error": 0.002}, f"{FULL}; but H_c is uncertain by 10 %", WITH_CARE),
        ({"flash_temperature_K": 40.0}, "but the flash temperature rise is 40.0 K", WITH_CARE),
        # the friction then includes the heat
        ({"flash_temperature_K": 40.0, "temperature_rise_max_K": 60.0}, FULL, HOLDS),
        ({"status": "target missed"}, f"{FULL}; but grid.target_error is missed", WITH_CARE),
        ({"lambda_ratio": 0.8}, "thin film: Lambda = 0.800 is below 1", WITH_CARE),
        (
            {"lambda_ratio": 0.8, "h_min_rough_m": 3.4e-9},
            "thin film: the minimum film over the roughness is 3.40 nm, below 10 nm",
            WITH_CARE,
        ),
        (
            {"h_min_rough_m": 3.4e-9, "p_max_Pa": 1e9, "p_max_rough_Pa": 4.5e9},
            "beyond the solids: the pressure reaches 4.50 GPa",
            WITH_CARE,
        ),
        (
            {"mu_ratio": 1.2, "mu_ratio_error": 0.01, "mu_ratio_unresolved": -0.12},
            "unresolved waves: they hold 10 % of mu_r/mu_s by prediction",
            WITH_CARE,
        ),
        (
            {"mu_ratio": 1.2, "mu_ratio_unresolved": None, "variance_unresolved": 0.3},
            "unresolved waves: they hold 30 % of the variance",
            WITH_CARE,
        ),
        (
            {"status": "film breakdown", "message": "5 nm below zero"},
            "film breakdown: 5 nm below zero",
            NO_RESULT,
        ),
        # of a run: the roughness, with a solved smooth contact; otherwise the smooth contact
        (
            {"status": "negative film", "message": "5 nm below zero"},
            "film breakdown: 5 nm below zero",
            NO_RESULT,
        ),
        (
            {"status": "negative film", "message": "5 nm below zero", "H_c": None},
            "no result: the status is 'negative film': 5 nm below zero",
            NO_RESULT,
        ),
        (
            {"H_c_error_note": "the grid does not resolve the inlet, and", "h_min_m": 2e-9},
            "unresolved inlet: the grid does not resolve the inlet, and",
            WITH_CARE,
        ),
        (
            {"pressure_viscosity_note": "alpha = 1 is an estimate"},
            "but alpha is an estimate (-17 to +12 % of the film)",
            WITH_CARE,
        ),
        (
            {"pressure_viscosity_note": "alpha = 1 is the default"},
            "but alpha is that of another oil",
            WITH_CARE,
        ),
    ],
)
def test_assessment(more: dict[str, Any], words: str, confidence: str):
    """Each limitation of a result has a word, and the most severe one is first."""
    result = assess(GOOD | more)
    assert words in result.text
    assert result.confidence == confidence
