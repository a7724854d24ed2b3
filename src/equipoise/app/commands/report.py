"""`equipoise report`: the report of a run, set anew."""

from pathlib import Path

from equipoise.app.arguments.options import Flag
from equipoise.app.console.terminal import busy


def report(run: Path, /, *, png: Flag = False) -> int:
    """Rebuild the report of a run.

    A run that was made without typst has no PDF. Type `pip install "equipoise[report]"` first.

    Parameters
    ----------
    run
        Folder of a run.
    png
        Also write each figure as PNG, 300 pixels per inch.
    """
    with busy("setting the report", announce=False):
        from equipoise.app.logbook.output import show_report
        from equipoise.app.report.write import set_again

        paths = set_again(run, as_png=png)
    show_report(paths)
    return 0
