# SPDX-License-Identifier: BSD-3-Clause
"""The table of quantities agrees with the code that writes summaries."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import pyehl
from pyehl import schema
from pyehl.case import KEYS
from pyehl.case.settings import GROUPS
from pyehl.contact.film_formulas import sheet

UNITS = {"_N_per_m": "N/m", "_N_m": "N m", "_Pa_s": "Pa s", "_per_Pa": "1/Pa",
         "_m_per_s": "m/s", "_per_s": "1/s", "_Pa": "Pa", "_seconds": "s", "_N": "N", "_K": "K",
         "_m": "m"}  # fmt: skip


def names(kind: str) -> set[str]:
    return {q.name for q in schema.QUANTITIES if kind in q.kinds}


def test_every_quantity_once():
    listed = [q.name for q in schema.QUANTITIES]
    assert len(listed) == len(set(listed))
    assert all(q.meaning and q.kinds for q in schema.QUANTITIES)


def test_names_end_in_their_unit():
    for q in schema.QUANTITIES:
        end = next((end for end in UNITS if q.name.endswith(end)), None)
        if end and q.name != "moes_m":
            assert q.unit == UNITS[end], q.name
        if q.unit in ("m", "Pa", "N", "K"):
            assert end, q.name


DOMAIN = "&grid points = 33 x_inlet = -2.5 x_outlet = 1.5 y_extent = 2.0 /\n"
MOES = f"&contact moes_m = 100.0 moes_l = 5.0 /\n{DOMAIN}"
SI = f"&contact load = 20.0 /\n{DOMAIN}"
WAVE = "&surface kind = 'harmonic' amplitude_over_film = 0.1 wavelength = 1.0 {} /\n"
SECOND = WAVE.format("").replace("surface", "second_surface")
HEATED = (
    "&lubricant thermal_reduction = .true. temperature = 60.0 kinematic_viscosity_40 = 68.0 "
    "kinematic_viscosity_100 = 8.7 density_15 = 880.0 /\n"
)
MAP = "kind = 'map' file = '{}' length_x = 1e-4 length_y = 1e-4"
SOLUTIONS = {
    "smooth": MOES,
    "domain far too small": (
        "&contact moes_m = 5.0 moes_l = 5.0 /\n"
        "&grid points = 33 x_inlet = -1.2 x_outlet = 1.2 y_extent = 1.2 border = 'zero' /\n"
    ),
    "no solution": f"{MOES}&solver max_cycles = 1 /\n",
    "oil begins": (
        "&contact moes_m = 100.0 moes_l = 5.0 /\n&inlet position_hertz = 1.5 /\n"
        "&grid points = 33 /\n"
    ),
    "layer that arrives": f"{MOES}&inlet film_hertz = 0.05 passages = 2 /\n",
    "heated": SI + HEATED,
    "heat of friction": SI + HEATED.replace("thermal_reduction = .true.", "shear_law = 'eyring'"),
    "oil by name": SI + "&lubricant name = 'fva3' /\n",
    "contact at a boundary film": (
        f"{SI.replace('20.0', '20.0 hardness = 3e9')}&lubricant boundary_film = 1e-7 /\n"
    ),
    "ellipse": "&contact load = 20.0 radius_x = 0.01 radius_y = 0.02 /\n&grid points = 33 /\n",
    "line": "&contact shape = 'line' /\n&grid points = 129 /\n",
    "roller": "&contact shape = 'roller' length = 0.002 load = 400.0 /\n&grid points = 65 /\n",
    "line by Moes numbers": "&contact shape = 'line' moes_m_line = 5.0 /\n&grid points = 129 /\n",
    "duty": SI + "&duty periodic = .true.\n   time = 0.0, 1e-6, 2e-6\n"
    "   load = 20.0, 19.0, 20.0\n/\n",
    "duty with a boundary film": f"{SI}&lubricant boundary_film = 1e-8 /\n"
    "&duty time = 0.0, 1e-6\n   load = 20.0, 19.0\n/\n",
    "wave": SI + WAVE.format(""),
    "mean that has not settled": f"{MOES}{WAVE.format('')}&time max_periods = 1 /\n",
    "at rest": SI + WAVE.format("velocity_ratio = 0.0"),
    "dent": f"{SI}&surface kind = 'dent' amplitude_over_film = 0.3 width = 1.0 /\n",
    "map": f"{SI}&surface {MAP} detrend = 'tilt' /\n&time steps = 2 /\n",
    "two maps": (
        f"{SI}&surface {MAP} detrend = 'tilt' /\n&second_surface {MAP} detrend = 'tilt' /\n"
        "&time steps = 2 /\n"
    ),
    "two waves without a common period": (
        f"{MOES}{WAVE.format('velocity_ratio = 1.6137')}{SECOND}"
        "&time max_periods = 6 start = 'prediction' /\n"
    ),
    "pure rolling": (
        f"{MOES}{WAVE.format('velocity_ratio = 1.0')}"
        f"{SECOND.replace('0.1', '0.1 velocity_ratio = 1')}&time steps = 2 /\n"
    ),
    "second surface at rest alone": f"{MOES}{SECOND.replace('0.1', '0.1 velocity_ratio = 0')}",
}


def test_solutions(tmp_path: Path):
    """Everything that runs of all kinds put into a summary, and nothing else."""
    np.save(tmp_path / "map.npy", 1e-9 * np.random.default_rng(1).standard_normal((16, 16)))
    written = set()
    for name, text in SOLUTIONS.items():
        case = pyehl.Case.from_text(text.format(tmp_path / "map.npy", tmp_path / "map.npy"))
        pyehl.solve(case, output=tmp_path / name, check=False)
        written |= set(json.loads((tmp_path / name / "summary.json").read_text()))
    assert written == names("solution")


def brief(text: str) -> dict[str, object]:
    return pyehl.predict(pyehl.Case.from_text(text), tracks=2).summary


def test_predictions():
    rough = "&surface kind = 'fractal' pixels = 32 length_x = 1e-4 length_y = 1e-4 /\n"
    ellipse = "&contact load = 20.0 radius_x = 0.01 radius_y = 0.02 /\n"
    alone, oval, both = (
        {*brief(text), "files"}  # the folder lists them
        for text in (rough, ellipse + rough, rough + rough.replace("surface", "second_surface"))
    )
    boundary = "&contact load = 20.0 /\n&lubricant boundary_film = 1e-9 /\n"
    held = {*brief(boundary + rough)}
    line = "&contact shape = 'line' load_per_length = 1e5 radius = 0.01 mean_velocity = 0.5 /\n"
    strip = {*brief(line + rough)}
    assert alone | oval | both | held | strip == names("prediction")
    of_two = {n for n in names("prediction") if n.startswith("second_")}
    assert both - alone == of_two | {"surface_rms_m", "surface_slope", "surface_correlation"}


def test_film_sheets():
    written = set()
    shapes = "&contact radius_x = 0.01 radius_y = 0.02 /", "&contact shape = 'line' /"
    for text in (*(f"&surface kind = '{k}' /" for k in ("smooth", "harmonic", "fractal")), *shapes):
        written |= set(sheet(pyehl.Case.from_text(text).resolve()))
    assert written == names("film")


def test_both_drivers_write_the_version_of_the_schema(drive, tmp_path: Path):
    (tmp_path / "case.nml").write_text(MOES)
    summaries = []
    for driver in ("ehl", "pyehl"):
        assert drive(driver, "case.nml", "-o", driver).returncode == 0
        text = (tmp_path / driver / "summary.json").read_text()
        values = json.loads(text)
        assert list(values)[:2] == ["kind", "schema_version"]
        summaries.append({k: v for k, v in values.items() if k not in ("wall_seconds", "files")})
    assert summaries[1] | summaries[0] == summaries[1]
    assert summaries[0]["schema_version"] == schema.VERSION
    (tmp_path / "pyehl" / "summary.json").write_text(
        text.replace(f'"schema_version": {schema.VERSION}', '"schema_version": 99')
    )
    with pytest.raises(pyehl.InputError, match="results of schema 99"):
        pyehl.load(tmp_path / "pyehl")


def test_reference_has_the_table(root: Path):
    text = (root / "docs/reference/results.md").read_text(encoding="utf-8")
    listed = text.partition("## All names\n\n")[2].rstrip("\n")
    assert listed == schema.markdown(), "put what schema.markdown() gives below 'All names'"
    assert len(listed.splitlines()) == 2 + len(schema.QUANTITIES)


def test_sources_name_keys_that_exist(root: Path):
    """A misspelt name in `given` or `refuse` would be no key."""
    groups = "|".join(GROUPS)
    named = set()
    for path in [
        *(root / "fortran" / "case").glob("*.f90"),
        *(root / "pyehl" / "case").glob("*.py"),
    ]:
        text = path.read_text()
        result = re.findall(r'given\("(\w+)", "(\w+)"\)', text)
        result += re.findall(rf'"({groups})\.(\w+)"', text)
        named |= {f"{group}.{name}" for group, name in result}
    assert len(named) > 50
    assert named - set(KEYS) == set()
