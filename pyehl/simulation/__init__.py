# SPDX-License-Identifier: BSD-3-Clause
"""The prediction for runs: initial pressure, and the part of mu_r/mu_s that is not resolved."""
