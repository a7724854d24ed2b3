"""`equipoise report`: the report of a run, set anew."""

from pathlib import Path

from equipoise.app.console.terminal import busy, show_paths


def report(run: Path, /) -> int:
    """Write report.html and report.pdf of a run anew, from the parts that its folder holds.

    A run that was made without typst has no PDF: install it, then use this.

    Parameters
    ----------
    run
        Folder of a run.
    """
    with busy("setting the report", announce=False):
        from equipoise.app.report.write import set_again

        paths = set_again(run)
    show_paths(paths)
    return 0
