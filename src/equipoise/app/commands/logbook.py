"""`equipoise logbook`: the runs of a folder, listed, compared, drawn, exported."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Flag, Json, Listed
from equipoise.app.arguments.run_filter import LATEST, WantedRuns, choice_of
from equipoise.app.console.terminal import busy, complain, show_paths, stderr

if TYPE_CHECKING:
    from equipoise.io.documents.logbook import Choice, Logbook


def logbook(
    folder: Path | None = None,
    /,
    *,
    wanted: WantedRuns = LATEST,
    compare: Listed = (),
    builds: Flag = False,
    trend: Path | None = None,
    export: Path | None = None,
    json: Json = False,
) -> int:
    """List, compare and export the runs that were kept.

    The index beside the runs, logbook.sqlite, can be deleted; it is rebuilt from their folders.

    Parameters
    ----------
    folder
        Folder of runs. If omitted: the one that EQUIPOISE_RUNS names, else equipoise-runs.
    compare
        Runs to show side by side, by number in the list or by name, with or without the folder of
        the month. The first is the reference.
    builds
        List the testbed files that platforms have had, and their differences.
    trend
        Figure to write (.png, .svg, .pdf): centre of mass and inertia over time, with changes of
        the testbed file marked, and over temperature where recorded.
    export
        Table to write (.csv or .parquet): one line per run, SI units.
    """
    from equipoise.app.logbook.run_folder import USUAL, runs_folder
    from equipoise.io.documents.logbook import open_logbook
    from equipoise.model.errors import InputError

    if builds and compare:
        raise InputError("--builds", "with --compare", "one of the two")
    for path in (trend, export):
        _check(path, ".png .svg .pdf" if path is trend else ".csv .parquet")
    choice = choice_of(wanted)
    with open_logbook(folder or runs_folder() or Path(USUAL)) as book:
        for sentence in book.unread:
            complain(f"left out: {sentence}")
        if builds:
            _show_builds(book, choice, json)
        elif compare:
            _show_compared(book, choice, compare, json)
        else:
            _show(book, choice, json, bool(trend or export))
        _write(book, choice, trend, export, json)
    return 0


def _check(path: Path | None, suffixes: str) -> None:
    from equipoise.io.files.atomic_file import check_writable
    from equipoise.model.errors import InputError

    if path is not None:
        if path.suffix.lower() not in suffixes.split():
            raise InputError(str(path), f"suffix '{path.suffix}'", f"one of {suffixes}")
        check_writable(path)


def _show(book: "Logbook", choice: "Choice", json: bool, in_files: bool) -> None:
    """Print runs; in a table no more than usual of those that files have too."""
    from equipoise.app.logbook import views
    from equipoise.app.logbook.output import print_result

    if in_files and not json:
        choice = choice._replace(last=min(choice.last or LATEST.last, LATEST.last))
    shown = book.runs(choice)
    earlier = book.count(choice) - len(shown)
    if earlier and not json:
        stderr().print(f"{earlier} earlier runs are not shown (--last 0: all).")
    print_result(views.runs_json(book, shown), views.runs_blocks(book, shown), json)


def _show_compared(book: "Logbook", choice: "Choice", compare: Listed, json: bool) -> None:
    from equipoise.app.logbook import views
    from equipoise.app.logbook.output import print_result

    shown = book.runs(choice)
    chosen = [views.chosen(shown, name) for name in compare]
    print_result(views.compared_json(book, chosen), (views.compared(book, chosen),), json)


def _show_builds(book: "Logbook", choice: "Choice", json: bool) -> None:
    from equipoise.app.logbook.output import print_result
    from equipoise.app.logbook.testbed_history import builds_blocks, builds_json

    shown = book.builds(choice)
    print_result(builds_json(book, shown), builds_blocks(book, shown), json)


def _write(
    book: "Logbook", choice: "Choice", trend: Path | None, export: Path | None, aside: bool
) -> None:
    paths = [path for path in (trend, export) if path is not None]
    if trend is not None:
        with busy("drawing"):
            from equipoise.app.logbook.trend import write_trend

            write_trend(book, choice, trend)
    if export is not None:
        from equipoise.app.logbook.export import write_export

        write_export(book, choice, export)
    if paths:
        show_paths(paths, aside)
