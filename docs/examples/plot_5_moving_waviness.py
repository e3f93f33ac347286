# SPDX-License-Identifier: BSD-3-Clause
"""
A wave passes through the contact
=================================

A contact with a moving rough surface is computed in a transient run. Frames of pressure and film are
stored at intervals (``output.frame_interval``); ``pyehl plot DIR --movie`` animates them.
"""

import matplotlib.pyplot as plt
import numpy as np

import pyehl
from pyehl.plots import contact, transient
from pyehl.plots.figures import solution_figures

ds = pyehl.solve(
    "../../cases/quick.nml",
    {
        "surface.kind": "harmonic",
        "surface.amplitude_over_film": 0.3,
        "surface.wavelength": 0.8,
        "surface.velocity_ratio": 1.2,
        "time.estimate_error": False,
        "output.frame_interval": 0.2,
    },
)

# %%
# Interferograms at four instants while a wave moves from the inlet to the outlet.

x, y = ds.X.values, ds.Y.values
light = contact.fringe_spacings(float(ds.H_smooth.sel(X=0.0, Y=0.0, method="nearest")), None)
figure, panels = plt.subplots(2, 2, figsize=(6.0, 4.6), layout="constrained")
for ax, k in zip(panels.ravel(), np.arange(-4, 0), strict=True):
    contact.interferogram(x, y, ds.frame_H.isel(T=k).values, fringes=light, ax=ax)
    ax.set_title(rf"$\bar t$ = {float(ds['T'][k]):.2f}", loc="left")
    ax.label_outer()
plt.show()

# %%
# Friction against time. The mean is taken over the last, shaded period.

figure, ax = plt.subplots(figsize=(3.35, 2.4), layout="constrained")
transient.friction_history(
    ds.history_T.values,
    ds.history_mu_ratio.values,
    period=float(ds.T_mean),
    mean=float(ds.mu_ratio),
    ax=ax,
)
plt.show()

# %%
# ``pyehl plot DIR`` draws these and other figures, such as that of the rough and smooth profiles.

figures = solution_figures(ds)
figures["rough_and_smooth"]
