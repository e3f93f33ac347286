# SPDX-License-Identifier: BSD-3-Clause
"""Stress below the surface of the solids under the pressure and friction of a result."""
