"""The column of controls: a person's requests. Observers see it, their requests are refused."""

from collections.abc import Callable, Iterable, Sequence

from nicegui import ui

from equipoise.app.arguments.checks import Triple
from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.protocol.data_folder import recordings
from equipoise.app.dashboard.protocol.series import AXES
from equipoise.app.dashboard.server.fields import (
    Field,
    choice,
    number_field,
    offer,
    switch,
    text_field,
)
from equipoise.app.dashboard.server.request_queue import AUTO, Counter
from equipoise.app.text.numbers import TRAVEL
from equipoise.model.testbed import SlidingMass
from equipoise.model.units import MINUTE, UM, in_si

TARGET_UM, TOLERANCE_UM = (0.0, 0.0, -100.0), (2.0, 2.0, 3.0)  # as ``equipoise balance`` has them
SPEEDS = {0.5: "half", 1.0: "real time", 2.0: "2 x", 5.0: "5 x", 20.0: "20 x", 0.0: "fastest"}
TOKEN_IS = "The terminal in which the dashboard was started shows the token."
TABS = ("Balance", "Masses", "Data", "Bench")


class Controls:
    """The controls of one page."""

    def __init__(self, counter: Counter, page: str) -> None:
        self._counter, self._page = counter, page
        self._needing: list[ui.button] = []  # a commander
        self._listed: object = self  # what was recorded and kept when the list was made
        self._token_row()
        with ui.row().classes("eq-buttons"):
            self.start = self._button("Start balancing", self._start, "unelevated color=primary")
            self.stop = self._button(
                "Stop", lambda: self._request(requests.Stop()), "color=negative"
            )
            self.hold = self._button("Let go", self._hold, "outline")
        with ui.tabs().props("dense no-caps align=justify").classes("eq-tabs") as tabs:
            for name in TABS:
                ui.tab(name)
        with ui.tab_panels(tabs, value=TABS[0]).classes("eq-panels"):
            for name, fill in zip(
                TABS, (self._balance, self._masses, self._data, self._bench), strict=True
            ):
                with ui.tab_panel(name):
                    fill()

    def refresh(self) -> None:
        """Show how things stand."""
        counter, state = self._counter, self._counter.watch.state
        mine, phase = counter.guard.commands(self._page), state.get("phase", "idle")
        for each in self._needing:
            each.set_enabled(mine)
        self.start.set_enabled(mine and phase in ("idle", "paused"))
        self.command.set_text("Release" if mine else "Command")
        self.where.set_visibility(not mine)
        self.hold.set_text("Let go" if phase in ("paused", "held") else "Hold")
        self.hold.set_visibility(counter.watch.about.get("bench") != "real")
        self.record.set_text("End recording" if state.get("recording") else "Record")
        kept = state.get("kept")
        files = (state.get("recording"), kept)
        if files != self._listed:
            offer(self.chosen, words(recordings(counter.folder)))
            self._listed = files
        self.reports.set_visibility(bool(kept))
        if kept:
            self.html.props(f'href="/runs/{kept}/report.html"')
            self.pdf.props(f'href="/runs/{kept}/report.pdf"')
            self.pdf.set_visibility((counter.folder / kept / "report.pdf").is_file())

    # --- Parts -------------------------------------------------------------------------------

    def _token_row(self) -> None:
        self.where = ui.label(TOKEN_IS).classes("eq-label")
        with ui.row().classes("eq-token"):
            self.token = text_field("Token")
            self.token.element.props(
                'dense outlined autocomplete=off aria-label="Token" input-class="eq-secret"'
            )
            self.token.element.on("keydown.enter", self._command, [])
            self.command = button("Command", self._command)

    def _balance(self) -> None:
        laws = self._counter.laws
        self.law = choice(words(laws), laws[0])
        self.law.element.props("dense outlined options-dense label=Law")
        self.target = triple("Target", TARGET_UM)
        self.tolerance = triple("Tolerance", TOLERANCE_UM)
        self.keep = number_field("Then keep the balance for (min)", 0.0, "%.0f")
        self.keep.element.props('dense outlined aria-label="Minutes to keep the balance"')
        self.stand = switch("q-checkbox", "Masses stand still meanwhile", self._stand)
        self.stand.element.props("dense")
        self.held = switch("q-checkbox", "A person holds the platform level")
        self.held.element.props("dense")
        self.held.element.set_visibility(self._counter.watch.about.get("bench") == "real")
        ui.separator()
        self.method = choice(words([AUTO, *self._counter.methods]), AUTO)
        self.method.element.props("dense outlined options-dense label=Method")
        self._button("Identify from the recorded motion", self._identify)

    def _masses(self) -> None:
        if not self._counter.testbed.masses:
            ui.label("This testbed has no sliding masses.")
        for mass in self._counter.testbed.masses:
            self._jog(mass)

    def _jog(self, mass: SlidingMass) -> None:
        low, high = (edge / TRAVEL.size for edge in mass.travel)
        with ui.row().classes("eq-jog"):
            field = number_field(f"{mass.name}: {low:g} to {high:g} mm", 0.0, "%.2f")
            field.element.props(f'dense outlined aria-label="{mass.name} in mm"')

            def move() -> None:
                if field.value is not None:
                    self._request(requests.Jog(mass.name, in_si(field.value, TRAVEL.size)))

            self._button(f"Move {mass.name}", move)

    def _data(self) -> None:
        self.record = self._button("Record", self._record)
        with ui.row().classes("eq-jog"):
            self.text = text_field("What happened")
            self.text.element.props('dense outlined aria-label="What happened"')
            self._button("Mark", lambda: self._request(requests.Mark(self.text.value or "mark")))
        self.chosen = choice({}, None)
        self.chosen.element.props("dense outlined options-dense label=Recording")
        with ui.row().classes("eq-buttons"):
            self._button("Replay", self._replay)
            self._button("Back to the simulation", lambda: self._request(requests.Replay("")))
        with ui.row().classes("eq-reports") as self.reports:
            ui.label("Report of the last run:")
            self.html, self.pdf = (anchor("HTML"), anchor("PDF"))

    def _bench(self) -> None:
        speed = choice(SPEEDS, 1.0, lambda factor: self._request(requests.Speed(factor)))
        speed.element.props("dense outlined options-dense label=Speed")
        self.seed = number_field("Seed", 2)
        self.seed.element.props("dense outlined")
        self._button("Another simulated platform", self._anew)

    # --- Requests ----------------------------------------------------------------------------

    def _button(self, text: str, do: Callable[[], None], style: str = "outline") -> ui.button:
        made = button(text, do, style)
        self._needing.append(made)
        return made

    def _request(self, *requests: requests.Request) -> None:
        for request in requests:
            why = self._counter.request(self._page, request)
            if why:
                ui.notify(why, type="warning")

    def _command(self) -> None:
        guard = self._counter.guard
        if guard.commands(self._page):
            guard.leave(self._page)
        else:
            why = guard.take(self._page, self.token.value)
            self.token.put("")
            ui.notify(why or "This page commands now.", type="negative" if why else "positive")
        self.refresh()

    def _start(self) -> None:
        target, tolerance = lengths(self.target), lengths(self.tolerance)
        if target is None or tolerance is None:
            ui.notify("Target and tolerance need three numbers each.")
            return
        keep = in_si(self.keep.value or 0.0, MINUTE)
        wanted = requests.Balance(target, tolerance, self.law.value, None, self.held.value, keep)
        paused = self._counter.watch.state.get("phase") == "paused"
        self._request(*_first_let_go(paused), wanted)

    def _stand(self, on: bool) -> None:
        self._request(requests.Stand(on))

    def _hold(self) -> None:
        held = self._counter.watch.state.get("phase") in ("paused", "held")
        self._request(requests.Pause(not held))

    def _identify(self) -> None:
        self._request(requests.Identify(self.method.value))

    def _record(self) -> None:
        self._request(requests.Record(not self._counter.watch.state.get("recording")))

    def _replay(self) -> None:
        if self.chosen.value:
            self._request(requests.Replay(self.chosen.value))

    def _anew(self) -> None:
        seed = self.seed.value
        if seed is not None:
            self._request(requests.Anew(int(seed)))


def _first_let_go(paused: bool) -> Sequence[requests.Request]:
    return (requests.Pause(False),) if paused else ()


def words(names: Iterable[str]) -> dict[str, str]:
    """Return names as options, each in its own words."""
    return {name: name for name in names}


def triple(what: str, shown_um: Triple) -> list[Field[float | None]]:
    """Lay three number fields side by side, labelled by axis."""
    ui.label(f"{what} (µm)").classes("eq-label")
    with ui.row().classes("eq-triple"):
        fields = [number_field(axis, value) for axis, value in zip(AXES, shown_um, strict=True)]
    for axis, field in zip(AXES, fields, strict=True):
        field.element.props(f'dense outlined aria-label="{what} {axis} in um"')
    return fields


def lengths(fields: Sequence[Field[float | None]]) -> Triple | None:
    """Return the lengths (m) in three fields in um; None if one is missing."""
    x, y, z = (field.value for field in fields)
    if x is None or y is None or z is None:
        return None
    return (in_si(x, UM), in_si(y, UM), in_si(z, UM))


def button(text: str, do: Callable[[], None], style: str = "outline") -> ui.button:
    """Lay a button; its text is what it does."""
    return ui.button(text, on_click=do).props(f"{style} no-caps dense").classes("eq-button")


def anchor(text: str) -> ui.element:
    """Lay a link that opens beside the page; the page cannot be reached from there."""
    with ui.element("a").props("target=_blank rel=noopener") as made:
        ui.label(text)
    return made
