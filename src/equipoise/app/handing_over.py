"""What every command does with its result: print it or its JSON document, and write it down."""

from collections.abc import Callable, Sequence
from pathlib import Path

from equipoise.app.terminal import busy, tell_paths
from equipoise.app.views_json import View, dump


def hand_over(
    document: View,
    show: Callable[[], None],
    write: Callable[[Path], Sequence[Path]],
    json: bool,
    out: Path | None,
) -> None:
    """Print the document, or show the result; write it into ``out`` if that is asked for."""
    if json:
        print(dump(document))
    else:
        show()
    if out is not None:
        with busy("drawing"):
            paths = write(out)
        tell_paths(paths, json)
