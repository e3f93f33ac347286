# SPDX-License-Identifier: BSD-3-Clause
"""``pyehl fit-lubricant``: laws that made a traction curve are found from it; refusals."""

import json
from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl import InputError, cli, schema
from pyehl.studies.shear_fit import weights

RATIOS = (0.01, 0.02, 0.05, 0.1, 0.2)
CASE = (
    "&contact load = 50.0 mean_velocity = 2.0 radius = 0.01 /\n"
    "&lubricant name = 'fva3' temperature = 60.0 /\n"
)


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "case.nml"
    path.write_text(CASE)
    return path


def curve(case: Path, noise: float = 0.0, **law: object) -> list[tuple[float, float]]:
    """Friction of solved contacts with a law, with relative noise."""
    random = np.random.default_rng(1)
    result = []
    for ratio in RATIOS:
        options = {"contact.slide_to_roll": ratio, "grid.points": 65}
        options |= {f"lubricant.{key}": value for key, value in law.items()}
        mu = float(pyehl.solve(case, options).mu)
        result.append((ratio, mu * (1.0 + noise * random.standard_normal())))
    return result


def write(path: Path, rows: list[tuple[float, float]]) -> Path:
    lines = ["contact.slide_to_roll,mu", *(f"{a!r},{b!r}" for a, b in rows)]
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize(
    "law",
    [
        {"shear_law": "eyring", "eyring_stress": 6.3e6},
        {"shear_law": "limiting", "limiting_coefficient": 0.045},
        {"shear_law": "carreau", "carreau_stress": 4e6, "carreau_exponent": 0.4},
    ],
    ids=lambda law: str(law["shear_law"]),
)
@pytest.mark.long
def test_the_law_behind_a_curve_is_found(case: Path, tmp_path: Path, law: dict[str, object]):
    data = write(tmp_path / "data.csv", curve(case, **law))
    name = str(law["shear_law"])
    fit = pyehl.fit_lubricant(data, case, law=name, points=65)
    assert {p.key: p.value for p in fit.parameters} == pytest.approx(
        {key: value for key, value in law.items() if key != "shear_law"}, rel=5e-3
    )
    assert fit.residual_rms < 1e-3 * fit.measured.mean()


def test_noise_is_in_the_confidence(case: Path, tmp_path: Path):
    """With noise of 2 % the interval contains the true value, and is as wide as expected."""
    data = write(tmp_path / "data.csv", curve(case, 0.02, shear_law="eyring", eyring_stress=6.3e6))
    (stress,) = pyehl.fit_lubricant(data, case, points=65).parameters
    assert stress.low < 6.3e6 < stress.high
    # d ln mu/d ln tau_0 is 1 - 1/asinh(...), some 0.7 to 0.9; t of 4 degrees of freedom is 2.78
    width = 0.5 * np.log(stress.high / stress.low)
    assert 0.25 * 2.78 * 0.02 / np.sqrt(5) < width < 4.0 * 2.78 * 0.02 / np.sqrt(5)


def test_the_folder(case: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    data = write(tmp_path / "data.csv", curve(case, shear_law="eyring", eyring_stress=6.3e6))
    out = tmp_path / "out"
    words = ["fit-lubricant", str(data), "--case", str(case), "--points", "65", "-o", str(out)]
    assert cli.main(words) == 0
    printed = capsys.readouterr().out
    assert "&lubricant\n   shear_law = 'eyring'\n   eyring_stress = 6" in printed
    summary = json.loads((out / "summary.json").read_text())
    assert sorted(path.name for path in out.iterdir()) == summary["files"]
    assert set(summary) == {q.name for q in schema.QUANTITIES if "fit" in q.kinds}
    # the printed keys make a valid case, with the friction of the table
    pasted = tmp_path / "pasted.nml"
    law = (out / "lubricant.nml").read_text().split("\n", 1)[1]
    pasted.write_text(CASE.replace("temperature = 60.0 /", f"temperature = 60.0\n{law}"))
    options = {"contact.slide_to_roll": RATIOS[2], "grid.points": 65}
    table = np.genfromtxt(out / "fit.csv", delimiter=",", names=True)
    assert float(pyehl.solve(pasted, options).mu) == pytest.approx(table["mu_fitted"][2], rel=1e-4)
    assert cli.main(words) == 0, "its own results are replaced"
    (out / "notes.txt").write_text("mine")
    assert cli.main(words) == 2
    assert (out / "notes.txt").read_text() == "mine"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("slip,mu\n0.1,0.05\n", ["data.csv:1:", "contact.slide_to_roll"]),
        ("contact.slide_to_roll,mu_ratio\n0.1,1.05\n", ["data.csv:1:", "mu"]),
        ("contact.slide_to_roll,mu\n0.1,0.05\n0.2,x\n", ["data.csv:3:", "mu = 'x'"]),
        ("contact.slide_to_roll,mu\n0.1,0.05\n", ["1 measured points", "more points"]),
        ("contact.slide_to_roll,mu\n0.1,0.05\n3.0,0.05\n", ["at most 2"]),
        ("contact.slide_to_roll,mu\n0.1,0.05\n0.2,-0.05\n", ["above 0"]),
        ("contact.slide_to_roll,mu,error\n0.1,0.05,1e-3\n0.2,0.06,0\n", [":3:", "error = '0'"]),
        ("", ["data.csv:1:", "none"]),
    ],
)
def test_bad_data(case: Path, tmp_path: Path, text: str, words: list[str]):
    data = tmp_path / "data.csv"
    data.write_text(text)
    with pytest.raises(InputError) as raised:
        pyehl.fit_lubricant(data, case, output=tmp_path / "out")
    assert all(word in str(raised.value) for word in words), raised.value
    assert not (tmp_path / "out").exists()


def test_weights_are_not_dropped():
    """An error of zero refuses a fit; if all are zero, the errors are taken as unknown."""
    assert (weights(np.zeros(3)) == 1.0).all()
    assert weights(np.array([0.1, 0.2])) == pytest.approx([10.0, 5.0])
    for wrong in (0.0, -0.1):
        with pytest.raises(InputError, match="expected: errors above 0"):
            weights(np.array([0.1, wrong]))


def test_bad_arguments(case: Path, tmp_path: Path):
    data = write(tmp_path / "data.csv", [(0.1, 0.05), (0.2, 0.06)])
    with pytest.raises(InputError, match="did you mean 'eyring'"):
        pyehl.fit_lubricant(data, case, law="eyrin")
    with pytest.raises(InputError, match="no sliding speed"):
        pyehl.fit_lubricant(data, pyehl.Case.from_text("&contact moes_m = 200.0 /"))
    with pytest.raises(InputError, match=r"grid\.points = 66"):
        pyehl.fit_lubricant(data, case, points=66)
