# SPDX-License-Identifier: BSD-3-Clause
"""
A measured surface, prepared step by step
=========================================

A raw scan has missing points, spikes, tilt and curvature, and its opposite edges do not match.
:doc:`/howto/measured-surface` explains the keys of each step. This example needs the extra
``surfaces``.
"""

import pyehl
from pyehl import surfaces
from pyehl.plots.surface import before_and_after

scan = surfaces.read_scan("../../cases/scan.x3p")
scan

# %%
# The steps and their effects. Without ``outliers`` the three spikes of this scan would remain.

made = surfaces.prepare(scan, surfaces.Options(outliers=100.0))
print("\n".join(made.record.report()))

# %%
# In a case file the keys of ``&surface`` specify the same steps, for both solver and prediction.

p = pyehl.predict("../../cases/scan.nml", "surface.outliers=100")
print(p)
before_and_after(p.surface)
