# SPDX-License-Identifier: BSD-3-Clause
"""Cases with every key, and malformed ones, for the record golden_cases.json."""

import re
from pathlib import Path

from pyehl import namelist
from pyehl.case.case import resolve
from pyehl.case.settings import KEYS, MACHINES
from pyehl.errors import InputError

CASES = Path(__file__).resolve().parents[2] / "cases"
# Keys that were added later: for the solver, and of a feature on a line
ADDED = (
    *("alpha_origin", "inlet_law", "table_temperature", "table_pressure", "table_viscosity"),
    "spacing_y",
)
LAW = "&lubricant name = 'n100' temperature = 50.0 /\n"
# Cases in which keys are changed
BASES = {
    "defaults": "",
    "moes": "&contact moes_m = 200.0 moes_l = 6.0 /\n",
    "harmonic": "&surface kind = 'harmonic' wavelength = 0.4 /\n",
    "dent": "&surface kind = 'dent' amplitude = 0.05 /\n",
    "fractal": "&surface kind = 'fractal' /\n",
    "bodies": "&bodies radius_x1 = 0.02 radius_y1 = 0.02 radius_x2 = 0.05 radius_y2 = -0.3 /\n",
    "oil": LAW,
    "sheet": "&lubricant kinematic_viscosity_40 = 95.0 kinematic_viscosity_100 = 10.8 /\n",
    "ellipse": "&contact radius_x = 0.02 radius_y = 0.09 load = 200.0 /\n",
    "two": "&surface kind = 'dent' amplitude = 0.05 / &second_surface kind = 'fractal' /\n",
    "yasutomi": "&lubricant viscosity_law = 'yasutomi' yasutomi_tg0 = -73.86 yasutomi_a1 = 172.8 "
    "yasutomi_a2 = 4.2e-10 yasutomi_b1 = 7.6e-9 yasutomi_b2 = -0.457 yasutomi_c1 = 16.09 "
    "yasutomi_c2 = 17.38 /\n",
    "doolittle": "&lubricant viscosity_law = 'doolittle' doolittle_viscosity = 0.02 "
    "doolittle_temperature = 40.0 doolittle_b = 4.5 doolittle_r0 = 0.66 "
    "doolittle_expansion = -1e-3 tait_modulus = 9e9 tait_rate = 11.0 tait_softening = 6.5e-3 "
    "tait_expansion = 8e-4 tait_temperature = 40.0 /\n",
    "table": "&lubricant table = 'oil.csv' temperature = 60.0 /\n",
}
TABLE = """# measured
temperature_degC, pressure_Pa, viscosity_Pa_s
40, 1e5, 0.06
40, 2e8, 2.1
40, 5e8, 90
40, 4e9, 5e6
100, 4e9, 5e4
100, 1e5, 0.008
100, 5e8, 1.2
"""
BROKEN_TABLES = {
    "no names": "1, 2, 3\n",
    "one pressure": "pressure_Pa,temperature_degC,viscosity_Pa_s\n1e5,40,0.1\n",
    "no ambient": "pressure_Pa,temperature_degC,viscosity_Pa_s\n1e8,40,0.1\n2e8,40,0.2\n",
    "falls": "pressure_Pa,temperature_degC,viscosity_Pa_s\n1e5,40,0.1\n\n2e8,40,0.05\n",
    "twice": "pressure_Pa,temperature_degC,viscosity_Pa_s\n1e5,40,0.1\n1e5,40,0.1\n",
    "word": "pressure_Pa,temperature_degC,viscosity_Pa_s\n1e5,40,0.1\n2e8,forty,0.2\n",
    "huge": "pressure_Pa,temperature_degC,viscosity_Pa_s\n1e5,40,0.1\n2e18,40,0.2\n",
    "short line": "pressure_Pa,temperature_degC,viscosity_Pa_s\n1e5,40,0.1\n2e8,40\n",
    "empty": "# nothing\npressure_Pa,temperature_degC,viscosity_Pa_s\n",
    "one temperature": "pressure_Pa,temperature_degC,viscosity_Pa_s\n1e5,40,0.1\n4e9,40,1e7\n",
}
MORE = {
    "boundary film": "&lubricant boundary_film = 2e-9 boundary_friction = 0.12 /\n"
    "&contact hardness = 4e9 /",
    "viscosity of the glass": BASES["yasutomi"].replace("/", "yasutomi_viscosity = 2e12 /"),
    "rms height": "&surface kind = 'fractal' rms_height = 1e-7 sign = -1 /\n"
    "&second_surface kind = 'fractal' rms_height = 2e-7 sign = -1 /",
    "ranges": "&lubricant name = 'fva3' range_temperature_min = 20.0 range_temperature_max = 90.0 "
    "range_pressure_max = 2e9 /",
    "ground": "&surface finish = 'ground' /",
    "honed, by Rq": "&surface finish = 'honed' rq = 3e-7 /",
    "finish beside a dent": "&surface finish = 'honed' kind = 'dent' /",
    "two heights": "&surface kind = 'fractal' ra = 1e-7 rq = 2e-7 /",
    "Ra of a wave": "&surface kind = 'harmonic' ra = 1e-7 /",
    "two fractal surfaces": "&surface kind = 'fractal' seed = 2147483647 /\n"
    "&second_surface kind = 'fractal' /",
    "feature waits": "&contact slide_to_roll = 0.5 /\n&surface kind = 'bump' amplitude = 0.1 /\n"
    "&second_surface kind = 'harmonic' amplitude_over_film = 0.2 /",
    "feature too early": "&surface kind = 'bump' amplitude = 0.1 x_start = -2.0 /\n"
    "&second_surface kind = 'harmonic' amplitude_over_film = 0.2 /",
    "velocities that do not add up": "&surface velocity_ratio = 1.1 /\n"
    "&second_surface velocity_ratio = 1.0 /",
    "velocity of body 2": "&contact rough_surface = 2 /\n&surface velocity_ratio = 0.93 /",
    "bodies of rubber": "&bodies radius_x1 = 0.01 radius_y1 = 0.01 modulus_1 = 1e6 "
    "poisson_1 = 0.5 / &contact load = 0.01 mean_velocity = 0.01 /",
    "bodies and a radius": "&bodies radius_x1 = 0.01 radius_y1 = 0.01 / &contact radius = 0.02 /",
    "closed gap": "&bodies radius_x1 = 0.01 radius_y1 = 0.01 radius_y2 = -0.005 /",
    "wide ellipse": "&contact radius_x = 0.01 radius_y = 0.6 load = 2e3 /",
    "narrow ellipse": "&contact radius_x = 0.1 radius_y = 0.01 /",
    "one radius": "&contact radius_y = 0.01 /",
    "two kinds of radii": "&contact radius = 0.01 radius_x = 0.01 radius_y = 0.02 /",
    "turned and flooded": "&contact moes_m = 50.0 radius_ratio = 0.2 angle = 30.0 /\n"
    "&grid border = 'flooded' /",
    "turned": "&contact moes_m = 50.0 radius_ratio = 0.2 angle = 30.0 /",
    "side inside an ellipse": "&contact radius_ratio = 0.05 moes_m = 100.0 /\n"
    "&grid y_extent = 2.0 /",
    "very thick film": "&contact moes_m = 0.05 moes_l = 2.0 /",
    "heavy": "&contact moes_m = 5000.0 moes_l = 15.0 /",
    "oil of its own law, Barus": "&lubricant name = 'fva3' viscosity_law = 'barus' /",
    "oil beyond its law": "&lubricant name = 'pao100' temperature = 50.0 /\n&contact load = 1e5 /",
    "sheet and alpha": "&lubricant kinematic_viscosity_40 = 68.0 kinematic_viscosity_100 = 8.7 "
    "pressure_viscosity = 2.1e-8 temperature = 80.0 /",
    "sheet and z": "&lubricant kinematic_viscosity_40 = 68.0 kinematic_viscosity_100 = 8.7 "
    "roelands_z = 0.7 temperature = 60.0 /",
    "heat of the inlet": "&lubricant thermal_reduction = T temperature_viscosity = 0.04 /",
    "isoviscous Moes": "&contact moes_l = 0.0 /\n&lubricant pressure_viscosity = 0.0 /",
    "isoviscous with L": "&contact moes_l = 5.0 /\n&lubricant pressure_viscosity = 0.0 /",
    "water": "&lubricant viscosity = 1e-3 pressure_viscosity = 5e-10 / &contact load = 20.0 /",
    "rows that cannot be halved": "&contact radius_ratio = 0.3 /\n"
    "&grid points = 129 points_y = 131 /",
    "rows": "&contact radius_ratio = 0.3 moes_m = 300.0 / &grid points = 129 /",
    "Fortran numbers": "&Contact LOAD = 1.d2, Radius=.02 / ! end\n&grid\tpoints=+65,/",
    "quotes": "&surface file = 'it''s ! a \"file\"' channel = \"a 'b'\" /",
    "Windows": "&grid\r\n  points = 65\r\n/\r\n",
}


def values(allowed: str, default: str) -> list[str]:
    """Give values of a key to try, other than its default."""
    if "|" in allowed:
        words = [word if word[:1] == "." else f"'{word}'" for word in allowed.split("|")]
        return [word for word in words if word not in (default, "''")]
    if not allowed:
        return ["'scan.x3p'"]
    low, high = (
        float(part) for part in re.findall(r"[-\d.e]+", allowed.removeprefix("0 or "))[-2:]
    )
    usual = float(default) or (max(low, 1e-12) * high) ** 0.5
    tries = [usual * 1.1, usual * 0.9, low, high, 0.0]
    tries = tries if "." in default else [65, 3, 2, 1, -1, 0]
    accepted = [repr(t) for t in tries if low <= t <= high and repr(t) != default]
    return [*accepted[:2], repr(2 * type(tries[0])(high))]


def made(folder: Path) -> dict[str, tuple[str, list[str]]]:
    """Give all cases: text and options by name. `folder` contains their files."""
    (folder / "oil.csv").write_text(TABLE)
    (folder / "scan.x3p").write_bytes((CASES / "scan.x3p").read_bytes())
    for name, table in BROKEN_TABLES.items():
        (folder / f"{name}.csv").write_text(table)
    result = {f"base: {name}": (text, list[str]()) for name, text in BASES.items()}
    result |= {f"more: {name}": (text, []) for name, text in MORE.items()}
    for name in BROKEN_TABLES:
        result[f"table: {name}"] = (f"&lubricant table = '{name}.csv' /", [])
    result["table: at its temperature"] = (
        "&lubricant table = 'one temperature.csv' temperature_viscosity = 0.03 /", []
    )  # fmt: skip
    for path in sorted(CASES.glob("*.nml")):
        result[f"file: {path.name}"] = (path.read_text(), [])
    for base, text in BASES.items():
        written = resolve(text, str(folder / "case.nml"))
        for key in (k for k in KEYS.values() if k.group not in MACHINES):
            for number, value in enumerate(values(key.allowed, key.default)):
                option = f"{key.name}={value}"
                result[f"{base}: {option}"] = (text, [option])
                if number == 0 and base not in ("defaults", "moes"):
                    result[f"written {base}: {option}"] = (written, [option])
    return result


def outcome(text: str, options: list[str], folder: Path) -> list[str] | str:
    """Give the resolved case, or the message of its refusal."""
    try:
        resolved = resolve(text, str(folder / "case.nml"), options)
    except InputError as error:
        return without_places(str(error), folder)
    return lines(without_places(resolved, folder))


def without_places(text: str, folder: Path) -> str:
    """Replace the folder of the case, and the current one, against which options resolve names."""
    text = text.replace(str(folder), "FOLDER").replace(str(Path.cwd()), "CURRENT")
    # a group and a key that were added later
    text = text.replace("y_start, spacing_y, file", "y_start, file")
    return text.replace("&lubricant, &inlet,", "&lubricant,").replace(
        "lubricant, inlet,", "lubricant,"
    )


def lines(resolved: str) -> list[str]:
    """Give the lines ``group.key = value mark`` of a resolved case."""
    result, group = [], ""
    for line in resolved.splitlines():
        if line[:1] == "&":
            group = line[1:]
        elif (match := namelist.LINE.fullmatch(line)) and match[1] not in ADDED:
            mark = next((m for m in ("default", "derived") if line.endswith(f"! {m}")), "given")
            result.append(f"{group}.{match[1]} = {match[2]} {mark}")
    return result
