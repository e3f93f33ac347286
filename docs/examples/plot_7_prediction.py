# SPDX-License-Identifier: BSD-3-Clause
"""
Friction of a rough contact, predicted from the spectrum
========================================================

The prediction takes about a second: it solves the smooth contact, flattens each wave of the surface
by the complex response of the contact, and integrates the shear stress. :doc:`/theory/prediction`
describes the theory and its validation.
"""

import matplotlib.pyplot as plt

import pyehl

p = pyehl.predict("../../cases/table1.nml", {"surface.seed": 3})
print(f"mu_r/mu_s = {p.mu_ratio:.3f} +- {float(p.data.mu_ratio_model_error):.3f}")

# %%
# The friction varies during a passage of the surface, because the contact contains only a few of the
# long waves. Right: the contribution of each octave of wavelengths.

figures = pyehl.plot(p.data)
figures["passage"]

# %%
# The surface outside and inside the contact, where long waves are flattened.

figures["roughness"]

# %%
# A single figure, on new axes or on your own (``ax=``):

ax = p.plot()
plt.show()
