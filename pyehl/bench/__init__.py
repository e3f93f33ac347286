# SPDX-License-Identifier: BSD-3-Clause
"""Benchmarks: time and error side by side, in one run on one machine."""
