# SPDX-License-Identifier: BSD-3-Clause
"""Reports of results: one HTML page each, readable without network or pyehl."""
