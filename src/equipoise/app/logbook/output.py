"""What every command does with its result: print its blocks or its JSON, and write it down."""

from collections.abc import Sequence
from pathlib import Path

from equipoise.app.console.rich_blocks import show
from equipoise.app.console.terminal import busy, print_whole, show_paths, stderr
from equipoise.app.logbook.run_folder import own_folder
from equipoise.app.report.pdf import NO_PDF, can_set
from equipoise.app.report.run_record import Output
from equipoise.app.report.write import write_output
from equipoise.app.text.blocks import Blocks
from equipoise.app.text.json_document import dump
from equipoise.app.text.json_shape import View


def print_result(document: View, blocks: Blocks, json: bool, below: bool = False) -> None:
    """Print a result's document, or its blocks; ``below`` sets those off from what stands above."""
    if json:
        print_whole(dump(document))
    else:
        show(blocks, below)


def hand_over(output: Output, json: bool, out: Path | None, below: bool = False) -> None:
    """Print the document or the blocks; write the report into ``out`` if that is requested.

    ``below`` sets the blocks off from what was printed on the way.
    """
    print_result(output.document, output.blocks, json, below)
    if out is not None:
        with busy("drawing"):
            paths = write_output(output, out)
        show_report(paths, json)


def show_report(paths: Sequence[Path], aside: bool = False) -> None:
    """Say what was written, and why no PDF is among it."""
    show_paths(paths, aside)
    if not can_set():
        stderr().print(NO_PDF, soft_wrap=True, markup=False)


def hand_over_run(
    output: Output, json: bool, out: Path | None, platform: str, below: bool = False
) -> None:
    """Hand over a run; without ``out`` keep it. ``below``: its steps were printed already."""
    hand_over(output, json, out, below)
    if out is None:
        keep(output, platform)


def keep(output: Output, platform: str) -> None:
    """Write a result into a folder of its own among the runs, if runs are kept."""
    own = None if output.logged is None else own_folder(output.logged.kind, platform)
    if own is not None:
        with busy("writing the report", announce=False):
            write_output(output, own)
        stderr().print(f"kept in {own}")
