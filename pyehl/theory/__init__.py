# SPDX-License-Identifier: BSD-3-Clause
"""Operating point, lubricant and closed formulas of circular contacts."""
