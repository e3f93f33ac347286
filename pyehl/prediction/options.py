# SPDX-License-Identifier: BSD-3-Clause
"""How the model is read: conventions, stiffness, positions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pyehl.theory import amplitude

__all__ = ["MAX_POSITIONS", "STIFFNESSES", "Options"]

STIFFNESSES = ("exact", "paper")

MAX_POSITIONS = 4096


@dataclass(frozen=True, slots=True)
class Options:
    """How the model is read.

    Attributes
    ----------
    wavelength_convention
        One of :data:`pyehl.theory.amplitude.CONVENTIONS`.
    phase_lag
        How far the film wave of a component lags its roughness [deg], 0 <= phase_lag < 90; the
        paper has 0. Waves with their crests along the motion never lag.
    stiffness
        ``"exact"``: E'|q|/4; ``"paper"``: eq. 11 with wavelength 2 pi/|q|.
    load_balance
        Whether the semi-ellipse gives up the load that delta p carries inside the contact: a
        Hertz contact under the remaining load, p_h and a scaled by its cube root.
    positions
        Positions of the surface over one passage; 0: doubled until mu_r/mu_s is resolved.

    Raises
    ------
    ValueError
        For an unknown word or a number out of range.
    """

    wavelength_convention: str = "components"
    phase_lag: float = 0.0
    stiffness: str = "exact"
    load_balance: bool = False
    positions: int = 0

    def __post_init__(self) -> None:
        """Check the words and the numbers."""
        for name, value, allowed in (
            ("wavelength_convention", self.wavelength_convention, amplitude.CONVENTIONS),
            ("stiffness", self.stiffness, STIFFNESSES),
        ):
            if value not in allowed:
                raise ValueError(f"{name} {value!r}: expected one of {allowed}")
        if not 0.0 <= self.phase_lag < 90.0:
            raise ValueError(f"phase_lag must be 0 <= ... < 90 [deg], not {self.phase_lag!r}")
        if not 0 <= self.positions <= MAX_POSITIONS:
            raise ValueError(f"positions must be 0 ... {MAX_POSITIONS}, not {self.positions!r}")

    @classmethod
    def from_settings(cls, settings: Mapping[str, Mapping[str, Any]]) -> Options:
        """From the group ``psd`` of a resolved case.

        Raises
        ------
        ValueError
            For a value out of range.
        """
        group = settings["psd"]
        return cls(
            wavelength_convention=str(group["wavelength_convention"]),
            phase_lag=float(group["phase_lag"]),
            stiffness=str(group["stiffness"]),
            load_balance=bool(group["load_balance"]),
            positions=int(group["positions"]),
        )
