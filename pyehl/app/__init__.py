# SPDX-License-Identifier: BSD-3-Clause
"""A contact to play with, in the browser (extra ``app``): knobs, and what follows from them.

The logic is plain Python: `position` (knobs and case), `answers`, `worker`, `words`, `drawing`.
`layout`, `figures` and `page` hold what needs Bokeh.
"""
