# SPDX-License-Identifier: BSD-3-Clause
"""Relative friction of a rough EHL contact from the spectrum of its surface.

Zhang, Biboulet, Venner & Lubrecht 2019 (doi 10.1016/j.triboint.2019.01.028), section 3. Each
Fourier component of the roughness rr is reduced in the contact to rr_d by a pressure delta p.
Friction is the integral of the shear stress at p_s + delta p in a film h_s - rr_d (eqs 13, 14).
:mod:`pyehl.prediction.model` begins with a table of the equations and their functions;
:func:`pyehl.prediction.predict.predict` predicts a resolved case.

``reduction="response"`` (default)
    The complex response of the contact, :mod:`pyehl.theory.response`: a driven wave that moves with
    the roughness and a free wave that arises in the inlet and is convected at the mean velocity, so
    that the friction depends on the velocity ratio. Compared with the full simulation in
    docs/evidence/prediction.
``reduction="amplitude"``
    The real ratio of the paper (eq. 10). With ``smooth="hertz"`` this is the model of the paper, 4
    to 76 % below the full simulation of the same surfaces.

Readings of the paper
---------------------
* Eq. 10 as printed multiplies the modulus of the component; the phase must be kept, else every
  surface would become a symmetric peak at the origin. The phase is kept here.
* Eqs 9 and 12 both print a factor 4/(Nx Ny); a transform and its inverse have 1/(Nx Ny) once
  between them, and Parseval holds in m^2.
* The half-space resists a wave of wavenumber |q| by E'|q|/4 per height of flattening
  (``stiffness="exact"``; Johnson 1985, Contact Mechanics, section 13.2). Eq. 11, pi E'/(sqrt 2
  wavelength), equals this for a cos cos pattern of that wavelength, whose |q| is 2 sqrt 2
  pi/wavelength. Read with wavelength = 2 pi/|q| it is E'|q|/(2 sqrt 2), 41 % too stiff
  (``stiffness="paper"``).

Limits of the model
-------------------
* p_s + delta p <= 0: the lubricant cavitates, as P >= 0 requires in the full problem: pressure zero
  and viscosity eta0. With the solved contact or the response the other pressures in that ring of
  the contact are reduced, so that its load is kept. The points are counted (`cavitated_share`) and
  the share of friction that depends on this is bounded (`cavitated_friction`); near the edge of the
  contact p_s vanishes, so a few points are normal.
* A loss of film rr_d of more than 1.6 h_s by the response, of more than h_s by the real ratio of
  the paper: there is no full film, which the model needs: status ``"film breakdown"``, no ratio.
* mu_r/mu_s above 10: status ``"beyond linear response"``, no ratio; the message names a cut-off of
  the spectrum that brings it into the range in which the model was compared.
* A viscosity that overflows, or roughness that carries more than the load, of the contact or of a
  ring of it: status ``"overflow"``, ``"load lost"``, no ratio.

A passage is one track of a surface. Ridges along the motion stay in one position across the contact
during a passage: a track under a ridge has more friction, one under a valley less, and the mean
over the tracks is a property of the spectrum. The absolute friction coefficient of a Newtonian
lubricant at these pressures has no meaning.
"""

from pyehl.prediction.friction import RoughFriction
from pyehl.prediction.model import ModelOptions
from pyehl.prediction.response import Response
from pyehl.prediction.spectrum import Band

__all__ = ["Band", "ModelOptions", "Response", "RoughFriction"]
