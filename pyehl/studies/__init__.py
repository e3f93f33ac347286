# SPDX-License-Identifier: BSD-3-Clause
"""Studies: many cases with one table of results, and Stribeck curves."""
