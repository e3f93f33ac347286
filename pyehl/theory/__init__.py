# SPDX-License-Identifier: BSD-3-Clause
"""Operating conditions, lubricant, film formulas and the linear theory of roughness."""
