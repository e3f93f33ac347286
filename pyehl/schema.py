# SPDX-License-Identifier: BSD-3-Clause
"""Entries of ``summary.json`` and attributes of results: name, unit, meaning, kinds.

Names that end in a unit (``_m``, ``_Pa``, ...) are in that unit (`moes_m` is the Moes load M);
capital letters are Hertz units. Kinds: ``solution`` (``ehl``, ``pyehl run``), ``prediction``
(``pyehl predict``), ``film`` (``pyehl film --json``), ``response`` (``pyehl response``) and ``fit``
(``pyehl fit-lubricant``). To add a quantity, add a line here and in
``docs/reference/results.md``: tests compare this table with that page and with all summaries.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray

VERSION = 3
"""Version of names, units and meanings, `schema_version` in a summary; each change raises it."""
KINDS = {"s": "solution", "p": "prediction", "f": "film", "r": "response", "t": "fit"}


@dataclass(frozen=True, slots=True)
class Quantity:
    """One quantity: its name, unit ('-' for none, '' if it is not a number), meaning and kinds."""

    name: str
    unit: str
    meaning: str
    kinds: tuple[str, ...]


# Letters of the kinds | name | unit | meaning
_TABLE = """
spfrt | kind | | kind of the summary: 'solution', 'prediction', 'film', 'response' or 'fit'
spfrt | schema_version | | version of the names, units and meanings in the summary
sprt | files | | names of the files of the result in its folder
sp | status | | 'converged', 'predicted', or why there is no result
s | converged | | whether the results are a solution
sp | message | | the status as a sentence; in a run only if it has no result
sp | assessment | | a term, its reason, and other causes of uncertainty
s | version | | version of the library
sp | wall_seconds | s | wall time of the run
s | bytes | byte | memory used by the solver
spf | shape | | 'line': infinite line contact, with integrals per length; 'roller'
spfr | moes_m | - | Moes load M
spfr | moes_l | - | Moes material number L
spf | moes_m_line | - | Moes load M of a line
spf | moes_l_line | - | Moes material number L of a line
sf | alpha_bar | - | alpha p_h
sf | speed_parameter | - | 12 eta0 u R^2/(a^3 p_h)
spf | hertz_pressure_Pa | Pa | p_h
spf | hertz_radius_m | m | a; of an ellipse its semi-axis along the motion, of a line half its width
spf | film_scale_m | m | a^2/R
spf | radius_ratio | - | R_x/R_y of an elliptical contact
spfr | ellipticity | - | semi-axis of the dry contact across the motion over that along it
spf | semi_axis_y_m | m | semi-axis of the dry contact across the motion
sf | angle_deg | deg | counter-clockwise angle of an elliptical contact from the direction of motion
pf | si | | whether the case was given in SI units
f | load_N | N | load w
f | load_per_length_N_per_m | N/m | load per length of a line contact
f | mean_velocity_m_per_s | m/s | mean velocity u
f | radius_m | m | reduced radius R; R_x of an elliptical contact
f | reduced_modulus_Pa | Pa | E', 2/E' = sum of (1 - nu^2)/E
f | viscosity_Pa_s | Pa s | viscosity eta0 of the inlet
f | viscosity_ambient_Pa_s | Pa s | viscosity at the inlet temperature, without shear heating
f | pressure_viscosity_per_Pa | 1/Pa | alpha
f | U | - | eta0 u/(E' R)
f | G | - | alpha E'
f | g_v | - | viscosity parameter of the regime, G W^3/U^2
f | g_e | - | elasticity parameter of the regime, W^(8/3)/U^2
f | left_out |  | keys that the formulas ignore
f | regime |  | nearest asymptote: rigid or elastic, isoviscous or piezoviscous
f | W | - | w/(E' R^2)
st | points | - | nodes along X; in a round contact also along Y
s | points_y | - | nodes along Y, except in a round contact or a single row
s | x_mesh | a | mesh size along X
s | y_mesh | a | mesh size along Y
s | half_domain | | whether only Y >= 0 was solved
s | deflection | | method for the elastic deflection
s | threads | - | number of OpenMP threads
s | H_c | a^2/R | central film
s | H_c_extrapolated | a^2/R | central film extrapolated to fine grids
s | H_c_error | a^2/R | estimate of the error of H_c: grid and domain
s | H_c_error_note | | reason if H_c_error is not known
s | H_c_error_grid | a^2/R | part of H_c_error due to the grid and the algebraic error
s | H_c_error_domain | a^2/R | part of H_c_error due to the finite domain, also in H_c_extrapolated
s | H_c_algebraic_error | a^2/R | part of H_c_error that more cycles would remove
s | H_min | a^2/R | minimum film
s | H_min_extrapolated | a^2/R | minimum film extrapolated to fine grids
s | H_min_error | a^2/R | estimate of the error of H_min
s | H_min_error_note | | reason if H_min_error is not known
s | H_min_error_grid | a^2/R | part of H_min_error due to the grid
s | H_min_error_domain | a^2/R | part of H_min_error due to the finite domain
s | H_min_algebraic_error | a^2/R | part of H_min_error that more cycles would remove
s | error_estimate | | basis of the error estimates: 'coarser grids' or 'a priori'
s | P_max | p_h | maximum pressure
s | P_max_error | p_h | estimate of the error of P_max, from three grids
s | P_max_error_note | | reason if P_max_error is not known
s | P_max_X | a | position X of the maximum pressure of a roller
s | P_max_Y | a | position Y of the maximum pressure of a roller
s | H_min_X | a | position X of the minimum film thickness of a roller
s | H_min_Y | a | position Y of the minimum film thickness of a roller
s | P_end | p_h | maximum pressure in the last cells of a roller; if above 0.1, H_min has no error
s | cell_at_end | a | length of the last cell of a roller
s | length | a | length of a roller
s | F | - | friction integral
s | F_error | - | estimate of the error of F, from three grids
s | F_error_note | | reason if F_error is not known
s | last_H_c | a^2/R | central film at the end of a run without a solution
s | last_H_min | a^2/R | minimum film at the end of a run without a solution
s | last_P_max | p_h | maximum pressure at the end of a run without a solution
s | last_F | - | friction integral at the end of a run without a solution
s | last_mu_ratio | - | mu_r/mu_s at the end of a run without a solution
s | last_mu_ratio_mean | - | mean of mu_r/mu_s over a period at the end of a run without a solution
sp | h_c_m | m | central film of the smooth contact
sp | h_c_error_m | m | estimate of the error of h_c_m
p | h_c_source | | source of h_c_m
sp | h_min_m | m | minimum film of the smooth contact
sp | h_min_error_m | m | estimate of the error of h_min_m
sp | p_max_Pa | Pa | maximum pressure of the smooth contact
s | H_c_flooded | a^2/R | flooded central film from a formula, if the inlet is starved
s | starvation | - | H_c over H_c_flooded
s | starvation_by_formula | - | starvation from a formula (docs/theory/starvation.md)
s | inlet_position | a | position of the meniscus ahead of the centre
s | oil_layer | a^2/R | oil layer that arrives
s | oil_in | a^3/R | inflow of oil over the mean velocity; for a line per length, a^2/R
s | oil_out | a^3/R | outflow of oil at the outlet, in the units of oil_in
s | oil_at_sides | a^3/R | outflow of oil at the sides of the domain, in the units of oil_in
s | passages | - | number of successive contacts solved
s | oil_imbalance | - | error of the oil balance relative to oil_in
s | load_beyond | - | share of the load beyond the border of the domain
sp | load_error | - | relative error of the force balance
s | cycles | - | cycles on the finest grid
s | total_cycles | - | cycles on all grids
s | residual | - | residual (rms) at the end, weighted by its effect on the film
s | restarts | - | number of restarts of the solution
s | H_c_rough | a^2/R | central film of a rough surface at rest
s | H_min_rough | a^2/R | minimum film of the rough contact: at rest, over T_mean, or a passage
s | H_min_rough_T | a/u | time of H_min_rough
s | H_min_rough_X | a | position X of H_min_rough
s | H_min_rough_Y | a | position Y of H_min_rough
sp | h_min_rough_m | m | minimum film of the rough contact, as H_min_rough
s | P_max_rough | p_h | maximum pressure of the rough contact: at rest, over T_mean, or a passage
s | P_max_rough_T | a/u | time of P_max_rough
s | P_max_rough_X | a | position X of P_max_rough
s | P_max_rough_Y | a | position Y of P_max_rough
sp | p_max_rough_Pa | Pa | maximum pressure of the rough contact; predicted: within 0.8 a
s | P_rise_max | p_h | maximum pressure increase over the smooth contact at the same place
s | P_rise_max_T | a/u | time of P_rise_max
s | P_rise_max_X | a | position X of P_rise_max
s | P_rise_max_Y | a | position Y of P_rise_max
s | H_ratio_min | - | minimum ratio of the film to that of the smooth contact at the same place
s | H_ratio_min_T | a/u | time of H_ratio_min
s | H_ratio_min_X | a | position X of H_ratio_min
s | H_ratio_min_Y | a | position Y of H_ratio_min
s | rough_cycles | - | cycles of a rough surface at rest
s | rough_parts | - | number of steps in which the roughness of a surface at rest was added
s | rough_residual | - | residual at the end for a rough surface at rest
s | x_start | a | origin of a rough surface at rest
s | second_x_start | a | origin of a second rough surface at rest
sp | mu_ratio | - | friction over that of the smooth contact: mean over a period or a passage
sp | mu_ratio_min | - | minimum of mu_r/mu_s over the period or passage
sp | mu_ratio_max | - | maximum of mu_r/mu_s over the period or passage
s | mu_ratio_extrapolated | - | mu_ratio extrapolated to fine grids, where both resolve the surface
s | mu_ratio_error | - | error of mu_ratio: the sum of its parts; null if a part is not known
sp | mu_ratio_error_note | | reason if the error of mu_ratio is not known
s | mu_ratio_error_grid | - | part of mu_ratio_error due to the grid, from two grids
s | mu_ratio_error_stop | - | part of mu_ratio_error due to the end of the run
s | mu_ratio_error_window | - | part of mu_ratio_error if two surfaces have no common period
s | mu_ratio_error_domain | - | part of mu_ratio_error due to the finite domain
s | mu_ratio_error_left_out | - | part of mu_ratio_error due to waves that the grid omits, predicted
s | mu_ratio_unresolved | - | predicted part of mu_ratio due to waves that the grid does not resolve
p | mu_ratio_model_error | - | error of mu_ratio due to the model
p | mu_ratio_cutoff_error | - | error of mu_ratio due to omitted waves
p | mu_ratio_tracks | - | mean of mu_ratio over all tracks of the tile
p | mu_ratio_tracks_spread | - | standard deviation of mu_ratio between the tracks
f | mu_ratio_eq_16 | - | mu_ratio by eq. 16 of Zhang et al. 2019
f | theta_2 | - | theta_2 of eq. 16 of Zhang et al. 2019
f | theta_2_outside | | quantities outside the range of eq. 16
sp | mu | - | coefficient of friction of the rough contact, with heat where it matters
sp | mu_smooth | - | coefficient of friction of the smooth contact, with heat where it matters
sp | mu_isothermal | - | mu without heat
sp | mu_smooth_isothermal | - | mu_smooth without heat
sp | temperature_rise_max_K | K | maximum temperature rise (mean across the film); rough: at the end
sp | temperature_rise_wall_1_max_K | K | maximum temperature rise of the surface of body 1
sp | temperature_rise_wall_2_max_K | K | maximum temperature rise of the surface of body 2
sp | boundary_film | a^2/R | boundary film at ambient pressure
sp | contact_load_share | - | load share of solid contact: averaged as mu_ratio, or over a duty
sp | contact_load_share_error | - | sum of its parts; in a prediction the error due to the film
s | contact_load_share_error_grid | - | part of contact_load_share_error due to the grid (two grids)
s | contact_load_share_error_stop | - | part of contact_load_share_error due to the end of the run
sp | contact_load_share_error_note | | reason if contact_load_share_error is not known
sp | contact_area_share | - | area of solid contact over that of the dry contact
p | contact_area_share_error | - | estimate of the error of contact_area_share
s | load_share_at_hardness | - | share of the load where the solids yield: a mean, as mu_ratio
s | area_share_at_hardness | - | area where the solids yield over that of the dry contact
s | plastic_depth_max_m | m | maximum depth of plastic deformation
s | flowing_load_share_at_hardness | - | share of the load where solids yield under a flowing film
s | mass_defect | - | mass defect of the boundary film over the flow in the direction of motion
sp | mu_note | | effects that mu includes and neglects
sp | flash_temperature_K | K | maximum flash temperature rise (Tian & Kennedy), at mu
sp | shear_rate_mean_per_s | 1/s | mean shear rate of the smooth contact
sp | shear_stress_max_Pa | Pa | maximum shear stress of the smooth contact
s | rolling_moment | p_h a^3 | int H/2 dP/dX, if kappa > 4 of the whole inlet; line: p_h a^2
s | rolling_moment_N_m | N m | R times the integral of h/2 dp/dx, smooth contact
s | rolling_moment_N | N | rolling moment of a line contact, per length
spt | shear_law | | law of the shear stress
sp | slide_to_roll | - | (u1 - u2)/u
t | residual_rms | - | root mean square of fitted minus measured mu
sp | pressure_viscosity_note | | source of alpha, if the case does not give it
s | lubricant_note | | law of the oil, range of its constants, and whether the contact is beyond it
s | inlet_viscosity_Pa_s | Pa s | viscosity of the inlet
s | thermal_loading | - | loading parameter of the shear heating of the inlet
spf | thermal_reduction | - | film with the heated inlet over the isothermal film
s | amplitude | a^2/R | amplitude A_i of a waviness, height or depth of a feature
s | second_amplitude | a^2/R | amplitude of the second surface
s | amplitude_ratio | - | A_d/A_i at the centre
sp | surface_rms_m | m | rms height sigma of the solved, undeformed surface; of two combined
sp | surface_slope | - | rms slope of the solved surface
p | spectrum_beside | | h_min and mu_r/mu_s with other roll-offs, where Ra or a finish is given
p | surface_findings | | features other than roughness: form, line offsets, stitching step, dust
sp | surface_correlation | - | correlation of the heights of two surfaces that move together
s | variance_cut | - | share of the variance of the heights removed by the cut-off
s | variance_left_out | - | share of the variance in waves that the grid omits
s | variance_unresolved | - | share of the variance in waves that the grid does not resolve
s | scheme | | time scheme
s | duty_h_c_min_m | m | minimum central film over the duty; if periodic, over the last period
s | duty_h_c_min_t_s | s | time of duty_h_c_min_m
s | duty_h_c_min_error_m | m | error of duty_h_c_min_m: grid and domain of the case, and time steps
s | duty_h_c_max_m | m | maximum central film
s | duty_h_c_max_t_s | s | time of duty_h_c_max_m
s | duty_h_c_max_error_m | m | estimate of the error of duty_h_c_max_m
s | duty_h_min_min_m | m | minimum of the minimum film
s | duty_h_min_min_t_s | s | time of duty_h_min_min_m
s | duty_h_min_min_error_m | m | estimate of the error of duty_h_min_min_m
s | duty_h_min_max_m | m | maximum of the minimum film
s | duty_h_min_max_t_s | s | time of duty_h_min_max_m
s | duty_h_min_max_error_m | m | estimate of the error of duty_h_min_max_m
s | duty_p_max_Pa | Pa | maximum pressure over the duty
s | duty_p_max_t_s | s | time of duty_p_max_Pa
s | duty_p_max_error_Pa | Pa | estimate of the error of duty_p_max_Pa
s | duty_mu_max | - | maximum coefficient of friction; null if it is not known at some time
s | duty_mu_max_t_s | s | time of duty_mu_max
s | duty_mu_max_error | - | estimate of the error of duty_mu_max
s | duty_power_max_W | W | maximum friction power; of a line per length
s | duty_power_max_t_s | s | time of duty_power_max_W
s | duty_power_max_error_W | W | estimate of the error of duty_power_max_W
s | duty_flash_max_K | K | maximum flash temperature rise, of surfaces in a steady state
s | duty_flash_max_t_s | s | time of duty_flash_max_K
s | duty_flash_max_error_K | K | estimate of the error of duty_flash_max_K
s | duty_load_share_max | - | maximum share of the load on solid contact
s | duty_load_share_max_t_s | s | time of duty_load_share_max
s | duty_load_share_max_error | - | estimate of the error of duty_load_share_max
s | duty_period_change | - | relative change of the mean central film between the last two periods
s | duty_begin_s | s | time at which the run begins
s | duty_end_s | s | time at which the run ends
s | T | a/u | time at the end of the run
s | T_period | a/u | period of the roughness; common one of two; time of the passage of a feature
s | T_mismatch | - | fraction of a period by which two surfaces differ after T_period
s | T_mean | a/u | time over which mu_ratio is averaged
s | steps | - | number of time steps
s | start | | start of the time steps: 'front', or 'prediction' (the contact is full)
s | start_note | | reason why the run did not start from the requested prediction
s | steps_skipped | - | number of steps skipped at the start
s | cycles_per_step | - | mean number of cycles per step
s | seconds_per_step | s | mean time per step
s | step_residual_allowed | - | maximum residual at which a step was allowed to end
s | coarsening_changed_at | - | step in which the coarsening changed; 0: none
p | outside_range | | quantities outside the range of the model
p | note | | meaning of mu_ratio
p | tracks | - | number of tracks over which mu_ratio_tracks is averaged
p | film_below_zero_share | - | share of the contact where roughness exceeds what the film sustains
p | film_breakdown | | place of the film breakdown, and a suggested cut-off wavelength
sp | surface_preparation | | preparation of a measured map
sp | second_surface_preparation | | preparation of a measured map of the second surface
p | positions | - | positions of the tile over a passage
p | position_error | - | relative error of mu_ratio due to the number of positions
p | reduction | | model of the flattening of waves
p | smooth | | source of the smooth contact in the prediction
pr | velocity_ratio | - | velocity of the rough surface over the mean velocity
p | second_velocity_ratio | - | velocity of the second rough surface over the mean velocity
p | wavelength_convention | | definition of the wavelength of a component
p | stiffness | | stiffness of the half-space
p | viscosity_law | | viscosity under pressure
p | roelands_z | - | Roelands exponent
p | load_balance | | whether the load is balanced
pf | surface | | the surface in words
p | seed | - | seed of a fractal surface
p | pixels | - | pixels of the tile along x and y
p | length_x_m | m | size of the tile along x
p | length_y_m | m | size of the tile along y
pf | rms_height_m | m | rms height sigma of the undeformed roughness
p | film_limit_m | m | film limit of film_below_limit_share
p | film_below_limit_share | - | mean share of the contact with a film below film_limit_m
p | film_below_limit_error | - | estimate of the error of film_below_limit_share
p | h_min_rough_error_m | m | error of h_min_rough_m by the response, in addition to the smooth film
p | rms_deformed_m | m | rms height of the deformed roughness
p | rms_deformed_error_m | m | estimate of the error of rms_deformed_m
p | lambda_ratio_deformed | - | h_min/rms_deformed_m: smooth contact, deformed surface
p | lambda_ratio_deformed_error | - | estimate of the error of lambda_ratio_deformed
p | rms_pressure_Pa | Pa | rms of the pressure change at the centre
p | p_rise_rms_Pa | Pa | rms of the pressure increase over a passage, within 0.5 a of the centre
p | p_rise_rms_error_Pa | Pa | estimate of the error of p_rise_rms_Pa
p | p_rise_max_Pa | Pa | maximum pressure increase over a passage, within 0.8 a of the centre
p | p_rise_max_error_Pa | Pa | estimate of the error of p_rise_max_Pa
p | second_surface | | the second surface in words
p | second_seed | - | seed of a fractal second surface
p | second_pixels | - | pixels of the second tile along x and y
p | second_length_x_m | m | size of the second tile along x
p | second_length_y_m | m | size of the second tile along y
p | second_rms_height_m | m | rms height of the undeformed second surface
p | second_rms_deformed_m | m | rms height of the deformed roughness of the second surface
p | second_rms_pressure_Pa | Pa | rms of the pressure change due to the second surface
sp | lambda_ratio | - | h_min/sigma: smooth contact, undeformed surface
spf | lambda_ratio_central | - | h_c/sigma: smooth contact, undeformed surface
p | cavitated_share | - | share of the contact where the pressure would be negative
p | cavitated_friction | - | bound of the share of the friction in the cavitated region
p | bands | | contribution of each octave of wavelengths
f | formulas | | result of each film formula
r | waves | - | number of waves whose response was measured
r | tiers | | runs of the measured waves: grid, tile, waves, film, residual of the fit
r | shipped_difference_rms | - | rms difference from the response used by the prediction, at X = 0
r | shipped_difference_max | - | maximum difference from the response of the prediction, at X = 0
r | within_fitted_range | | whether the case lies in the range of the fitted response
"""


def _row(line: str) -> Quantity:
    letters, name, unit, meaning = (cell.strip() for cell in line.split("|"))
    return Quantity(name, unit, meaning, tuple(KINDS[letter] for letter in letters))


QUANTITIES = tuple(_row(line) for line in _TABLE.strip().splitlines())


def summary_of(data: xarray.Dataset) -> dict[str, Any]:
    """Give the scalars of a result: attributes, and numbers that exist."""
    numbers = {str(k): float(v) for k, v in data.variables.items() if v.ndim == 0}
    return {**data.attrs, **{k: v for k, v in numbers.items() if not math.isnan(v)}}


def markdown() -> str:
    """Return the table in Markdown."""
    lines = ["| name | unit | meaning | of |", "|---|---|---|---|"]
    lines += [f"| `{q.name}` | {q.unit} | {q.meaning} | {', '.join(q.kinds)} |" for q in QUANTITIES]
    return "\n".join(lines)
