# SPDX-License-Identifier: BSD-3-Clause
"""The smooth contact of a case: film thickness by closed formulas, and the solution."""
