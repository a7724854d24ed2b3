"""`equipoise reproduce`: a paper's simulation run again, with its figures."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Json, Whole
from equipoise.app.console.terminal import busy

if TYPE_CHECKING:
    from equipoise.study.papers.lee import Manoeuvre

PAPERS = ("lee",)


def reproduce(
    paper: str, /, *, seed: Whole = 1, out: Path | None = None, json: Json = False
) -> int:
    """Run a paper's simulation again, beside what this program makes of it.

    lee: two slews by control moment gyros, a large and a small one; the averaged integral as
    printed and corrected, and the trajectory fit, with the least sd that the data allow.

    Parameters
    ----------
    paper
        Paper to reproduce: lee.
    seed
        Seed of all that is drawn: the same seed gives the same run.
    out
        Folder for the paper's figures, report.html and reproduce.json.
    """
    from equipoise.app.arguments.checks import check_outputs, one_of, seed_of

    one_of("paper", paper, list(PAPERS))
    seed = seed_of(seed)
    check_outputs(out)
    runs = _slews(seed)
    from equipoise.app.logbook.output import hand_over
    from equipoise.app.views.study.lee_views import output_of

    hand_over(output_of(runs, seed), json, out)
    return 0


def _slews(seed: int) -> "list[Manoeuvre]":
    """Return both slews with what was made of them."""
    from equipoise.io.testbed.presets import read_preset

    with busy("preparing", announce=False):
        from equipoise.study.papers.lee import LARGE, SMALL, judged, slew_from

    bed, done = read_preset("kau"), list["Manoeuvre"]()
    for start in (LARGE, SMALL):
        where = f"from {start[0]:g} deg of roll"
        with busy(f"slewing {where}"):
            slew = slew_from(bed, start, seed)
        with busy(f"identifying {where}"):
            done.append(judged(bed, start, slew))
    return done
