# SPDX-License-Identifier: BSD-3-Clause
"""Studies: many cases with one table of results, Stribeck curves, the response to waves."""
