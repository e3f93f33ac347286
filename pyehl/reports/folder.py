# SPDX-License-Identifier: BSD-3-Clause
"""The report of a result folder."""

import json
import os
import platform
from collections.abc import Mapping
from importlib import metadata
from pathlib import Path
from typing import Any

import xarray as xr

from pyehl import library, namelist
from pyehl.destination import check_files, file_errors
from pyehl.errors import FileError, InputError
from pyehl.given import path_of
from pyehl.machines.perform import CASE
from pyehl.plots.folder import plot
from pyehl.plots.style import png
from pyehl.reports import browser, page
from pyehl.reports.assessment import Assessment, assess, numbers_of
from pyehl.reports.conditions import conditions, numbers
from pyehl.reports.limits import limits, warnings
from pyehl.reports.machine import KINDS as MACHINES
from pyehl.reports.machine import machine_parts
from pyehl.reports.page import Block
from pyehl.reports.stress import stress_of, stress_parts
from pyehl.reports.study import study_parts
from pyehl.results import load, settings_of
from pyehl.schema import QUANTITIES
from pyehl.studies.journal import NAME, read_header

# Maximum size of a page [bytes]; the dots per inch of its pictures are reduced to keep it
MAX_BYTES = 2_000_000
# Keys that name a file
FILES = ("file", "table", "profile_file", "profile_file_2")
EXPECTED = "expected: what -o of run, predict, stribeck, sweep, bearing, gear or response named"
DOTS = (120, 100, 80, 60, 45)
PICTURES = {
    "centre_lines": "Pressure and film through the centre, along and across the motion",
    "film": "Film as interference fringes and as contours",
    "deformed_roughness": "Roughness before and in the contact",
    "rough_and_smooth": "Pressure and film of the rough contact beside those of the smooth one",
    "friction": "μ_r/μ_s over the time of the run",
    "extremes": "Maximum pressure and minimum film during the run",
    "surface_spectrum": "The surface, its spectrum, and its deformed spectrum",
    "roughness": "Roughness before and in the contact",
    "passage": "μ_r/μ_s over the passage of the surface, and contributions of octaves",
}
CITATION = (
    "pyehl {version}: elastohydrodynamically lubricated point and line contacts with rough "
    "surfaces, by the pyehl developers.",
    "Y. Zhang, N. Biboulet, C.H. Venner & A.A. Lubrecht, Prediction of the Stribeck curve under "
    "full-film elastohydrodynamic lubrication, Tribology International 2019, doi "
    "10.1016/j.triboint.2019.01.028 (the method).",
)


def report(
    folder: str | os.PathLike[str],
    output: str | os.PathLike[str] | None = None,
    *,
    stress: str | os.PathLike[str] | bool | None = None,
    pdf: bool = False,
) -> Path:
    """Write a result as one HTML page, which needs neither network nor pyehl.

    The page has the conditions (in SI units and in Moes numbers), results with errors and an
    assessment, pictures, tables, warnings, limits that apply, the case file, versions, and how to
    cite. Folder names of this machine are removed.

    Parameters
    ----------
    folder
        Result folder of ``run``, ``predict``, ``stribeck``, ``sweep``, ``bearing``, ``gear`` or
        ``response``.
    output
        File to write, which may replace one of `report`; default ``report.html`` in the folder.
    stress
        Stress below the surface of a run or prediction: a folder that `pyehl.stress` wrote; True:
        compute it; None: the subfolder ``stress``, if there is one.
    pdf
        Also print it as PDF, with an installed Chromium or Chrome.

    Returns
    -------
    Path
        The page.

    Raises
    ------
    InputError
        If it is not a result folder, another file is in the way, or no browser is installed.
    FileError
        If a file cannot be read or written.
    EhlError
        If the browser does not print.

    Examples
    --------
    >>> import pyehl
    >>> solved = pyehl.solve("cases/quick.nml", {"grid.points": 65}, output="out/reported")
    >>> pyehl.report("out/reported").name
    'report.html'
    """
    source = Path(path_of(folder, "folder"))
    path = source / "report.html" if output is None else Path(path_of(output, "output"))
    printed = path.with_suffix(".pdf")
    if pdf and path == printed:
        raise InputError(f"-o {path}: the page and its PDF have one name\nexpected: FILE.html")
    if not source.is_dir():
        raise InputError(f"{source}: there is no such folder\n{EXPECTED}")
    own = {os.path.realpath(place) for place in ((path, printed) if pdf else (path,))}
    inside = [entry for entry in source.iterdir() if os.path.realpath(entry) not in own]
    check_files([path, printed] if pdf else [path], "report", inside if output else ())
    if pdf:
        browser.browser()
    files = named_files(source)
    below = _stress(source, stress)
    for dpi in DOTS:
        title, assessment, parts = _content(source, dpi, below)
        parts = [page.verdict(*assessment), *parts, *_versions()]
        text = page.render(title, parts, "report", lambda value: _nameless(value, files))
        if len(text) < MAX_BYTES:
            break
    page.write_text(path, text)
    if pdf:
        browser.write_pdf(path, printed)
    return path


def _stress(folder: Path, given: str | os.PathLike[str] | bool | None) -> xr.Dataset | None:
    """Give the stress below a run or prediction; `given` as `stress` of `report`."""
    case = folder / "case.nml"
    single = case.is_file() and not (folder / NAME).is_file()
    if not single:
        if given:
            raise InputError(f"{folder}: stress is below a run or a prediction alone")
        return None
    place = given if given is None or isinstance(given, bool) else path_of(given, "stress")
    return stress_of(folder, _text(case), place)


def _content(
    folder: Path, dpi: int, below: xr.Dataset | None
) -> tuple[str, Assessment, list[Block]]:
    """Give title, assessment and parts of the page of any result folder."""
    if (folder / NAME).is_file() and "machine" not in (read_header(folder) or {}):
        return study_parts(folder)
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise InputError(
            f"{folder}: no result folder (there is neither summary.json nor {NAME})\n{EXPECTED}"
        ) from error
    except (OSError, ValueError) as error:
        raise FileError(f"{folder}: summary.json cannot be read: {error}") from error
    if summary.get("kind") == "response":
        return _response(folder, summary)
    if summary.get("kind") in MACHINES:
        return machine_parts(folder, summary)
    if summary.get("kind") not in ("solution", "prediction"):
        raise InputError(f"{folder}: a result of '{summary.get('kind')}' has no report\n{EXPECTED}")
    return _single(folder, summary, dpi, below)


def _single(
    folder: Path, summary: Mapping[str, Any], dpi: int, below: xr.Dataset | None
) -> tuple[str, Assessment, list[Block]]:
    data = load(folder)
    settings, case = settings_of(data), str(data.attrs["case"])
    assessment = assess(summary)
    parts = [page.heading("Conditions")]
    parts += [page.facts(conditions(settings)), page.facts(numbers(settings))]
    parts.append(page.heading("Results"))
    result = numbers_of(summary)
    parts.append(page.facts(result) if result else page.paragraph(assessment.why, "fail"))
    if summary.get("film_breakdown"):
        parts.append(page.facts({k: str(v) for k, v in summary["film_breakdown"].items()}))
    parts += _pictures(data, summary, dpi)
    if below is not None:
        parts += stress_parts(below, dpi)
    if summary.get("bands"):
        names = list(summary["bands"][0])
        rows = [[_value(band[name]) for name in names] for band in summary["bands"]]
        parts += [page.heading("Octaves of wavelengths"), page.table(names, rows)]
    noted = warnings(summary)
    parts.append(page.heading("Warnings"))
    parts.append(page.bullets(noted) if noted else page.paragraph("None."))
    parts += [page.heading("Limits that apply"), page.bullets(limits(settings, summary))]
    parts += _case_parts(case)
    parts.append(page.folded("All numbers", _all_numbers(summary)))
    rough = "mu_ratio_min" in summary or "H_c_rough" in summary
    title = "Rough contact" if rough else "Contact"
    if summary["kind"] == "prediction":
        title = "Prediction of a rough contact"
    return title, assessment, parts


def named_files(folder: Path) -> set[str]:
    """Give the files that a result names: height maps, and tables of oil, duty and profile."""
    header = read_header(folder) or {}
    vary = header.get("vary", {})
    result = {str(v) for key in vary if key.rpartition(".")[2] in FILES for v in vary[key]}
    cases = [str(header.get("case", ""))]
    cases += [_text(folder / n) for n in ("case.nml", CASE) if (folder / n).is_file()]
    for case in cases:
        for group in namelist.values(case).values():
            result |= {str(group[key]) for key in FILES if group.get(key)}
    return result


def _nameless(value: object, files: set[str]) -> object:
    """Remove folder names of files on this machine from a text, in any form of quoting."""
    if type(value) is not str:
        return value
    # the longest first: one name may be a prefix of another
    for name in sorted(files, key=len, reverse=True):
        for form in (name, name.replace("'", "''"), repr(name)[1:-1]):
            value = value.replace(form, Path(name).name)
    return value


def _text(path: Path) -> str:
    with file_errors(path, "cannot be read"):
        return path.read_text(encoding="utf-8")


def _pictures(data: Any, summary: Mapping[str, Any], dpi: int) -> list[Block]:  # noqa: ANN401
    """Draw the pictures of a Dataset, each with its caption."""
    if summary["kind"] == "solution" and "P" not in data:
        return [page.paragraph("There are no pictures: the case has output.fields = .false.")]
    parts = [page.heading("Pictures")]
    facts = "; ".join(f"{name}: {value}" for name, value in numbers_of(summary).items())
    for name, figure in plot(data).items():
        words = PICTURES.get(name, name)
        parts.append(page.picture(png(figure, dpi), f"{words}. {facts}", f"{words}."))
    return parts


def _case_parts(case: str) -> list[Block]:
    short = namelist.given(case) or "! every value is the default\n"
    whole = page.folded("Every value of it", page.preformatted(case))
    return [page.heading("The case"), page.preformatted(short), whole]


def _value(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _all_numbers(summary: Mapping[str, Any]) -> Block:
    """Give the summary with units and meanings."""
    known = {q.name: q for q in QUANTITIES}
    rows = [
        (name, _value(value), known[name].unit, known[name].meaning)
        for name, value in summary.items()
        if name in known and name not in ("bands", "files") and value is not None
    ]
    return page.table(("name", "value", "unit", "meaning"), rows)


def _response(folder: Path, summary: Mapping[str, Any]) -> tuple[str, Assessment, list[Block]]:
    case = _text(folder / "case.nml")
    settings = namelist.values(case)
    words = "Amplitude and lag of small waves over their length, beside the shipped response"
    within = bool(summary["within_fitted_range"])
    rms, maximum = summary["shipped_difference_rms"], summary["shipped_difference_max"]
    assessment = Assessment(
        "Holds" if within else "Take with care",
        f"{summary['waves']} waves; they differ from the shipped response by {rms:.2g} (rms) and "
        f"{maximum:.2g} at most" + ("." if within else ", which was not fitted at such a point."),
        "pass" if within else "care",
    )
    parts = [page.heading("Conditions"), page.facts(conditions(settings))]
    parts += [page.facts(numbers(settings)), page.heading("Results")]
    if (folder / "response.png").is_file():
        parts.append(page.picture((folder / "response.png").read_bytes(), assessment.why, words))
    tiers = summary["tiers"]
    parts.append(page.table(list(tiers[0]), [[_value(v) for v in t.values()] for t in tiers]))
    parts.append(page.heading("Limits that apply"))
    parts.append(page.bullets(limits(settings, {"kind": "response"})))
    return "Measured response", assessment, [*parts, *_case_parts(case)]


def _versions() -> list[Block]:
    version = metadata.version("pyehl")
    names = ("numpy", "scipy", "matplotlib", "xarray")
    rows = {
        "pyehl": f"{version}, library {library.version()}: {library.build()}",
        "Python": platform.python_version(),
        "packages": ", ".join(f"{name} {metadata.version(name)}" for name in names),
    }
    return [
        page.heading("Versions"),
        page.facts(rows),
        page.heading("How to cite"),
        page.bullets(text.format(version=version) for text in CITATION),
    ]
