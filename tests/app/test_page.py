# SPDX-License-Identifier: BSD-3-Clause
"""The page in a real browser, headless: what a user sees and does."""

import ctypes
import gc
import http.client
import json
import re
import time
from pathlib import Path

import numpy as np
import pytest
from selenium.webdriver.common.action_chains import ActionChains

import pyehl
from pyehl.app.answers import Rough
from pyehl.cli import main


def rows_of(tab, name: str) -> dict[str, str]:
    """Give names and values of a table once they are visible."""

    def shown() -> list[list[str]] | None:
        cells = tab.run(
            "const d = new DOMParser().parseFromString("
            "Bokeh.documents[0].get_model_by_name(arguments[0]).text, 'text/html');"
            "return [...d.querySelectorAll('tr')].map(r => [...r.cells].map(c => c.textContent))",
            name,
        )
        # the browser paints after the model has changed
        seen = " ".join(tab.words(name).split())
        return cells if all(value in seen for _, value in cells) else None

    return dict(tab.until(shown))


def test_numbers_are_those_of_pyehl_run(tab, served, tmp_path, capsys):
    """A typed load and a dragged slider: all digits shown are those of ``pyehl run``.

    Nothing was loaded from elsewhere.
    """
    tab.type("load", "250")
    handle = tab.element("slider_velocity", ".noUi-handle")
    before = tab.stamp()[0]
    ActionChains(tab.driver).click_and_hold(handle).move_by_offset(25, 0).release().perform()
    tab.until(lambda: tab.stamp()[0] > before)
    tab.settle()
    rows = rows_of(tab, "numbers")
    case = tmp_path / "case.nml"
    case.write_text(tab.get("case", "value"))
    assert "load = 250.0" in case.read_text()
    velocity = float(re.search(r"mean_velocity = (\S+)", case.read_text())[1])
    assert velocity > 0.84
    assert tab.element("velocity", "input").get_attribute("value") == f"{velocity:g}"
    assert main(["run", str(case), "-o", str(tmp_path / "out")]) == 0
    reported = capsys.readouterr().out.replace("+-", "±")
    assert f"h_c {rows['h_c']}" in reported
    assert f"h_min {rows['h_min']}" in reported
    sheet = pyehl.film(case).summary
    for formula in (f for f in sheet["formulas"] if f["applies"]):
        assert f"{formula['h_c_m'] * 1e9:.4g} nm" in rows[formula["name"]]
    assert rows["Moes load M"] == f"{sheet['moes_m']:.4g}"
    assert "Converged on 513 × 513 nodes" in tab.words("status")
    names = tab.run("return performance.getEntriesByType('resource').map(e => e.name)")
    assert names
    assert all(name.startswith(served.address) for name in names)
    assert not [e for e in tab.driver.get_log("browser") if e["level"] == "SEVERE"]


def test_wrong_input_is_reported_at_its_control(tab):
    tab.settle()
    answer, asked = rows_of(tab, "numbers"), tab.stamp()[0]
    for text, why in (("abc", "expected a number"), ("-5", "contact.load"), ("1e9", "1e9")):
        tab.type("load", text)
        tab.until(lambda why=why: why in tab.words("error_load").replace("000000000.0", "e9"))
        assert not tab.get("error_velocity", "text")
    assert tab.stamp()[0] == asked
    assert rows_of(tab, "numbers") == answer
    tab.type("load", "300")
    tab.until(lambda: not tab.get("error_load", "text"))
    tab.settle(129)
    assert rows_of(tab, "numbers") != answer


@pytest.mark.long
def test_surface_is_predicted(tab):
    tab.choose("surface", "fractal")
    tab.settle()
    tab.until(lambda: "μ_r/μ_s" in tab.get("rough", "text"))
    rows = rows_of(tab, "rough")
    case = pyehl.Case.from_text(tab.get("case", "value"))
    prediction = pyehl.predict(case)
    error = prediction.model_error
    assert rows["μ_r/μ_s of one track"] == f"{prediction.mu_ratio:.3f} ± {error:.3f} (model)"
    assert "Λ" in tab.words("rough")


def test_refused_maps_show_the_message_of_the_reader(tab, page, tmp_path):
    tab.choose("surface", "map")
    assert "no height map yet" in tab.until(lambda: tab.words("error_surface"))
    bad = tmp_path / "bad.npy"
    bad.write_bytes(b"\x93NUMPY nonsense")
    field = tab.element("upload", "input")
    field.send_keys(str(bad))
    tab.until(lambda: "bad.npy" in tab.get("upload_error", "text"))
    with pytest.raises(pyehl.EhlError) as reader:
        pyehl.surfaces.read_scan(bad, 1e-4, 1e-4)
    assert (
        tab.words("upload_error").split() == str(reader.value).replace(f"{tmp_path}/", "").split()
    )
    good = tmp_path / "ground.npy"
    heights = 2e-8 * np.sin(2.0 * np.pi * np.arange(64) / 64.0)[:, np.newaxis] * np.ones(64)
    np.save(good, heights)
    field.send_keys(str(good))
    # an array has no size
    tab.until(lambda: "ground.npy" in tab.get("upload_error", "text"))
    tab.type("map_x", "0.4", wait=False)
    tab.type("map_y", "0.4", wait=False)
    tab.until(lambda: not tab.get("upload_error", "text"))
    tab.until(lambda: "μ_r/μ_s" in tab.get("rough", "text"))
    text = tab.get("case", "value")
    assert "file = 'ground.npy'" in text
    rows = rows_of(tab, "rough")
    (tmp_path / "case.nml").write_text(text)
    prediction = pyehl.predict(tmp_path / "case.nml")
    assert rows["μ_r/μ_s of one track"].startswith(f"{prediction.mu_ratio:.3f} ±")
    # the page does not show the path of the map
    everything = json.dumps(page.document.to_json(), default=str)
    place = Path(page.uploads.files["ground.npy"]).parent.parent
    assert place.name not in everything
    assert str(tmp_path) not in everything


@pytest.mark.long
def test_a_surface_set_to_smooth_leaves_nothing(tab, page):
    """An answer of the rough contact that arrives later is not shown."""
    late = []
    deliver = page.worker.deliver

    def hold_back(generation, answer):
        if late or isinstance(answer, Rough):
            late.append((generation, answer))
        else:
            deliver(generation, answer)

    tab.choose("surface", "fractal")
    tab.until(lambda: "μ_r/μ_s" in tab.get("rough", "text"))
    page.worker.deliver = hold_back
    tab.type("load", "610")
    tab.until(lambda: late)
    tab.choose("surface", "smooth")
    tab.until(lambda: not tab.get("rough", "text"))
    # as if a prediction ended after the control was changed, before any newer answer
    deliver(*late[0])
    page.soon(lambda: page.layout.note.update(text="it came"))
    tab.until(lambda: tab.get("note", "text") == "it came")
    assert not tab.get("rough", "text")
    assert tab.run("return Bokeh.documents[0].get_model_by_name('tiles').data.before.length") == 0


@pytest.mark.long
def test_no_solution_is_shown_as_such(tab):
    tab.type("velocity", "0.05")
    tab.type("load", "5000")
    tab.until(lambda: "No solution" in tab.get("status", "text"))
    rows = rows_of(tab, "numbers")
    assert rows["h_c"] == rows["h_min"] == "no solution"


@pytest.mark.long
def test_case_file_is_saved_and_opened(tab, tmp_path, downloads):
    tab.type("load", "321")
    tab.element("save", "button").click()
    saved = downloads / "case.nml"
    tab.until(saved.exists)
    assert saved.read_text() == tab.get("case", "value")
    tab.type("load", "123")
    other = tmp_path / "other.nml"
    other.write_text(saved.read_text().replace("321", "456"))
    tab.element("open", "input").send_keys(str(other))
    tab.until(lambda: "load = 456.0" in tab.get("case", "value"))
    assert tab.element("load", "input").get_attribute("value") == "456"
    wrong = tmp_path / "wrong.nml"
    wrong.write_text("&contact laod = 600.0 /")
    tab.element("open", "input").send_keys(str(wrong))
    tab.until(lambda: "did you mean 'load'" in tab.words("open_error"))
    assert "wrong.nml:1" in tab.words("open_error")
    assert "load = 456.0" in tab.get("case", "value")


@pytest.mark.long
def test_report_is_given(tab, downloads):
    tab.element("fetch_report", "button").click()
    saved = downloads / "report.html"
    tab.until(saved.exists)
    tab.until(lambda: "</html>" in saved.read_text())
    assert "Conditions" in saved.read_text()


@pytest.mark.long
def test_curve_is_drawn_on_demand(tab):
    tab.run("Bokeh.documents[0].get_model_by_name('tabs').active = 2")
    tab.element("curve_velocity", "button").click()
    tab.until(lambda: len(tab.curve()["place"]) == 9)
    films = np.array(tab.curve()["value"], dtype=float)
    assert np.all(np.diff(films[np.isfinite(films)]) > 0.0)


@pytest.mark.long
def test_two_tabs_do_not_disturb_each_other_and_end(tab, served, monkeypatch):
    first = tab.driver.current_window_handle
    tab.driver.switch_to.new_window("tab")
    tab.driver.get(served.address)
    tab.until(lambda: tab.run("return Boolean(window.Bokeh && Bokeh.documents.length)"))
    tab.until(lambda: tab.stamp() is not None)
    tab.type("load", "77")
    tab.settle()
    assert "load = 77.0" in tab.get("case", "value")
    second = tab.driver.current_window_handle
    tab.driver.switch_to.window(first)
    assert "load = 600.0" in tab.get("case", "value")
    closed, left = served.pages[-1], served.pages[-2]
    kept = Path(
        closed.uploads.add(
            "heights.txt",
            b"1 2 3 4\n" * 4,
            {"length_x": 1e-4, "length_y": 1e-4, "height_unit": "nm"},
        )
    )
    assert kept.exists()
    tab.driver.switch_to.window(second)
    tab.driver.close()
    tab.driver.switch_to.window(first)
    tab.until(lambda: not any(worker.alive for worker in closed.workers))
    tab.until(lambda: not kept.parent.parent.exists())
    assert left.worker.alive
    tab.type("load", "99")
    tab.settle(129)


@pytest.mark.long
def test_an_older_answer_never_replaces_a_newer_one(tab, page):
    """After many fast moves of the slider, the result of its last position is shown."""
    answers = []
    deliver = page.worker.deliver

    def watch(generation, answer):
        answers.append((generation, answer))
        deliver(generation, answer)

    page.worker.deliver = watch
    tab.run(
        "const m = Bokeh.documents[0].get_model_by_name('stamp'); window.shown = [];"
        "m.connect(m.properties.data.change, () => window.shown.push(m.data.generation[0]));"
        "const s = Bokeh.documents[0].get_model_by_name('slider_load');"
        "for (let k = 0; k < 60; k++) setTimeout(() => { s.value = 150 + k }, 20 * k)"
    )
    time.sleep(1.5)
    tab.settle()
    # the first answer again, as if it had taken longest
    deliver(*answers[0])
    page.soon(lambda: page.layout.note.update(text="it came"))
    tab.until(lambda: tab.get("note", "text") == "it came")
    shown = tab.run("return window.shown")
    assert len(set(shown)) >= 3
    assert shown == sorted(shown)
    assert tab.stamp()[0] == tab.stamp()[1]
    load = float(re.search(r"load = (\S+)", tab.get("case", "value"))[1])
    assert load == pyehl.app.controls.CONTROLS["load"].at(209)
    point = pyehl.OperatingPoint.from_settings(
        pyehl.Case.from_text(tab.get("case", "value")).resolve()
    )
    assert rows_of(tab, "numbers")["Moes load M"] == f"{point.moes_m:.4g}"


@pytest.mark.parametrize(
    "path",
    [
        "/etc/passwd",
        "/static/../../../etc/passwd",
        "/static/%2e%2e/%2e%2e/server.py",
        "/static//etc/passwd",
        "/cases/quick.nml",
        "/summary.json",
        "/pyehl/app/page.py",
    ],
)
def test_nothing_else_is_served(served, path):
    connection = http.client.HTTPConnection("127.0.0.1", served.port, timeout=10)
    connection.request("GET", path)
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    assert answer.status in (403, 404), path
    assert b"root:" not in body


def test_only_this_machine_and_this_page(served):
    """The socket listens only at 127.0.0.1, and accepts no page of another origin."""
    listening = [
        line.split()[1]
        for table in ("/proc/net/tcp", "/proc/net/tcp6")
        for line in Path(table).read_text().splitlines()[1:]
        if line.split()[3] == "0A" and line.split()[1].endswith(f":{served.port:04X}")
    ]
    assert listening == [f"0100007F:{served.port:04X}"]
    head = {
        "Upgrade": "websocket",
        "Connection": "Upgrade",
        "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
        "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Protocol": "bokeh, token",
    }
    for origin, expected in (("http://example.org", 403), (f"http://127.0.0.1:{served.port}", 0)):
        connection = http.client.HTTPConnection("127.0.0.1", served.port, timeout=10)
        connection.request("GET", "/ws", headers={**head, "Origin": origin})
        status = connection.getresponse().status
        connection.close()
        # the origin of this page passes the check, and fails only for its token
        assert (status == 403) == (expected == 403), (origin, status)


@pytest.mark.parametrize(
    "host", ["localhost", "evil.example", "127.0.0.1.evil.example", "localhost.", ""]
)
def test_requests_with_other_host_names_are_refused(served, host):
    """A host name bound to the loopback is refused, even from its own origin."""
    head = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13"}
    head["Sec-WebSocket-Key"] = "dGhlIHNhbXBsZSBub25jZQ=="
    for path in ("/", "/ws", "/metadata", "/static/js/bokeh.min.js"):
        given = {**(head if path == "/ws" else {}), "Host": f"{host}:{served.port}"}
        given["Origin"] = f"http://{host}:{served.port}"
        connection = http.client.HTTPConnection("127.0.0.1", served.port, timeout=60)
        connection.request("GET", path, headers=given)
        status = connection.getresponse().status
        connection.close()
        assert (status == 403) == (host != "localhost"), (path, status)


@pytest.mark.parametrize(
    ("count", "kilobytes"),
    [
        pytest.param(100, 15_000, marks=pytest.mark.long),
        pytest.param(1000, 60_000, marks=pytest.mark.slow),
    ],
)
def test_many_changes_in_the_browser(tab, served, count: int, kilobytes: int):
    """Memory of the server stays constant, apart from what the allocator keeps."""

    def held() -> int:
        gc.collect()
        ctypes.CDLL(None).malloc_trim(0)
        text = Path("/proc/self/status").read_text()
        return int(re.search(r"VmRSS:\s+(\d+)", text)[1])

    def turns(count: int) -> None:
        for k in range(count):
            before = tab.stamp()[0]
            tab.run(
                "Bokeh.documents[0].get_model_by_name('slider_load').value = arguments[0]",
                100 + (7 * k) % 150,
            )
            tab.until(lambda before=before: tab.stamp()[0] > before)
            if k % 10 == 0:
                tab.settle(129)

    tab.settle()
    turns(60)
    tab.settle()
    before = held()
    turns(count)
    tab.settle()
    after = held()
    assert after - before < kilobytes, json.dumps({"before": before, "after": after})
