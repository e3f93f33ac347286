# SPDX-License-Identifier: BSD-3-Clause
"""Reports of results: one HTML page each, which needs neither network nor pyehl."""
