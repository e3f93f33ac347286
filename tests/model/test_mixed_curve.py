# SPDX-License-Identifier: BSD-3-Clause
"""The curve from boundary to full film: prediction and simulation agree."""


def test_prediction_and_simulation_along_a_curve(script):
    make = script("docs/evidence/mixed_curve/make.py")
    compared = [row for row in make.rows() if row[f"{make.SHARE}_ehl"]]
    assert len(compared) == 5
    for row in compared:
        share, error, other, other_error = (
            float(row[make.SHARE + end]) for end in ("", "_error", "_ehl", "_ehl_error")
        )
        assert abs(share - other) <= error + other_error
        films = [float(row[name]) for name in (make.FILM, "h_min_rough_ehl_m")]
        assert abs(films[0] / films[1] - 1.0) < 0.065
    assert max(float(row[make.SHARE]) for row in compared) > 0.7
