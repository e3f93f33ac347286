# SPDX-License-Identifier: BSD-3-Clause
"""
Friction of a rough contact, predicted from the spectrum
========================================================

The prediction takes about a second: it solves the smooth contact, flattens each wave of the surface
by the complex response of the contact, and sums up shear stress. :doc:`/theory/prediction` has the
theory and its evidence.
"""

import matplotlib.pyplot as plt

import pyehl

p = pyehl.predict("../../cases/table1.nml", {"surface.seed": 3})
print(f"mu_r/mu_s = {p.mu_ratio:.3f} +- {float(p.data.mu_ratio_model_error):.3f}")

# %%
# Over one passage of the surface the friction varies, because the contact holds few of the long
# waves. On the right what each octave of wavelengths adds.

figures = pyehl.plot(p.data)
figures["passage"]

# %%
# The surface outside of the contact, and what is left of it inside: long waves are flattened.

figures["roughness"]

# %%
# One figure alone, on your own axes:

ax = p.plot()
plt.show()
