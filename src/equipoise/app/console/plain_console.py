"""The one maker of consoles: what it prints is text, whatever is written in it.

No markup, no emoji codes, no highlighting: a name such as ``[/red]`` is shown as it is written.
Each text is made visible (``for_terminal``) before it is laid out, and once more as it leaves, so
that no way to the terminal goes round it. Styles are stated by the program alone.
"""

from collections.abc import Iterable
from typing import Any

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment
from rich.text import Text

from equipoise.app.text.escaping import for_terminal

PLAIN: dict[str, Any] = {"markup": False, "emoji": False, "highlight": False}


def shown(text: str, style: str = "") -> Text:
    """Return a text as rich draws it, all of it visible."""
    return Text(for_terminal(text), style=style)


class PlainConsole(Console):
    """A console that reads no meaning into texts."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings, **PLAIN)

    def render_str(self, text: str, **settings: Any) -> Text:
        """Return a text as it is laid out."""
        return super().render_str(for_terminal(text), **settings | PLAIN)

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Yield what is written; only what rich itself does with the cursor may act."""
        for segment in super().render(renderable, options):
            yield segment if segment.control else segment._replace(text=for_terminal(segment.text))
