"""The viewer of a recording in Debian's Chromium, and the command that serves it."""

import urllib.error
import urllib.request

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import DEG
from equipoise.simulation.bench import SimulatedBench
from tests.support.dashboard_program import CHROMIUM, Received, barriers, browser, pictures, viewer

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no chromium: apt-get install chromium")
LATER = 60_000  # ms: a busy computer
LENGTH = 12.0  # s


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """A simulated platform for twelve seconds, with two marks."""
    bed = read_preset("nanosat")
    path = tmp_path_factory.mktemp("recorded") / "run.mcap"
    with LiveRecording(path, Opening(10**18)) as live:
        live.rows(SimulatedBench(bed, 1).read(LENGTH))
        live.event(2.0, "mark", "a door was opened", {})
        live.event(9.0, "mark", "a door was shut", {})
    return path


@pytest.fixture(scope="module")
def running(file, tmp_path_factory):
    words = (file, "--testbed", "nanosat")
    with viewer(tmp_path_factory.mktemp("viewer"), *words) as there:
        yield there


@pytest.fixture(scope="module")
def chromium():
    with browser() as opened:
        yield opened


@pytest.fixture
def page(chromium, running):
    """A page that is open, has asked nobody else, and says nothing on its console."""
    context = chromium.new_context(viewport={"width": 1280, "height": 720})
    opened = context.new_page()
    received = Received(opened)
    opened.goto(running.url)
    drawn(opened)
    yield opened
    context.close()
    assert received.wrong == []
    assert received.requested <= {f"127.0.0.1:{running.port}", "", ","}


def drawn(page):
    """Wait until the charts have their size and their lines."""
    page.wait_for_function("() => window.equipoise", timeout=LATER)
    expect(page.locator(".eq-unit").first).not_to_be_empty(timeout=LATER)
    page.wait_for_timeout(500)


def state(page):
    return page.evaluate("window.equipoise.state()")


def button(page, name):
    return page.get_by_role("button", name=name, exact=True)


def chart(page, name):
    return page.locator(f".eq-chart[data-series={name}]")


def saved(page, name, kind):
    with page.expect_download(timeout=LATER) as download:
        chart(page, name).get_by_text(kind, exact=True).click()
    return download.value.path()


def test_a_recording_opens_whole_with_its_marks_and_without_commands(page, file):
    whole = read_recording(file).span
    shown = state(page)
    assert shown["whole"] == pytest.approx({"from": whole[0], "length": whole[1] - whole[0]})
    assert shown["span"] == shown["whole"]
    expect(page.locator("#eq-story li")).to_have_count(2)
    expect(page.locator("#eq-story")).to_contain_text("a door was opened")
    assert page.get_by_label("Token").count() == 0
    for name in ("Start balancing", "Stop", "Command", "Let go", "Record"):
        assert button(page, name).count() == 0
    assert page.evaluate("document.documentElement.lang") == "en"
    levels = page.locator("h1, h2, h3").evaluate_all("all => all.map(e => Number(e.tagName[1]))")
    assert levels[0] == 1
    assert max(np.diff(levels)) <= 1


def test_a_mark_leads_to_its_time_where_the_numbers_are_the_recordings(page, file):
    button(page, "9.0 s").click()
    assert state(page)["now"] == pytest.approx(9.0)
    rate = read_recording(file).rate
    wanted = np.linalg.norm(rate.values[np.searchsorted(rate.t, 9.0, side="right") - 1])
    number = page.locator("#eq-numbers output[data-name=rate]")
    page.wait_for_timeout(500)
    assert float(number.get_attribute("data-si")) == pytest.approx(wanted, rel=1e-9)


def test_play_moves_the_time_and_pause_holds_it(page):
    button(page, "Play").click()
    page.wait_for_function("() => window.equipoise.state().now > 0.3", timeout=LATER)
    button(page, "Pause").click()
    held = state(page)["now"]
    page.wait_for_timeout(300)
    assert state(page)["now"] == held
    assert not state(page)["playing"]


def test_a_drag_zooms_to_the_part_and_a_double_click_shows_the_whole(page):
    whole = state(page)["whole"]
    box = chart(page, "rate").locator(".u-over").bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.25 * box["width"], middle)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.75 * box["width"], middle, steps=5)
    page.mouse.up()
    span = state(page)["span"]
    assert span["length"] == pytest.approx(0.5 * whole["length"], rel=0.02)
    assert span["from"] == pytest.approx(0.25 * whole["length"], rel=0.05)
    page.keyboard.down("Shift")
    page.mouse.down()
    page.mouse.move(box["x"] + 0.65 * box["width"], middle, steps=5)
    page.mouse.up()
    page.keyboard.up("Shift")
    panned = state(page)["span"]
    assert panned["length"] == pytest.approx(span["length"])
    assert panned["from"] - span["from"] == pytest.approx(0.1 * span["length"], rel=0.2)
    page.mouse.dblclick(box["x"] + 0.5 * box["width"], middle)
    assert state(page)["span"] == whole


def test_the_keyboard_alone_zooms_pans_and_plays(page):
    whole = state(page)["whole"]
    page.locator("#eq-charts").focus()
    page.keyboard.press("+")
    assert state(page)["span"]["length"] == pytest.approx(whole["length"] / 2)
    before = state(page)["span"]["from"]
    page.keyboard.press("ArrowRight")
    assert state(page)["span"]["from"] > before
    page.keyboard.press("0")
    assert state(page)["span"] == whole
    page.keyboard.press("Space")
    assert state(page)["playing"]
    page.keyboard.press("Space")
    page.get_by_role("slider", name="Time of the recording").focus()
    page.keyboard.press("End")
    assert state(page)["now"] == pytest.approx(whole["from"] + whole["length"])


def test_a_chart_is_saved_as_the_rows_that_it_shows(page, file):
    button(page, "Zoom in").click()
    span = state(page)["span"]
    table = np.genfromtxt(saved(page, "rate", "CSV"), delimiter=",", names=True)
    rate = read_recording(file).rate
    shown = (rate.t >= span["from"]) & (rate.t <= span["from"] + span["length"])
    assert 0 < shown.sum() < len(rate)
    assert table["time_s"] == pytest.approx(rate.t[shown])
    for k, axis in enumerate("xyz"):
        assert table[f"rate_{axis}_deg_s"] == pytest.approx(rate.values[shown, k] / DEG)


def test_a_chart_is_saved_as_a_picture_with_its_lines(page):
    with Image.open(saved(page, "attitude", "PNG")) as picture:
        assert picture.format == "PNG"
        assert picture.width > 200
        colours = {colour for _, colour in picture.convert("RGB").getcolors(1 << 24)}
    assert {(0xD5, 0x5E, 0x00), (0x00, 0x72, 0xB2)} <= colours  # roll and yaw of the light theme


def test_the_layout_of_a_reader_is_kept(page):
    page.get_by_text("Panels").click()
    page.get_by_role("checkbox", name="Residual torque").uncheck()
    page.get_by_role("checkbox", name="3-D view").uncheck()
    page.get_by_label("Units").select_option("si")
    page.get_by_role("switch", name="Dark").check()
    page.reload()
    drawn(page)
    expect(chart(page, "torque")).to_be_hidden()
    expect(page.locator("#eq-scene")).to_be_hidden()
    expect(chart(page, "rate")).to_contain_text("rad/s")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_it_fits_every_screen_and_nobody_is_shut_out(page, theme, tmp_path):
    page.emulate_media(color_scheme=theme)
    page.reload()
    drawn(page)
    button(page, "9.0 s").click()
    found = barriers(page)
    page.get_by_text("Panels").click()
    assert [*found, *barriers(page)] == []
    page.get_by_text("Panels").click()
    assert pictures(page, tmp_path, f"replay-{theme}") == []


@pytest.mark.parametrize(
    ("path", "headers", "status"),
    [
        ("/replay/rows", {}, 200),
        ("/replay/rows", {"Origin": "http://evil.example"}, 403),
        ("/replay/rows", {"Host": "evil.example"}, 403),
        ("/runs/x", {}, 404),
        ("/replay/../../x", {}, 404),
    ],
)
def test_the_server_answers_its_own_page_alone(running, path, headers, status):
    request = urllib.request.Request(f"http://127.0.0.1:{running.port}{path}", headers=headers)
    try:
        with urllib.request.urlopen(request) as answer:
            found = answer.status
    except urllib.error.HTTPError as error:
        found = error.code
    assert found == status
