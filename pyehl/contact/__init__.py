# SPDX-License-Identifier: BSD-3-Clause
"""The smooth contact of a case: film by closed formulas, solution, shear stress and heat."""
