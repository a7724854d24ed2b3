"""The page: header, controls, and the containers that the page's own modules fill."""

from nicegui import ui
from nicegui.events import GenericEventArguments

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.server.controls import Controls
from equipoise.app.dashboard.server.request_queue import Counter

HEAD = (
    '<link rel="stylesheet" href="/static/vendor/uPlot.min.css">'
    '<link rel="stylesheet" href="/static/style.css">'
    '<link rel="stylesheet" href="/static/shell.css">'
    '<script type="module" src="/static/page.js"></script>'
)
SPANS = {20: "20 s", 60: "1 min", 300: "5 min", 1200: "20 min"}
UNITS = {"bench": "um, mm, deg", "si": "SI"}
EVERY = 0.3  # s, chosen: how often the controls follow how things stand


def build(counter: Counter) -> None:
    """Build a page that has just been opened."""
    page = ui.context.client
    ui.add_head_html(HEAD)
    dark = ui.dark_mode(value=False)
    with ui.element("header").classes("eq-head"):
        ui.label(counter.testbed.name).classes("eq-title")
        phase = ui.label().classes("eq-phase")
        note = ui.label().classes("eq-note").props("role=status")
        ui.html('<span id="eq-link" aria-live="polite"></span>', sanitize=False)
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
    """Lay the switches of this page alone, which need no token."""

    def themed(on: bool) -> None:
        dark.set_value(on)
        ui.run_javascript(f"window.equipoise?.dark({str(on).lower()})")

    ui.select(SPANS, value=60, on_change=lambda event: ui.run_javascript(
        f"window.equipoise?.span({event.value})")).props(
        'dense borderless options-dense aria-label="Time shown"')  # fmt: skip
    ui.select(UNITS, value="bench", on_change=lambda event: ui.run_javascript(
        f"window.equipoise?.units('{event.value}')")).props(
        'dense borderless options-dense aria-label="Units"')  # fmt: skip
    ui.switch("Dark", on_change=lambda event: themed(bool(event.value)))


def _phase(counter: Counter) -> str:
    about, state = counter.watch.about, counter.watch.state
    speed = state.get("speed", 1.0)
    fast = "" if speed == 1.0 else " fastest" if speed == 0 else f" {speed:g} x"
    return f"{about.get('bench', '')}: {state.get('phase', 'starting')}{fast}"


def _time_slider(counter: Counter, page: str) -> None:
    """Lay the slider of a replay's time; ``timebar.js`` moves it, a person's change seeks."""

    def seek(event: GenericEventArguments) -> None:
        why = counter.request(page, requests.Seek(float(event.args)))
        if why:
            ui.notify(why, type="warning")

    with ui.element("div").classes("eq-timebar"):
        slider = ui.element("input").props(
            'id=eq-time type=range step=0.1 aria-label="Time of the recording"'
        )
    slider.on("change", seek, js_handler="(event) => emit(Number(event.target.value))")
