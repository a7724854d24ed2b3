"""The page: header, controls, and the containers that the page's own modules fill."""

from typing import Any

from nicegui import Client, ui
from nicegui.events import GenericEventArguments

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.server.controls import Controls
from equipoise.app.dashboard.server.fields import choice, switch
from equipoise.app.dashboard.server.request_queue import Counter

HEAD = (
    '<link rel="stylesheet" href="/static/vendor/uPlot.min.css">'
    '<link rel="stylesheet" href="/static/style.css">'
    '<link rel="stylesheet" href="/static/shell.css">'
    '<script type="module" nonce="{nonce}" src="/static/page.js"></script>'
)
SPANS = {20: "20 s", 60: "1 min", 300: "5 min", 1200: "20 min"}
UNITS = {"bench": "um, mm, deg", "si": "SI"}
UNCONNECTED = 20.0  # s, chosen: a page loads 2 MB before it connects
EVERY = 0.3  # s, chosen: how often the controls follow how things stand


async def open_page(counter: Counter) -> None:
    """Open a page; it is built once its socket is there.

    What only fetches the page costs little and is soon forgotten (NiceGUI does that where nobody
    connects in time).
    """
    page = ui.context.client
    ui.add_head_html(HEAD.format(nonce=page.request.scope["nonce"]))
    await page.connected(timeout=UNCONNECTED)
    if not page.is_deleted:
        _build(counter, page)


def _build(counter: Counter, page: Client) -> None:
    dark = ui.dark_mode(value=False)
    with ui.element("header").classes("eq-head"):
        ui.label(counter.testbed.name).classes("eq-title")
        phase = ui.label().classes("eq-phase")
        note = ui.label().classes("eq-note").props("role=status")
        ui.element("span").props("id=eq-link aria-live=polite")
        _views(dark)
    with ui.element("main").classes("eq-main"):
        with ui.element("section").classes("eq-left").props('aria-label="Controls"'):
            controls = Controls(counter, page.id)
        with ui.element("section").classes("eq-view"):
            _container("eq-scene")
        with ui.element("section").classes("eq-story"):
            _container("eq-numbers")
            _container("eq-story")
        with ui.element("section").classes("eq-strips"):
            _time_slider(counter, page.id)
            _container("eq-charts")

    def refresh() -> None:
        state = counter.watch.state
        phase.set_text(_phase(counter))
        note.set_text(state.get("note") or state.get("working") or "")
        controls.refresh()

    ui.timer(EVERY, refresh)
    page.on_delete(lambda: counter.guard.leave(page.id))


def _container(name: str) -> None:
    ui.element("div").props(f"id={name}")


def _views(dark: ui.dark_mode) -> None:
    """Lay the switches of this page alone, which need no token; ``page.js`` observes them."""
    shown = ui.element("div").props("id=eq-shown hidden data-span=60 data-units=bench")

    def show(what: str, value: object) -> None:
        shown.props[f"data-{what}"] = str(value).lower()

    def themed(on: bool) -> None:
        dark.set_value(on)
        show("dark", on)

    span = choice(SPANS, 60, lambda value: show("span", value))
    span.element.props('dense borderless options-dense aria-label="Time shown"')
    units = choice(UNITS, "bench", lambda value: show("units", value))
    units.element.props('dense borderless options-dense aria-label="Units"')
    switch("q-toggle", "Dark", themed)


def _phase(counter: Counter) -> str:
    about, state = counter.watch.about, counter.watch.state
    speed = state.get("speed", 1.0)
    fast = "" if speed == 1.0 else " fastest" if speed == 0 else f" {speed:g} x"
    return f"{about.get('bench', '')}: {state.get('phase', 'starting')}{fast}"


def _time_slider(counter: Counter, page: str) -> None:
    """Lay the slider of a replay's time; ``timebar.js`` moves it, a person's change seeks."""

    def seek(event: GenericEventArguments) -> None:
        sent: Any = event.args
        try:
            t: Any = sent["detail"]
        except (TypeError, LookupError):
            t = sent
        why = counter.request(page, requests.Seek(t))
        if why:
            ui.notify(why, type="warning")

    with ui.element("div").classes("eq-timebar"):
        slider = ui.element("input").props(
            'id=eq-time type=range step=0.1 aria-label="Time of the recording"'
        )
    slider.on("seek", seek, ["detail"])
