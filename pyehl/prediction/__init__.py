# SPDX-License-Identifier: BSD-3-Clause
"""Relative friction of a rough EHL contact from the spectrum of its surface, without a solver.

Zhang, Biboulet, Venner & Lubrecht 2019 (doi 10.1016/j.triboint.2019.01.028), section 3. Each
Fourier component of the roughness rr is flattened to A_d/A_i of its height (eq. 10), which costs a
pressure delta p (eq. 11); friction is the integral over the Hertz circle of the shear stress at
p_s + delta p in a film h_c - rr_d (eqs 13, 14), with the semi-elliptic p_s of the dry contact. How
eqs 9 to 12 are read is told in :mod:`pyehl.prediction.flattening`.

What happens where the model ends
---------------------------------
* p_s + delta p <= 0: the lubricant cavitates, as P >= 0 demands in the full problem: pressure zero
  and viscosity eta0. The points are counted (`cavitated_share`) and the share of friction at
  stake is bounded (`cavitated_friction`); near the rim p_s vanishes, so a few are normal.
* h_c - rr_d <= 0: the surfaces touch. There is no full film and the model has nothing to say:
  status ``"film breakdown"``, no ratio.
* A viscosity that overflows, or roughness that carries the whole load: status ``"overflow"``,
  ``"load lost"``, no ratio.

What it gives for table 1
-------------------------
For 200 fractal surfaces at the conditions of the paper's table 1 (h_c = 0.2333 um, Roelands, exact
stiffness, components) the ratio is 1.070 +- 0.113 from surface to surface, for the first 20 seeds
1.074. That is where second order puts it: with s = (d ln eta/dp) delta p the mean of exp(s) is
exp(s_rms^2/2). delta p has an rms of 32 MPa and at p_h Roelands has d ln eta/dp = 10.4 1/GPa
(alpha is 22 at ambient pressure), so s_rms = 0.33 and pressure alone gives 1.057; thinner film
under higher pressure adds 0.011 (their correlation is 0.86), the film alone 0.002. The wavelength
conventions ``pattern`` and ``wavevector`` take off 0.003 and 0.013, load balance changes the mean
by -0.002 (single surfaces by up to 2 %), the paper's stiffness adds 0.07, Barus (22 1/GPa at any
pressure) 0.24, both together 0.62: 1.69 +- 0.64.

The spread is not one of surfaces but of tracks. Waves along the motion stay in the same place of
the contact during a passage, and 59 % of the variance is in waves as long as the tile, two contact
radii: a track under a ridge rubs more, one under a valley less, and the next track makes up for it.
Averaged over all tracks the 60 first surfaces give 1.072 +- 0.0016, for a standard deviation of
0.107 between the tracks of one surface: the mean is a property of the spectrum. See
:func:`over_tracks`.

Beside the full simulation
--------------------------
The model is too low. Ten surfaces of table 1 (seeds 1 to 10) were marched through the contact by
the solver of this package, 257 x 257 nodes, mean over one tile, the same track in both. Model and
simulation rank them alike, with a correlation of 0.9997, but the model lies 12.8 % below with
``components``, 13.0 % with ``pattern``, 13.8 % with ``wavevector``, and within 0.6 % of that for
each single surface. Hence the default. On finer grids the simulation gives more: seed 1 has 1.442
there, 1.567 on 513 x 513 and 1.576 on 1025 x 1025 nodes. The paper states 8 % for surfaces of its
own.

What is missing is the phase. In the contact the film wave travels at the mean velocity, and it lags
the roughness that it comes from: by 40 degrees at the centre for a pattern of half a radius at
M = 1000, L = 10. What costs pressure is rr - A_d exp(i phi), which is more than rr - A_d: for that
pattern delta p is 0.69 and not 0.50 times what full flattening would take. ``phase_lag`` puts one
angle in for all waves. With 36 degrees the ten surfaces come out 3.7 % below the simulation, with
42.5 degrees on average right, each within 0.7 %, and the pattern with its own 40 degrees 0.9 %
below its simulation instead of 12 %. It is not the default because the lag of other waves and at
other operating points has not been measured.

The ratio of a Newtonian lubricant is the limit of vanishing sliding; its absolute friction
coefficient has no meaning. With an Eyring stress or a limiting stress at a real slide-to-roll ratio
the ratio is close to one.
"""

from pyehl.prediction.bands import Band, contributions
from pyehl.prediction.flattening import Response, response, stiffness
from pyehl.prediction.friction import RoughFriction, over_tracks, predict_friction
from pyehl.prediction.options import Options

__all__ = [
    "Band",
    "Options",
    "Response",
    "RoughFriction",
    "contributions",
    "over_tracks",
    "predict_friction",
    "response",
    "stiffness",
]
