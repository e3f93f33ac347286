# SPDX-License-Identifier: BSD-3-Clause
"""
Fractal surfaces and their spectrum
===================================

The spectrum of a self-affine surface decreases with a power of the wavenumber. A given seed always
generates the same surface. ``surface.shortest_wavelength`` cuts its spectrum, for both the solver
and the prediction.
"""

import matplotlib.pyplot as plt

from pyehl import surfaces
from pyehl.plots import surface

rough = surfaces.fractal((256, 256), 0.8e-3, 0.8e-3, rms_height=0.05e-6, hurst=0.8, seed=1)
cut = surfaces.filtered(rough, shortest_wavelength=25e-6)

# %%

figure, panels = plt.subplots(1, 3, figsize=(6.9, 2.2), layout="constrained")
for ax, tile, name in zip(panels, (rough, cut), ("as generated", "cut at 25 µm"), strict=False):
    surface.heights(tile, ax=ax)
    ax.set_title(f"{name},\nrms {tile.rms_height * 1e9:.1f} nm", loc="left")
for tile, name in ((rough, "as generated"), (cut, "cut at 25 µm")):
    q, c = surfaces.psd_isotropic(tile)
    shown = c > 1e-12 * c.max()
    panels[2].loglog(q[shown] * 1e-6, c[shown], label=name)
panels[2].set_xlabel(r"$q$ [rad/$\mu$m]")
panels[2].set_ylabel(r"$C_\mathrm{iso}$ [m$^4$]")
figure.legend(*panels[2].get_legend_handles_labels(), loc="outside lower right", ncols=2)
panels[2].set_box_aspect(1.0)
plt.show()
