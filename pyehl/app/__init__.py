# SPDX-License-Identifier: BSD-3-Clause
"""An interactive contact in the browser (extra ``app``): controls and results.

The logic is plain Python: `controls`, `position` (controls and case), `answers`, `worker`,
`words`, `drawing`, `uploads`, `downloads`. `changes`, `widgets`, `figures`, `layout`, `page` and
`server` use Bokeh.
"""
