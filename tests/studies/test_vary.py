# SPDX-License-Identifier: BSD-3-Clause
"""Variations of a study: texts after --vary, study files, cases in the order of the table."""

from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl import InputError
from pyehl.case import KEYS
from pyehl.given import option
from pyehl.studies.study import ECHOED, RESULTS, Axis, Study, axis, make, parse_axis, read_study


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("a.b=0.01:1:3log", (0.01, 0.1, 1.0)),
        ("a.b=1:1000:4log", (1, 10, 100, 1000)),
        ("a.b=0:1:5", (0.0, 0.25, 0.5, 0.75, 1.0)),
        ("a.b=0.5:0.1:3", (0.5, 0.3, 0.1)),
        ("a.b=1:4", (1, 2, 3, 4)),
        ("a.b=-1:1", (-1, 0, 1)),
        ("a.b=2.5", (2.5,)),
        ("a.b=3,1,2", (3, 1, 2)),
        ("a.b=1,2.5", (1.0, 2.5)),
        ("a.b=.true.,.false.", (True, False)),
        ("a.b=roelands,'barus'", ("roelands", "barus")),
        (" A.B = 1e-3, 2e-3 ", (1e-3, 2e-3)),
        ("a.b=7:7:1log", (7,)),
    ],
)
def test_texts(text: str, values: tuple[object, ...]):
    result = parse_axis(text)
    assert result.key == "a.b"
    assert result.values == values
    assert {type(v) for v in result.values} == {type(v) for v in values}


@pytest.mark.parametrize(
    ("text", "states"),
    [
        ("a.b", "expected group.key=VALUES"),
        ("a.b=", "expected group.key=VALUES"),
        ("=1:2", "expected group.key=VALUES"),
        ("a.b=1:2:3:4", "neither two nor three"),
        ("a.b=0:1:5log", "two positive numbers"),
        ("a.b=1:2:0", "0 values"),
        ("a.b=1:2:9999999", "9999999 values"),
        ("a.b=5:1", "less than the first"),
        ("a.b=0.5:2", "expected start:stop:count"),
        ("a.b=1:2:many", "expected start:stop:count"),
        ("a.b=1:inf:3", "not finite"),
        ("a.b=1,,2", "a value is missing"),
        ("a.b=1,red", "numbers and words"),
    ],
)
def test_texts_that_are_refused(text: str, states: str):
    with pytest.raises(InputError) as refusal:
        parse_axis(text)
    assert states in str(refusal.value)


def test_values_of_python():
    assert axis("a.b", np.geomspace(1.0, 4.0, 3)).values == pytest.approx((1.0, 2.0, 4.0))
    assert axis("a.b", range(2)).values == (0, 1)
    assert axis("a.b", "1:3").values == (1, 2, 3)
    assert axis("a.b", 2.0).values == (2.0,)
    for wrong in ([], [None], [[1.0]]):
        with pytest.raises(InputError):
            axis("a.b", wrong)


def test_options_have_the_values_of_a_case_file():
    assert option("a.b", True) == "a.b=.true."
    assert option("a.b", 1e-5) == "a.b=1e-05"
    assert option("a.b", 0.1 + 0.2) == "a.b=0.30000000000000004"
    assert option("a.b", "word") == "a.b=word"
    assert axis("a.b", """'', 'it''s', " x" """).values == ("", "it's", " x")


@pytest.mark.parametrize(
    "text", ["", " x", " x ", "Height ", "'q'", '"', "it's", "a,b!/", "\t", "'"]
)
def test_options_keep_quotes_blanks_and_emptiness(text: str):
    case = pyehl.Case(surface={"channel": text})
    for made in (
        case,
        case.with_options({"grid.points": 65}),
        pyehl.Case.from_text("", {"surface.channel": text}),
        pyehl.Case.from_text("", "surface.channel='" + text.replace("'", "''") + "'"),
        pyehl.Case.from_text(case.text),
    ):
        assert made.resolve()["surface"]["channel"] == text


def study(*texts: str, zipped: bool | list[list[str]] = False) -> Study:
    return make("c.nml", [parse_axis(text) for text in texts], zipped=zipped)


def test_the_last_key_is_the_fastest():
    points = list(study("a.x=1:2", "a.y=1:3").points())
    assert [p.values for p in points[:4]] == [
        {"a.x": 1, "a.y": 1},
        {"a.x": 1, "a.y": 2},
        {"a.x": 1, "a.y": 3},
        {"a.x": 2, "a.y": 1},
    ]
    assert [p.number for p in points] == list(range(6))
    assert points[5].index == (1, 2)


def test_keys_that_move_together():
    together = study("a.x=1:2", "a.y=3:4", zipped=True)
    assert together.shape == (2,)
    assert [p.values for p in together.points()] == [{"a.x": 1, "a.y": 3}, {"a.x": 2, "a.y": 4}]
    again = study("a.x=1,1,2", "a.y=3,4,3", zipped=True)
    assert [tuple(p.values.values()) for p in again.points()] == [(1, 3), (1, 4), (2, 3)]
    partly = study("a.x=1:2", "a.z=1:3", "a.y=3:4", zipped=[["a.x", "a.y"]])
    assert partly.shape == (2, 3)
    assert partly.keys == ["a.x", "a.y", "a.z"]


@pytest.mark.parametrize(
    ("make_it", "states"),
    [
        (study, "nothing is varied"),
        (lambda: study("a.x=1:2", "a.x=3"), "varied twice"),
        (lambda: study("a.x=1,2,1"), "a.x: the value 1 is given twice"),
        (lambda: study("a.x=1,2,1", "a.y=3,4,3", zipped=True), "a.x, a.y: the value 1, 3 is"),
        (lambda: study("a.x=1:2", "a.y=1:3", zipped=True), "a.x 2, a.y 3"),
        (lambda: study("a.x=1:2", zipped=[["a.xx"]]), "did you mean 'a.x'"),
        (lambda: make("c", [axis("a.x", [1])], run="predct"), "did you mean 'predict'"),
        (lambda: make("c", [axis("a.x", [1])], options=["a.x=2"]), "varied and set"),
        (lambda: study("a.x=1:2000", "a.y=1:2000"), "4000000 cases"),
    ],
)
def test_studies_that_are_refused(make_it, states: str):
    with pytest.raises(InputError) as refusal:
        make_it()
    assert states in str(refusal.value)


def test_study_file(tmp_path: Path):
    path = tmp_path / "study.toml"
    path.write_text(
        """case = "sub/c.nml"
        run = "predict"
        zip = [["contact.load", "contact.mean_velocity"]]
        outputs = ["mu_ratio"]
        [set]
        "grid.points" = 65
        lubricant.viscosity_law = "barus"
        [vary]
        "contact.load" = "100:300:3"
        contact.mean_velocity = [0.1, 0.2, 0.3]
        surface.seed = "1:2"
        """
    )
    result = make(**read_study(path))
    assert result.case == str(tmp_path / "sub" / "c.nml")
    assert result.options == ("grid.points=65", "lubricant.viscosity_law=barus")
    assert result.shape == (3, 2)
    assert result.outputs == ("mu_ratio",)
    assert result.run == "predict"


@pytest.mark.parametrize(
    ("text", "states"),
    [
        ("case = 'c.nml'\nvari = 1", "did you mean 'vary'"),
        ("vary = {}", "there is no 'case'"),
        ("case = 1", "expected: a text"),
        ("case = 'c.nml'\nvary = [1]", "expected: a table"),
        ("case = 'c.nml'\nzip = 1", "true, false or lists"),
        ("case = 'c.nml'\n[vary]\n'a.b' = '1:x'", "a.b = '1:x'"),
        ("case = ", "Invalid value"),
    ],
)
def test_study_files_that_are_refused(tmp_path: Path, text: str, states: str):
    path = tmp_path / "study.toml"
    path.write_text(text)
    with pytest.raises(InputError) as refusal:
        make(**read_study(path))
    assert states in str(refusal.value)
    assert "study.toml" in str(refusal.value)


def test_more_values_than_a_study_can_have_are_not_collected():
    """A range of this many takes no memory, a list of them would."""
    taken = iter(range(10**9))
    with pytest.raises(InputError, match="more than 1000000 values"):
        axis("surface.seed", taken)
    assert next(taken) == 1_000_001


def test_dimensions_have_plain_names():
    """Those of their keys; with the group if another key or a result has that name."""
    for keys, names in (
        (["contact.load", "contact.mean_velocity"], ["load", "mean_velocity"]),
        (["contact.moes_m", "surface.seed"], ["moes_m", "seed"]),
        (["grid.points", "time.steps"], ["grid_points", "time_steps"]),
        (["surface.rq", "second_surface.rq"], ["surface_rq", "second_surface_rq"]),
    ):
        axes = [Axis(key, (1.0, 2.0)) for key in keys]
        assert list(make(pyehl.Case(), axes).names.values()) == names
    for key in KEYS.values():
        (name,) = make(pyehl.Case(), [Axis(key.name, (1.0, 2.0))]).names.values()
        assert name.isidentifier()
        assert name not in RESULTS or key.name in ECHOED
