# SPDX-License-Identifier: BSD-3-Clause
"""Time from a control to a new film, in the browser: a script for an otherwise idle machine.

    python tests/app/latency.py [TURNS]

JavaScript of the page moves a slider, and the time is taken until the browser has painted the film
of that position on 129 x 129 nodes, and on 257 x 257; the latter includes the delay for which a
control must not move. Prints the median and the maximum of each; exit status 1 if a median is too
long.
"""

import statistics
import sys

from conftest import Served, Tab, chromium

from pyehl.app.position import from_case
from pyehl.case import Case

# Largest medians allowed [s]
ALLOWED = {129: 0.150, 257: 0.400}
WAIT = """
const done = arguments[arguments.length - 1];
const doc = Bokeh.documents[0];
const stamp = doc.get_model_by_name('stamp'), slider = doc.get_model_by_name('slider_load');
const asked = stamp.data.asked[0], began = performance.now(), found = {};
function seen() {
  const points = stamp.data.points[0];
  if (stamp.data.generation[0] <= asked || found[points]) return;
  found[points] = 0;
  // two frames: the first may have been under way
  requestAnimationFrame(() => requestAnimationFrame(() => {
    found[points] = performance.now() - began;
    if (found[129] && found[257]) { stamp.properties.data.change.disconnect(seen); done(found); }
  }));
}
stamp.properties.data.change.connect(seen);
slider.value = arguments[0];
"""


def measure(turns: int) -> dict[int, list[float]]:
    """Measure the seconds from control to film, by nodes per side."""
    served = Served(from_case(Case())[0])
    times: dict[int, list[float]] = {points: [] for points in ALLOWED}
    try:
        with chromium() as driver:
            tab = Tab(driver, served.address)
            tab.settle()
            driver.set_script_timeout(60.0)
            for k in range(turns):
                result = driver.execute_async_script(WAIT, 200 + (37 * k) % 150)
                times[129].append(result["129"] * 1e-3)
                times[257].append(result["257"] * 1e-3)
                tab.settle()
    finally:
        served.close()
    return times


def main() -> int:
    """Print the measured times."""
    times = measure(int(sys.argv[1]) if len(sys.argv) > 1 else 30)
    failed = False
    for points, seconds in times.items():
        median = statistics.median(seconds)
        failed |= median > ALLOWED[points]
        print(
            f"{points} x {points}: median {1e3 * median:.0f} ms, largest {1e3 * max(seconds):.0f} "
            f"ms of {len(seconds)} turns; allowed {1e3 * ALLOWED[points]:.0f} ms"
        )
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
