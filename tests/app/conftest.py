# SPDX-License-Identifier: BSD-3-Clause
"""The page served in this process, and a browser that opens it."""

import asyncio
import shutil
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.webelement import WebElement

from pyehl.app import server
from pyehl.app.page import Page
from pyehl.app.position import Position, from_case
from pyehl.case import Case

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
WORDS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--window-size=1600,1200",
)
FIND = """
function find(view, name) {
  if (view.model.name === name) return view;
  for (const child of view.child_views || []) {
    const found = find(child, name);
    if (found) return found;
  }
  return null;
}
const roots = Bokeh.index.roots || Object.values(Bokeh.index);
let found = null;
for (const view of roots) found = found || find(view, arguments[0]);
"""
TIMEOUT = 120.0


class Served:
    """A server in a thread, its address, and the pages that it created."""

    def __init__(self, start: Position) -> None:
        self.pages: list[Page] = []
        ready = threading.Event()
        self._server: Any = None

        def run() -> None:
            loop = asyncio.new_event_loop()
            asyncio.set_event_loop(loop)
            self._server = server.make_server(start, "", made=self.pages.append)
            self._server.start()
            ready.set()
            self._server.io_loop.start()
            self._server.stop()
            loop.close()

        self._thread = threading.Thread(target=run)
        self._thread.start()
        assert ready.wait(TIMEOUT)
        self.port = self._server.port
        self.address = f"http://127.0.0.1:{self.port}/"

    def close(self) -> None:
        self._server.io_loop.add_callback(self._server.io_loop.stop)
        self._thread.join(TIMEOUT)
        for page in self.pages:
            page.close()


class Tab:
    """The page in a browser; its models are addressed by name."""

    def __init__(self, driver: webdriver.Chrome, address: str) -> None:
        self.driver = driver
        driver.get(address)
        self.until(lambda: self.run("return Boolean(window.Bokeh && Bokeh.documents.length)"))
        self.settle(129)

    def run(self, script: str, *arguments: object) -> Any:
        return self.driver.execute_script(script, *arguments)

    def until(self, holds: Callable[[], Any], timeout: float = TIMEOUT) -> Any:
        end = time.monotonic() + timeout
        while not (result := holds()):
            assert time.monotonic() < end, "the page does not come to it"
            time.sleep(0.02)
        return result

    def get(self, name: str, what: str) -> Any:
        """Give a property of a model, as the browser has it."""
        return self.run(
            "const m = Bokeh.documents[0].get_model_by_name(arguments[0]);"
            "return m === null ? null : m[arguments[1]]",
            name,
            what,
        )

    def element(self, name: str, selector: str) -> WebElement:
        """Give an HTML element of a widget."""
        return self.until(
            lambda: self.run(
                f"{FIND} return found && found.shadow_el.querySelector(arguments[1])",
                name,
                selector,
            )
        )

    def words(self, name: str) -> str:
        """Give the visible text of a widget."""
        script = (
            f"{FIND} const box = found.el.getBoundingClientRect();"
            "if (box.height === 0) return '';"
            "return found.shadow_el.querySelector('.bk-clearfix').innerText"
        )
        return str(self.run(script, name))

    def stamp(self) -> tuple[int, int, int] | None:
        """Give the generations requested and shown, and the nodes per side of the film shown."""
        return self.run(
            "const m = Bokeh.documents[0].get_model_by_name('stamp');"
            "return m && [m.data.asked[0], m.data.generation[0], m.data.points[0]]"
        )

    def settle(self, points: int = 513) -> None:
        """Wait for the result at the present controls, on a grid of at least `points` nodes."""

        def there() -> bool:
            asked, shown, nodes = self.stamp() or (0, -1, 0)
            return asked == shown > 0 and nodes >= points

        self.until(there)

    def type(self, name: str, text: str, *, wait: bool = True) -> None:
        """Type into the field of a control, as a user does."""
        asked = self.stamp()[0]
        field = self.element(name, "input")
        old = field.get_attribute("value")
        field.send_keys(f"{Keys.END}{Keys.BACKSPACE * len(old)}{text}\n")
        if wait:
            self.until(lambda: self.stamp()[0] > asked or self.get(f"error_{name}", "text"))

    def curve(self) -> dict[str, list[float | None]]:
        """Give the points of the film over the range of a control."""
        return self.run(
            "const data = Bokeh.documents[0].get_model_by_name('curve of film').data;"
            "return Object.fromEntries(['place', 'value'].map(k => [k, [...data[k]]]))"
        )

    def choose(self, name: str, word: str) -> None:
        """Choose an option of a control."""
        self.element(name, f"option[value='{word}']").click()


@pytest.fixture(scope="module")
def served() -> Iterator[Served]:
    position, _ = from_case(Case())
    # a closed tab is removed after 5 s here, not after 30 s
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(server, "UNUSED", 5_000)
        made = Served(position)
    yield made
    made.close()


@contextmanager
def chromium(downloads: Path | None = None) -> Iterator[webdriver.Chrome]:
    """Start a browser with a new profile."""
    options = Options()
    options.binary_location = CHROMIUM
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        for word in (*WORDS, f"--user-data-dir={profile}"):
            options.add_argument(word)
        if downloads is not None:
            options.add_experimental_option("prefs", {"download.default_directory": str(downloads)})
        driver = webdriver.Chrome(options=options, service=Service(DRIVER))
        try:
            yield driver
        finally:
            driver.quit()


@pytest.fixture(scope="module")
def downloads(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("downloads")


@pytest.fixture(scope="module")
def driver(downloads: Path) -> Iterator[webdriver.Chrome]:
    if not (CHROMIUM and DRIVER):
        pytest.skip("no browser: chromium and chromium-driver are not installed")
    with chromium(downloads) as made:
        yield made


@pytest.fixture
def tab(driver: webdriver.Chrome, served: Served) -> Tab:
    """Open the page with untouched controls."""
    return Tab(driver, served.address)


@pytest.fixture
def page(tab: Tab, served: Served) -> Page:
    """Give the object of the server for the page of the tab."""
    return served.pages[-1]
