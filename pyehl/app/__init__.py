# SPDX-License-Identifier: BSD-3-Clause
"""A contact to play with, in the browser (extra ``app``): controls, and what follows from them.

The logic is plain Python: `position` (controls and case), `answers`, `worker`, `words`, `drawing`.
`layout`, `figures` and `page` hold what needs Bokeh.
"""
