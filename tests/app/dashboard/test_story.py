"""The whole story in Debian's Chromium, of a dashboard that runs as a program of its own."""

from functools import partial

import numpy as np
import pytest
from playwright.sync_api import expect

from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import tilt
from tests.support import thorough
from tests.support.dashboard_program import (
    CHROMIUM,
    Received,
    barriers,
    browser,
    dashboard,
    pictures,
    started,
)

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no chromium: apt-get install chromium")
SOON, LATER = 15_000, 120_000  # ms: a busy computer


@pytest.fixture(scope="module")
def chromium():
    with browser() as opened:
        yield opened


def opened(chromium, running, **options):
    page = chromium.new_page(viewport={"width": 1280, "height": 720}, **options)
    received = Received(page)
    page.goto(running.url)
    expect(page.locator("#eq-link")).to_contain_text("connected", timeout=LATER)
    return page, received


def button(page, name):
    return page.get_by_role("button", name=name, exact=True)


def state(page):
    return page.evaluate("window.equipoise.state()")


def take_command(page, token):
    """By keyboard alone."""
    page.get_by_label("Token").focus()
    page.keyboard.type(token)
    page.keyboard.press("Enter")


def chosen(page, label, option):
    page.get_by_label(label, exact=True).click()
    page.get_by_role("option", name=option, exact=True).click()


def wait_until(page, condition, most=LATER):
    """A function, which is evaluated once: the page's policy allows no evaluation of texts."""
    page.wait_for_function(f"() => {condition}", timeout=most)


def test_a_platform_is_balanced_and_another_stopped_from_the_page(chromium, tmp_path):
    """What of the story below a change breaks most easily."""
    with dashboard(tmp_path, "nanosat", "--expose", "127.0.0.1") as running:
        page, received = opened(chromium, running)
        expect(button(page, "Start balancing")).to_be_disabled()
        says_what_to_do_first(page)
        nobody_is_shut_out(chromium, running)
        take_command(page, running.token)
        expect(button(page, "Start balancing")).to_be_enabled(timeout=SOON)
        balanced_until_it_passes(page)
        pictures_of(page, tmp_path)
        stopped_by_hand(page)
        assert received.wrong == []
        assert received.requested == {f"127.0.0.1:{running.port}"}


@thorough.whole
def test_the_whole_story(chromium, tmp_path):
    running = started(tmp_path, "nanosat")
    try:
        page, received = opened(chromium, running)
        a_viewer_commands_nothing(page)
        a_wrong_token_is_refused(page, running)
        a_second_commander_is_refused(chromium, page, running)
        balanced_until_it_passes(page)
        pictures_of(page, tmp_path)
        report_downloaded(page, running)
        masses_jogged(page)
        recorded_and_marked(page)
        stopped_by_hand(page)
        replayed_as_recorded(page, tmp_path)
        assert received.wrong == []
        assert received.requested == {f"127.0.0.1:{running.port}"}
        running = restarted(page, running, tmp_path)
    finally:
        running.end()


def a_viewer_commands_nothing(page):
    for name in ("Start balancing", "Stop", "Let go"):
        expect(button(page, name)).to_be_disabled()
    assert state(page)["steps"] == 0


def a_wrong_token_is_refused(page, running):
    take_command(page, "wrong")
    expect(page.get_by_text("Wrong token")).to_be_visible(timeout=SOON)
    expect(button(page, "Start balancing")).to_be_disabled()
    take_command(page, running.token)
    expect(button(page, "Start balancing")).to_be_enabled(timeout=SOON)


def a_second_commander_is_refused(chromium, page, running):
    second, _ = opened(chromium, running)
    take_command(second, running.token)
    expect(second.get_by_text("Another page is in command")).to_be_visible(timeout=SOON)
    expect(button(second, "Stop")).to_be_disabled()
    second.close()
    expect(button(page, "Stop")).to_be_enabled()


def balanced_until_it_passes(page):
    page.get_by_role("tab", name="Bench").click()
    chosen(page, "Speed", "20 x")
    page.get_by_role("tab", name="Balance").click()
    button(page, "Start balancing").click()
    expect(page.locator("#eq-story em", has_text="passed")).to_be_visible(timeout=3 * LATER)
    button(page, "Hold").click()
    expect(page.locator(".eq-phase")).to_contain_text("paused", timeout=SOON)
    kinds = page.locator("#eq-story b").all_inner_texts()
    assert set(kinds) >= {"measurement", "estimate", "move", "verify"}


def says_what_to_do_first(page):
    """And nothing that nobody has measured: an empty chart has neither ticks nor lines."""
    steps = page.locator("#eq-story .eq-hint li")
    expect(steps.first).to_contain_text("token", timeout=SOON)
    expect(page.locator(".eq-left")).to_contain_text("terminal")
    plots = page.locator(".eq-chart[data-empty=true]").first.locator(".eq-plot > *")
    expect(plots.first).to_have_css("visibility", "hidden")
    assert page.evaluate("document.documentElement.lang").startswith("en")
    levels = page.locator("h1, h2, h3").evaluate_all("all => all.map(e => Number(e.tagName[1]))")
    assert levels[0] == 1
    assert max(np.diff(levels)) <= 1


def nobody_is_shut_out(chromium, running):
    """In both themes, with every tab; a page of its own, since axe-core lays styles into it."""
    page, _ = opened(chromium, running, bypass_csp=True)
    take_command(page, running.token)
    expect(button(page, "Start balancing")).to_be_enabled(timeout=SOON)
    for _ in ("light", "dark"):
        for tab in ("Masses", "Data", "Bench", "Balance"):
            page.get_by_role("tab", name=tab).click()
            assert once_settled(page, barriers) == []  # what fades in has no contrast of its own
        page.get_by_role("switch", name="Dark").click()
    button(page, "Release").click()  # a page that is closed keeps it until its socket is given up
    expect(button(page, "Start balancing")).to_be_disabled(timeout=SOON)
    page.close()


def pictures_of(page, folder):
    """At three sizes in both themes: what is cut off, or wider than the page, is found."""
    for theme in ("light", "dark"):
        cut = partial(once_settled, measurement=cut_off)
        assert pictures(page, folder, f"dashboard-{theme}", cut) == []
        page.get_by_role("switch", name="Dark").click()
    page.set_viewport_size({"width": 1280, "height": 720})


def cut_off(page):
    """Return the texts of headings, numbers and buttons that do not fit into their place."""
    texts = "#eq-numbers > *, figcaption, .eq-left button, .eq-left .q-tab__label"
    return page.locator(texts).evaluate_all("""all => all
        .filter(e => e.offsetParent && e.scrollWidth > e.clientWidth + 1)
        .map(e => e.textContent)""")


def once_settled(page, measurement):
    """Return what is found once it is nothing, or after ten seconds: a busy computer is slow."""
    for _ in range(20):
        found = measurement(page)
        if not found:
            break
        page.wait_for_timeout(500)
    return found


def report_downloaded(page, running):
    page.get_by_role("tab", name="Data").click()
    link = page.get_by_role("link", name="HTML")
    expect(link).to_be_visible(timeout=LATER)
    html = page.request.get(running.url + link.get_attribute("href"))
    assert html.ok
    assert "within tolerance on every axis" in html.text()
    pdf = page.request.get(running.url + page.get_by_role("link", name="PDF").get_attribute("href"))
    assert pdf.body()[:5] == b"%PDF-"
    for name in ("/runs/../printed.txt", "/runs/%2e%2e/printed.txt", "/runs/..%2fprinted.txt"):
        assert page.request.get(running.url + name).status == 404


def masses_jogged(page):
    page.get_by_role("tab", name="Masses").click()
    before = state(page)["series"]["masses"]["last"]
    field = page.get_by_label("x in mm", exact=True)
    field.fill("3")
    field.press("Tab")
    button(page, "Move x").click()
    button(page, "Let go").click()
    wait_until(page, "Math.abs(window.equipoise.state().series.masses.last[1] - 0.003) < 1e-4")
    after = state(page)["series"]["masses"]["last"]
    assert after[2:] == pytest.approx(before[2:], abs=1e-9)
    expect(page.locator("#eq-story").get_by_text("x sent to 3.00 mm by hand")).to_be_visible()
    field.fill("900")
    field.press("Tab")
    button(page, "Move x").click()
    page.wait_for_timeout(500)
    assert abs(state(page)["series"]["masses"]["last"][1]) < 0.1


def recorded_and_marked(page):
    page.get_by_role("tab", name="Bench").click()
    chosen(page, "Speed", "real time")
    button(page, "Another simulated platform").click()
    wait_until(page, "window.equipoise.state().clock === 2")
    assert state(page)["steps"] == 0
    page.get_by_role("tab", name="Data").click()
    button(page, "Let go").click()
    button(page, "Record").click()
    expect(button(page, "End recording")).to_be_visible(timeout=SOON)
    page.get_by_label("What happened").fill("a door was opened")
    button(page, "Mark").click()
    expect(page.locator("#eq-story").get_by_text("a door was opened")).to_be_visible(timeout=SOON)
    page.wait_for_timeout(3000)
    button(page, "End recording").click()
    expect(button(page, "Record")).to_be_visible(timeout=SOON)


def stopped_by_hand(page):
    steps = state(page)["steps"]
    button(page, "Start balancing").click()
    wait_until(page, f"window.equipoise.state().steps > {steps}")
    button(page, "Stop").click()
    expect(page.locator("#eq-story em", has_text="halted")).to_be_visible(timeout=LATER)
    expect(button(page, "Start balancing")).to_be_enabled(timeout=SOON)


def replayed_as_recorded(page, folder):
    """The last numbers of the page are the last rows of the file, and so they are at a time."""
    (file,) = (folder / "runs" / "recordings").glob("*.mcap")
    kept = read_recording(file)
    chosen(page, "Recording", f"recordings/{file.name}")
    button(page, "Replay").click()
    expect(page.get_by_text("The recording has ended.")).to_be_visible(timeout=LATER)
    wait_until(page, f"window.equipoise.state().series.pose.last[0] > {kept.attitude.t[-1] - 1e-6}")
    page.wait_for_timeout(1500)
    shown = state(page)["series"]
    assert shown["pose"]["last"] == pytest.approx([kept.attitude.t[-1], *kept.attitude.values[-1]])
    assert shown["rate"]["last"][:4] == pytest.approx([kept.rate.t[-1], *kept.rate.values[-1]])
    number = page.locator("#eq-numbers output[data-name=tilt]").get_attribute("data-si")
    up = np.array([0.0, 0.0, 1.0])
    assert float(number) == pytest.approx(float(tilt(kept.attitude.values[-1], up)), abs=1e-6)
    slider = page.get_by_role("slider", name="Time of the recording")
    slider.focus()
    page.keyboard.press("PageDown")  # a tenth back
    wait_until(page, f"window.equipoise.state().series.pose?.last?.[0] < {kept.attitude.t[-1]}")
    t, *q = state(page)["series"]["pose"]["last"]
    back = 0.1 * np.ptp(kept.attitude.t)
    assert t == pytest.approx(kept.attitude.t[-1] - back, abs=0.25 * back + 0.1)
    assert q == pytest.approx(kept.attitude.values[np.searchsorted(kept.attitude.t, t - 1e-6)])
    button(page, "Back to the simulation").click()
    expect(page.locator(".eq-phase")).to_contain_text("simulated", timeout=SOON)


def restarted(page, running, folder):
    """A server that crashes is missed and said so; another one in its place is found by itself."""
    running.kill()
    expect(page.locator("#eq-link")).to_contain_text("no connection", timeout=SOON)
    again = started(folder, "nanosat", "--seed", "4", port=running.port)
    try:
        found_again(page, again)
    except BaseException:
        again.kill()
        raise
    return again


def found_again(page, again):
    expect(page.locator("#eq-link")).to_contain_text("connected", timeout=LATER)
    wait_until(page, "window.equipoise?.state().link === 'open'")
    expect(button(page, "Start balancing")).to_be_disabled(timeout=SOON)
    take_command(page, again.token)
    expect(button(page, "Start balancing")).to_be_enabled(timeout=SOON)
