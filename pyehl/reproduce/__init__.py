# SPDX-License-Identifier: BSD-3-Clause
"""The paper redone: each of its figures and tables by runs of this package, beside its numbers.

Zhang, Biboulet, Venner & Lubrecht 2019, doi 10.1016/j.triboint.2019.01.028. A piece of the paper
(a module each) says which cases it needs, and makes pictures, a table and deviations of their
results; `data/` has the numbers of the paper, which reach a piece only after its cases have run.
"""
