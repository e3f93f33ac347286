# SPDX-License-Identifier: BSD-3-Clause
"""Pictures. The modules draw; `pyehl.plots.folder` writes the pictures of a result folder."""
