# SPDX-License-Identifier: BSD-3-Clause
"""Read the smooth contact of a prediction from the result folder of a run."""

from __future__ import annotations

import json
import math
from pathlib import Path

from pyehl import namelist
from pyehl.arrays import read_array
from pyehl.contact.smooth import SmoothContact, contact_of, smooth_case
from pyehl.errors import InputError
from pyehl.theory.line_contact import AnyContact
from pyehl.theory.shear import ShearLaw
from pyehl.types import Settings


def read_contact(folder: str | Path, operating: AnyContact, settings: Settings) -> SmoothContact:
    """Read pressure and film of a smooth contact, or of the smooth contact of a rough run.

    InputError if the folder has no converged solution of the same contact: M and L, ratio of the
    radii along and across the motion, shear law of the flow, lubricant and border of the domain.
    The grid may differ. A rotated ellipse and solid contact are refused, too.
    """
    folder = Path(folder)
    try:
        of_folder = namelist.values((folder / "case.nml").read_text(encoding="utf-8"))
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        rough = (folder / "P_smooth.npy").is_file()
        names = ("X", "Y", "P_smooth", "H_smooth") if rough else ("X", "Y", "P", "H")
        x, y, pressure, film = (read_array(folder / f"{n}.npy") for n in names)
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise InputError(f"{folder}: not a result folder with fields ({why})") from error
    if summary["status"] != "converged":
        raise InputError(f"{folder}: not a solution, its status is '{summary['status']}'")
    line = "_line" if operating.ellipse.is_line else ""
    for name, here in ((f"moes_m{line}", operating.moes_m), (f"moes_l{line}", operating.moes_l)):
        if name not in summary:
            raise InputError(f"{folder}: one is a line contact, the other a point contact")
        there = summary[name]
        if not math.isclose(there, here, rel_tol=1e-4):
            raise InputError(f"{folder}: {name} is {there:.6g} there and {here:.6g} in the case")
    there = 0.0 if line else float(summary.get("radius_ratio") or 1.0)
    here = operating.radius_ratio
    if not math.isclose(there, here, rel_tol=1e-4):
        raise InputError(f"{folder}: radius_ratio is {there:.6g} there and {here:.6g} in the case")
    angle = float(of_folder["contact"].get("angle", 0.0))
    if here != 1.0 and angle != 0.0:
        raise InputError(f"{folder}: contact.angle is {angle:g} there and 0 in the case")
    flows = _flow(of_folder), _flow(settings)
    if flows[0] != flows[1]:
        raise InputError(f"{folder}: the flow is {flows[0]} there and {flows[1]} in the case")
    _check_same(folder, of_folder, settings)
    if (summary.get("contact_load_share") or 0.0) > 0.0:
        raise InputError(
            f"{folder}: its bodies touch at the boundary film\nexpected: the contact solved with "
            "lubricant.boundary_film = 0"
        )
    if line:
        # all rows of a smooth strip are the same
        y, pressure, film = y[:1], pressure[:, :1], film[:, :1]
    return contact_of(summary, (x, y), pressure, film, f"smooth contact in {folder}")


def _check_same(folder: Path, of_folder: Settings, settings: Settings) -> None:
    """Refuse a folder whose lubricant or border differs from that of the case."""
    there, here = (namelist.values(smooth_case(groups)) for groups in (of_folder, settings))
    names = [("grid", "border"), *(("lubricant", key) for key in here["lubricant"])]
    for group, key in names:
        both = there[group].get(key), here[group][key]
        numbers = [v for v in both if isinstance(v, float)]
        same = math.isclose(*numbers, rel_tol=1e-4) if len(numbers) == 2 else both[0] == both[1]
        if not same:
            words = ["not set" if v is None else namelist.word(v) for v in both]
            raise InputError(
                f"{folder}: {group}.{key} is {words[0]} there and {words[1]} in the case"
            )


def _flow(settings: Settings) -> str:
    """Return the shear law of the flow in words, with its parameters."""
    law = ShearLaw.from_settings(settings)
    if not law.in_flow:
        return "newtonian"
    exponent = f" with exponent {law.carreau_exponent:g}" if law.law == "carreau" else ""
    slip = abs(float(settings["contact"]["slide_to_roll"]))
    return f"{law.law} at {law.scale:g} Pa{exponent}, slide_to_roll {slip:g},"
