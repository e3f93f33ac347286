# SPDX-License-Identifier: BSD-3-Clause
"""The response of a contact to small waves of roughness, measured with the solver."""
