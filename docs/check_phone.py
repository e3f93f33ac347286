# SPDX-License-Identifier: BSD-3-Clause
"""Open the built site in Chromium: python docs/check_phone.py build/docs [PICTURES].

On a phone, 375 px wide, no page scrolls sideways and no formula is cut that does not scroll by
itself; the search finds the page of the minimum film thickness. PICTURES is a folder for
screenshots of some pages, light and dark. The exit status is 1 if something is wrong.
"""

import functools
import http.server
import shutil
import sys
import threading
import time
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

WIDTH, HEIGHT = 375, 812
QUESTION = "minimum film thickness"
# Made by FORD, which is not checked here
FOREIGN = ("fortran/",)
SHOWN = ("index.html", "theory/equations.html", "theory/symbols.html", "validation.html")
CUT = """
const wide = document.documentElement.scrollWidth;
const cut = [...document.querySelectorAll('math, article img, article table')].filter((part) => {
  if (!part.getClientRects().length) return false;
  for (let at = part; at && at !== document.body; at = at.parentElement) {
    if (['auto', 'scroll'].includes(getComputedStyle(at).overflowX)) return false;
  }
  return part.getBoundingClientRect().right > window.innerWidth + 1;
});
return [wide, cut.map((part) => part.tagName + ' ' + part.textContent.slice(0, 40))];
"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    """A server that prints nothing."""

    def log_message(self, *_: object) -> None:
        """Print nothing."""


def browser() -> webdriver.Chrome:
    """Start a browser with the width of a phone."""
    options = Options()
    options.binary_location = shutil.which("chromium") or ""
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"):
        options.add_argument(word)
    options.add_experimental_option(
        "mobileEmulation", {"deviceMetrics": {"width": WIDTH, "height": HEIGHT, "pixelRatio": 2.0}}
    )
    return webdriver.Chrome(options, Service(shutil.which("chromedriver")))


def scheme(driver: webdriver.Chrome, name: str) -> None:
    """Set light or dark pages, as the system of a reader does."""
    feature = {"name": "prefers-color-scheme", "value": name}
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [feature]})


def faults(site: Path, pictures: Path | None, timeout: float = 30.0) -> list[str]:
    """List all faults; the search may take `timeout` seconds."""
    handler = functools.partial(Quiet, directory=str(site))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    home = f"http://127.0.0.1:{server.server_port}"
    names = [path.relative_to(site).as_posix() for path in sorted(site.rglob("*.html"))]
    names = [name for name in names if not name.startswith((*FOREIGN, "_static/"))]
    result = []
    driver = browser()
    try:
        for name in names:
            driver.get(f"{home}/{name}")
            wide, cut = driver.execute_script(CUT)
            if wide > WIDTH:
                result.append(f"{name}: {wide} px wide on a phone")
            result += [f"{name}: cut: {part}" for part in cut]
        driver.get(f"{home}/search.html?q={QUESTION.replace(' ', '+')}")
        until = time.monotonic() + timeout
        results = ""
        while time.monotonic() < until and "htm" not in results:
            time.sleep(0.2)
            results = driver.execute_script(
                "return [...document.querySelectorAll('ul.search li a')].map(a => a.href).join(' ')"
            )
        if "htm" not in results:
            result.append(f"search: nothing for {QUESTION}")
        print(f"search for {QUESTION}: {len(results.split())} pages")
        if pictures is not None:
            pictures.mkdir(parents=True, exist_ok=True)
            for colours in ("light", "dark"):
                scheme(driver, colours)
                for name in SHOWN:
                    driver.get(f"{home}/{name}")
                    stem = name.removesuffix(".html").replace("/", "-")
                    driver.save_screenshot(str(pictures / f"{stem}-{colours}.png"))
    finally:
        driver.quit()
        server.shutdown()
        server.server_close()
    print(f"{len(names)} pages {WIDTH} px wide, {len(result)} faults")
    return result


if __name__ == "__main__":
    wrong = faults(Path(sys.argv[1]).resolve(), Path(sys.argv[2]) if len(sys.argv) > 2 else None)
    print("\n".join(wrong))
    sys.exit(bool(wrong))
