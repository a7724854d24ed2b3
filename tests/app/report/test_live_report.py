"""The report in Debian's Chromium, opened from its file: charts, replay, themes, paper."""

import os
import re
import shutil
from itertools import pairwise
from pathlib import Path

import pytest
from playwright.sync_api import expect

from equipoise.app.cli import run
from equipoise.app.report import scripts
from equipoise.app.report.write import set_again
from tests.support.dashboard_program import CHROMIUM, SIZES, barriers, browser

needs_chromium = pytest.mark.skipif(
    CHROMIUM is None, reason="no chromium: apt-get install chromium"
)
LARGEST = 3_000_000  # bytes
THEMES = ("light", "dark")


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """Return the report of an identification with camera, gyro and a move of the masses."""
    folder = tmp_path_factory.mktemp("live")
    record, out = folder / "record.csv", folder / "out"
    words = ["simulate", "nanosat", "--out", str(record), "--duration-s", "20", "--seed", "2"]
    assert run(words) == 0
    assert run(["identify", str(record), "--testbed", "nanosat", "--out", str(out)]) in (0, 1)
    return out / "report.html"


@pytest.fixture(scope="module")
def chromium():
    with browser() as opened:
        yield opened


class Opened:
    """A page that shows a report, and what it requested and wrote to its console."""

    def __init__(self, chromium, report, **options):
        self.requested, self.said = [], []
        self.page = chromium.new_page(**({"viewport": {"width": 1280, "height": 720}} | options))
        self.page.on("request", lambda request: self.requested.append(request.url))
        self.page.on("console", lambda message: self.said.append((message.type, message.text)))
        self.page.on("pageerror", lambda error: self.said.append(("error", str(error))))
        self.page.goto(report.as_uri())

    def wait_until_live(self):
        self.page.wait_for_function("() => window.equipoiseReport?.replays.length > 0")
        return self

    def figure(self, name):
        return self.page.locator(f'figure[data-name="{name}"]')

    def plot(self, name):
        """Return the first plot of a chart."""
        return self.figure(name).locator(".u-over").first

    def span(self, name):
        """Return the stretch of the abscissa that a chart shows."""
        return self.page.evaluate(
            """(name) => {
                const { min, max } = equipoiseReport.figures
                    .find((figure) => figure.name === name).panels[0].plot.scales.x;
                return [min, max];
            }""",
            name,
        )


@pytest.fixture(scope="module")
def page_once(chromium, report):
    return Opened(chromium, report).wait_until_live()


@pytest.fixture
def opened(page_once):
    """Return the page with the whole record shown."""
    page_once.page.emulate_media(media="screen")
    page_once.page.evaluate("equipoiseReport.figures.forEach(({ range }) => range.showWhole())")
    return page_once


@needs_chromium
def test_it_opens_from_its_file_without_a_request(opened, report):
    outside = [url for url in opened.requested if not url.startswith(("blob:", "data:"))]
    assert outside == [report.as_uri()]
    assert [text for kind, text in opened.said if kind in ("error", "warning")] == []
    expect(opened.page.locator("html")).to_have_attribute("lang", "en")


@needs_chromium
def test_every_chart_stands_in_place_of_its_drawing(opened):
    charts = opened.page.locator('figure[data-kind="chart"]')
    names = charts.evaluate_all("(all) => all.map((figure) => figure.dataset.name)")
    expected = {"figure06_attitude", "figure07_residual", "figure08_rate", "gyro_residual",
                "residual_histogram", "residual_autocorrelation"}  # fmt: skip
    assert set(names) >= expected
    for name in names:
        expect(opened.plot(name)).to_be_visible()
        expect(opened.figure(name).locator("> img")).to_be_hidden()


def drag(opened, name, start, end):
    """Drag over shares of the width of a plot."""
    plot = opened.plot(name)
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    y = box["y"] + box["height"] / 2
    opened.page.mouse.move(box["x"] + start * box["width"], y)
    opened.page.mouse.down()
    opened.page.mouse.move(box["x"] + end * box["width"], y, steps=5)
    opened.page.mouse.up()


@needs_chromium
def test_dragging_zooms_all_charts_of_the_record(opened):
    start, end = opened.span("figure08_rate")
    drag(opened, "figure08_rate", 0.25, 0.5)
    for name in ("figure08_rate", "gyro_residual", "figure06_attitude"):
        low, high = opened.span(name)
        assert low == pytest.approx(start + 0.25 * (end - start), abs=0.01 * (end - start))
        assert high == pytest.approx(start + 0.5 * (end - start), abs=0.01 * (end - start))
    assert opened.span("residual_histogram")[0] < -4  # an axis of its own
    opened.plot("gyro_residual").dblclick()
    assert opened.span("figure08_rate") == [start, end]


@needs_chromium
def test_shift_and_drag_moves_the_stretch(opened):
    drag(opened, "figure08_rate", 0.25, 0.5)
    low, high = opened.span("figure08_rate")
    opened.page.keyboard.down("Shift")
    drag(opened, "figure08_rate", 0.5, 0.25)
    opened.page.keyboard.up("Shift")
    moved = opened.span("figure08_rate")
    assert moved[0] == pytest.approx(low + 0.25 * (high - low), abs=0.01 * (high - low))
    assert moved[1] - moved[0] == pytest.approx(high - low)


@needs_chromium
def test_keys_and_buttons_zoom_and_move_as_the_mouse_does(opened):
    start, end = opened.span("figure08_rate")
    opened.figure("figure08_rate").locator(".eq-plot").focus()
    opened.page.keyboard.press("+")
    low, high = opened.span("figure08_rate")
    assert high - low == pytest.approx(0.6 * (end - start))
    opened.page.keyboard.press("ArrowRight")
    assert opened.span("figure08_rate")[0] > low
    opened.figure("figure08_rate").get_by_role("button", name="Whole").click()
    assert opened.span("figure08_rate") == [start, end]


def moment_of(place):
    """Return the time of the cursor, as a panel's heading states it."""
    stated = re.compile(r"at ([\d.]+) s")
    expect(place).to_have_text(stated)
    return stated.search(place.inner_text())[1]


@needs_chromium
def test_the_cursor_stands_at_the_same_moment_in_all_charts_of_the_record(opened):
    plot = opened.plot("figure08_rate")
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    unit = opened.figure("figure08_rate").locator(".eq-unit").first
    for down in range(20, 40):  # a page that still settles moves away from under the pointer
        plot.hover(position={"x": box["width"] / 2, "y": down})
        if "at" in unit.inner_text():
            break
    moments = [
        moment_of(opened.figure(name).locator(".eq-unit").first)
        for name in ("figure08_rate", "gyro_residual", "figure06_attitude")
    ]
    start, end = opened.span("figure08_rate")
    assert len(set(moments)) == 1
    assert float(moments[0]) == pytest.approx((start + end) / 2, abs=0.1)


@needs_chromium
def test_a_key_hides_its_line_and_shows_it_again(opened):
    key = opened.figure("gyro_residual").locator(".eq-key").first
    shown = """() => equipoiseReport.figures.find((figure) => figure.name === "gyro_residual")
        .panels[0].plot.series[1].show"""
    for pressed, visible in (("false", False), ("true", True)):
        key.click()
        expect(key).to_have_attribute("aria-pressed", pressed)
        assert opened.page.evaluate(shown) is visible


@needs_chromium
def test_the_replay_moves_the_platform_and_the_cursor_of_the_charts(opened):
    turned = "() => equipoiseReport.replays[0].view.platform.group.quaternion.toArray()"
    clock = opened.page.get_by_label("Time of the replay")
    before = opened.page.evaluate(turned)
    opened.page.get_by_label("Speed").select_option("5")
    opened.page.get_by_role("button", name="Play").click()
    opened.page.wait_for_function("() => equipoiseReport.replays[0].at > 2")
    opened.page.get_by_role("button", name="Pause").click()
    opened.page.wait_for_timeout(300)  # the scene is drawn at its own pace
    after = opened.page.evaluate(turned)
    assert max(abs(a - b) for a, b in zip(before, after, strict=True)) > 1e-3
    assert float(clock.input_value()) > 2
    unit = opened.figure("figure08_rate").locator(".eq-unit")
    expect(unit).to_contain_text(f"at {float(clock.input_value()):.1f} s")


@needs_chromium
def test_without_scripts_and_on_paper_the_drawings_stand(chromium, report, opened):
    still = Opened(chromium, report, java_script_enabled=False)
    for there in (still, opened):
        if there is opened:
            there.page.emulate_media(media="print")
        expect(there.figure("figure08_rate").locator("> img")).to_be_visible()
        expect(there.plot("figure08_rate")).to_be_hidden()
        expect(there.figure("replay_identification")).to_be_hidden()
    still.page.close()


@needs_chromium
@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("size", SIZES.values(), ids=SIZES)
def test_it_fits_every_screen_and_is_accessible(chromium, report, tmp_path, size, theme):
    """In both themes; the pictures are there to be looked at."""
    width, height = size
    there = Opened(chromium, report, viewport={"width": width, "height": height},
                   color_scheme=theme).wait_until_live()  # fmt: skip
    page = there.page
    expect(page.locator("html")).to_have_attribute("data-theme", theme)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    kept = Path(os.environ.get("EQUIPOISE_SCREENSHOTS", tmp_path))
    page.screenshot(path=kept / f"report-{width}x{height}-{theme}.png", full_page=True)
    assert barriers(page) == []
    page.close()


def test_a_usual_report_is_small(report):
    assert report.stat().st_size < LARGEST


def test_without_the_page_libraries_the_report_is_still_and_says_so(report, tmp_path, monkeypatch):
    folder, static = tmp_path / "run", tmp_path / "static"
    shutil.copytree(report.parent, folder)
    shutil.copytree(Path(str(scripts.SHARED)), static, ignore=shutil.ignore_patterns("vendor"))
    monkeypatch.setattr(scripts, "SHARED", static)
    set_again(folder)
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "page libraries of this installation are missing" in page
    assert "<script" not in page
    assert page.count("<img") == report.read_text(encoding="utf-8").count("<img")


def test_tables_have_captions_and_scopes_and_headings_are_in_order(report):
    page = report.read_text(encoding="utf-8")
    assert "<caption>Centre of mass and inertia about P, masses at home</caption>" in page
    assert '<th scope="row">com_x</th>' in page
    assert '<th scope="col" class="right">testbed file</th>' in page
    levels = [int(level) for level in re.findall(r"<h(\d)>", page)]
    assert levels[0] == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))
