# SPDX-License-Identifier: BSD-3-Clause
"""
Film and pressure of a smooth contact
=====================================

A ball rolls on a flat at M = 200, L = 10. Film and pressure on the line through the centre, and the
film as in an interferogram: the oil enters from the left, and the horseshoe-shaped constriction with
the minimum film is on the right.
"""

import matplotlib.pyplot as plt

import pyehl
from pyehl.plots import contact

ds = pyehl.solve("../../cases/quick.nml")
ds.attrs["status"], float(ds.H_c), float(ds.H_min)

# %%
# The result is an :class:`xarray.Dataset`: its variables have coordinates, units and names.

figure, ax = plt.subplots(figsize=(3.35, 2.4), layout="constrained")
ds.P.plot(ax=ax, x="X", cbar_kwargs={"label": "$P = p/p_h$"})
ax.set(aspect="equal", xlabel="$X = x/a$, motion →", ylabel="$Y = y/a$")
plt.show()

# %%
# The functions of ``pyehl.plots`` draw on given axes, and return them.

figure, (left, right) = plt.subplots(1, 2, figsize=(6.9, 2.9), layout="constrained")
x, y = ds.X.values, ds.Y.values
contact.pressure_and_film(x, ds.P.sel(Y=0.0).values, ds.H.sel(Y=0.0).values, ax=left)
contact.interferogram(x, y, ds.H.values, ax=right)
plt.show()
