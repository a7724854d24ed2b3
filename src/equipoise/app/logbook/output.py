"""What every command does with its result: print it or its JSON document, and write it down."""

from collections.abc import Callable, Sequence
from pathlib import Path

from equipoise.app.console.terminal import busy, show_paths, stderr
from equipoise.app.logbook.run_folder import own_folder
from equipoise.app.text.json_document import View, dump


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
        show_paths(paths, json)


def keep(write: Callable[[Path], Sequence[Path]], kind: str, platform: str) -> None:
    """Write a result into a folder of its own among the runs, if runs are kept."""
    own = own_folder(kind, platform)
    if own is not None:
        with busy("writing the report", announce=False):
            write(own)
        stderr().print(f"kept in {own}", markup=False)
