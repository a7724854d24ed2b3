"""The page: header, controls, and the containers that the page's own modules fill."""

from typing import Any

from nicegui import Client, ui
from nicegui.elements.mixins.text_element import TextElement
from nicegui.events import GenericEventArguments

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.server.controls import Controls
from equipoise.app.dashboard.server.request_queue import Counter

HEAD = (
    '<link rel="stylesheet" href="/static/vendor/uPlot.min.css">'
    '<link rel="stylesheet" href="/static/style.css">'
    '<link rel="stylesheet" href="/static/shell.css">'
    '<script type="module" nonce="{nonce}" src="/static/page.js"></script>'
)
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
        TextElement(tag="h1", text=counter.testbed.name).classes("eq-title")
        phase = ui.label().classes("eq-phase")
        note = ui.label().classes("eq-note").props("role=status")
        ui.element("span").props("id=eq-link aria-live=polite")
        _views(dark)
    with ui.element("div").classes("eq-main"):  # the shell has a <main> around it
        with _section("eq-left", "Controls"):
            controls = Controls(counter, page.id)
        with _section("eq-view", "Platform"):
            _container("eq-scene")
        with _section("eq-story", "Numbers and steps"):
            _container("eq-numbers")
            _container("eq-story")
        with _section("eq-strips", "Charts"):
            _time_slider(counter, page.id)
            _container("eq-charts")

    def refresh() -> None:
        state = counter.watch.state
        phase.set_text(_phase(counter))
        note.set_text(state.get("note") or state.get("working") or "")
        controls.refresh()

    ui.timer(EVERY, refresh)
    page.on_delete(lambda: counter.guard.leave(page.id))


def _section(place: str, heading: str) -> ui.element:
    """Lay a part of the page, with a heading that is read out and not drawn."""
    with ui.element("section").classes(place).props(f'aria-label="{heading}"') as section:
        TextElement(tag="h2", text=heading).classes("eq-unseen")
    return section


def _container(name: str) -> None:
    ui.element("div").props(f"id={name}")


def _views(dark: ui.dark_mode) -> None:
    """Lay the place for what a reader chooses for this page alone (``views.js``).

    The choices need no token. The theme alone is passed on, since the shell has its own.
    """

    def themed(event: GenericEventArguments) -> None:
        dark.set_value(_detail(event) is True)

    place = ui.element("div").classes("eq-views")
    place.props("id=eq-views role=group aria-label=View").on("themed", themed, ["detail"])


def _detail(event: GenericEventArguments) -> Any:
    """Return what an event of the page's own modules brings; it may be anything."""
    sent: Any = event.args
    try:
        return sent["detail"]
    except (TypeError, LookupError):
        return sent


def _phase(counter: Counter) -> str:
    about, state = counter.watch.about, counter.watch.state
    speed = state.get("speed", 1.0)
    fast = "" if speed == 1.0 else " fastest" if speed == 0 else f" {speed:g} x"
    return f"{about.get('bench', '')}: {state.get('phase', 'starting')}{fast}"


def _time_slider(counter: Counter, page: str) -> None:
    """Lay the slider of a replay's time; ``timebar.js`` moves it, a person's change seeks."""

    def seek(event: GenericEventArguments) -> None:
        why = counter.request(page, requests.Seek(_detail(event)))
        if why:
            ui.notify(why, type="warning")

    with ui.element("div").classes("eq-timebar"):
        slider = ui.element("input").props(
            'id=eq-time type=range step=0.1 aria-label="Time of the recording"'
        )
    slider.on("seek", seek, ["detail"])
