# SPDX-License-Identifier: BSD-3-Clause
"""What the laws of density need, and the range of the constants of an oil."""

from pyehl.case.draft import Draft
from pyehl.case.number import to_text


def check(draft: Draft) -> None:
    """Refuse a law of density without its constants, and one beside another expansion."""
    oil = draft.settings.lubricant
    law = f"lubricant.density_law = '{oil.density_law}'"
    missing = f"{law} without its constants"
    if oil.density_law == "murnaghan" and oil.murnaghan_modulus * oil.murnaghan_rate <= 0.0:
        expected = "murnaghan_modulus, murnaghan_rate and murnaghan_softening"
        draft.refuse("lubricant.density_law", missing, expected)
    if oil.density_law == "tait":
        if oil.tait_modulus * oil.tait_rate <= 0.0:
            expected = (
                "tait_modulus, tait_rate, tait_softening, tait_expansion and tait_temperature"
            )
            draft.refuse("lubricant.density_law", missing, expected)
        given = draft.is_given("lubricant", "thermal_expansion")
        if given and oil.kinematic_viscosity_40 <= 0.0:
            what = f"lubricant.thermal_expansion with {law}, which has its own"
            draft.refuse("lubricant.thermal_expansion", what, "tait_expansion alone")
    low, high = oil.range_temperature_min, oil.range_temperature_max
    if high < low:
        what = (
            f"lubricant.range_temperature_max = {to_text(high)} below range_temperature_min = "
            f"{to_text(low)}"
        )
        expected = "a range of temperatures, or both 0"
        draft.refuse("lubricant.range_temperature_max", what, expected)
