# SPDX-License-Identifier: BSD-3-Clause
"""An interactive contact in the browser (extra ``app``): controls and results.

The logic is plain Python: `position` (controls and case), `answers`, `worker`, `words`, `drawing`.
The other modules, such as `layout`, `figures` and `page`, use Bokeh.
"""
