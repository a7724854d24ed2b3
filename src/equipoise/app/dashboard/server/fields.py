"""Fields of the page: three numbers in a row, and how they are read."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from nicegui import ui

from equipoise.app.dashboard.protocol.series import AXES
from equipoise.model.units import UM, in_si

Triple = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class TripleField:
    """Three number fields, shown in um."""

    fields: Sequence[ui.number]

    def read(self) -> Triple | None:
        """Return three lengths (m); None if one is missing."""
        x, y, z = (field.value for field in self.fields)
        if x is None or y is None or z is None:
            return None
        return (in_si(x, UM), in_si(y, UM), in_si(z, UM))


def triple(what: str, shown_um: Triple) -> TripleField:
    """Lay three number fields side by side, labelled by axis."""
    ui.label(f"{what} (µm)").classes("eq-label")
    with ui.row().classes("eq-triple"):
        fields = [
            ui.number(axis, value=value, format="%g").props(
                f'dense outlined aria-label="{what} {axis} in um"'
            )
            for axis, value in zip(AXES, shown_um, strict=True)
        ]
    return TripleField(fields)


def button(text: str, do: Callable[[], None], style: str = "outline") -> ui.button:
    """Lay a button; its text is what it does."""
    return ui.button(text, on_click=do).props(f"{style} no-caps dense").classes("eq-button")
