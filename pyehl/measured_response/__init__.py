# SPDX-License-Identifier: BSD-3-Clause
"""Response of a contact to small waves of roughness, measured with the solver."""
