# SPDX-License-Identifier: BSD-3-Clause
"""Bearings and gears: from dimensions, load and speed to the film of every contact."""
