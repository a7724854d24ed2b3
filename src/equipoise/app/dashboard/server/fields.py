"""Fields of the page: a Quasar element each, the value it has, and what that may be.

A page can send anything as the value of a field. What is no value of its kind is refused in a
sentence, and the field keeps the value it had. The elements are Quasar's own: those of the shell
have templates, which a browser can only compile where its policy allows ``eval``.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Generic, TypeVar, cast

from nicegui import ui
from nicegui.events import GenericEventArguments

from equipoise.app.dashboard.protocol.requests import LETTERS, shown
from equipoise.model.errors import InputError

Value = TypeVar("Value")
DIGITS = 40  # of a number as it is typed, chosen


class Field(Generic[Value]):
    """A field; ``read`` returns a value from what a page has sent, or raises InputError."""

    def __init__(
        self,
        tag: str,
        value: Value,
        read: Callable[[Any], Value],
        changed: Callable[[Value], None] = lambda _: None,
        echo: bool = False,
    ) -> None:
        self.value, self._read, self._changed, self._echo = value, read, changed, echo
        self.element = ui.element(tag)
        self.element.props["model-value"] = value
        self.element.props["loopback"] = echo  # whether the page waits for the server's echo
        self.element.on("update:model-value", self._take, [None])

    def put(self, value: Value) -> None:
        """Give the field another value, on the page too."""
        self.value = value
        self.element.props["model-value"] = value
        self.element.update()

    def _take(self, event: GenericEventArguments) -> None:
        try:
            value = self._read(event.args)
        except InputError as error:
            ui.notify(str(error), type="warning")
            return
        self.value = value
        if self._echo:
            self.put(value)
        self._changed(value)


def text_field(label: str) -> Field[str]:
    """Lay a field of one line of text."""
    field = Field("q-input", "", text_of)
    field.element.props["label"] = label
    field.element.props["maxlength"] = LETTERS
    return field


def number_field(label: str, value: float, shape: str = "%g") -> Field[float | None]:
    """Lay a field of a number; None while it is empty."""
    field = Field[float | None]("q-input", value, number_of)
    field.element.props.update({"model-value": shape % value, "type": "number", "label": label})
    return field


def choice(
    options: Mapping[Any, str], value: Any, changed: Callable[[Any], None] = lambda _: None
) -> Field[Any]:
    """Lay a field of one among several; ``options`` gives the words for each."""

    def one_of(raw: Any) -> Any:
        if type(raw) not in (str, int, float) or raw not in _offered(field):
            raise InputError("choice", shown(raw), "one that this page lists")
        return raw

    field = Field[Any]("q-select", value, one_of, changed, echo=True)
    field.element.props.update({"emit-value": True, "map-options": True})
    offer(field, options)
    return field


def _offered(field: Field[Any]) -> list[Any]:
    options = cast("Sequence[Mapping[str, Any]]", field.element.props["options"])
    return [each["value"] for each in options]


def offer(field: Field[Any], options: Mapping[Any, str]) -> None:
    """Let a choice have these options."""
    field.element.props["options"] = [{"value": v, "label": word} for v, word in options.items()]


def switch(tag: str, label: str, changed: Callable[[bool], None] = lambda _: None) -> Field[bool]:
    """Lay a switch or a check box, by its tag."""
    field = Field(tag, False, flag_of, changed, echo=True)
    field.element.props["label"] = label
    return field


def text_of(raw: Any) -> str:
    """Return a text; InputError for what is none, or too long."""
    if raw is None:
        return ""
    if not isinstance(raw, str) or len(raw) > LETTERS:
        raise InputError("text", shown(raw), f"a text of at most {LETTERS} characters")
    return raw


def number_of(raw: Any) -> float | None:
    """Return a finite number as it is typed, None for nothing; InputError for what is none."""
    if raw in (None, ""):
        return None
    readable = type(raw) in (int, float) or (type(raw) is str and len(raw) <= DIGITS)
    try:
        value = float(raw) if readable else math.nan
    except (ValueError, OverflowError):
        value = math.nan
    if not math.isfinite(value):
        raise InputError("number", shown(raw), "a finite number")
    return value


def flag_of(raw: Any) -> bool:
    """Return true or false; InputError for what is neither."""
    if not isinstance(raw, bool):
        raise InputError("switch", shown(raw), "true or false")
    return raw
