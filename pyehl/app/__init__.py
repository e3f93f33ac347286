# SPDX-License-Identifier: BSD-3-Clause
"""An interactive contact in the browser (extra ``app``): controls, and the results.

The logic is plain Python: `position` (controls and case), `answers`, `worker`, `words`, `drawing`.
`layout`, `figures` and `page` hold what needs Bokeh.
"""
