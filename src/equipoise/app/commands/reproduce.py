"""`equipoise reproduce`: what a paper reports, made again, beside what this program makes of it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import ALONE, Json, Spreading, Whole
from equipoise.app.console.terminal import busy

if TYPE_CHECKING:
    from equipoise.app.engine.spread import Spread
    from equipoise.app.report.run_record import Output


@dataclass(frozen=True, slots=True, eq=False)
class Requested:
    """How often, from which seed on, and by what."""

    seeds: range
    by: Callable[[str], "Spread"]  # takes what is done, for those who wait


def reproduce(
    paper: str | None = None,
    /,
    *,
    runs: Whole = 20,
    seed: Whole = 1,
    spreading: Spreading = ALONE,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Reproduce the results of a paper, number by number.

    ivanov2021: records and their fits, the tracker along a move, the law with a move every 25 s and
    our own, with an undeclared drift; Figs. 4 to 15.

    dasilva2021: Fig. 3, and Tables 2 and 3 measured: every method and law, and a person, on
    platforms of the preset reference-table.

    lee: two slews by control moment gyros, a large and a small one; the averaged integral as
    printed and corrected, and the trajectory fit, with the least sd that the data allow; Figs. 3 to
    18.

    table1: the review's thirteen testbeds, each balanced by its own method and by our best; what
    is left beside what is printed. It takes a quarter of an hour for 20 platforms each.

    Parameters
    ----------
    paper
        Paper to reproduce. If omitted: list the papers and their items.
    runs
        Number of experiments and platforms, where a paper has several.
    seed
        Random seed; the same seed gives the same run.
    out
        Folder for the paper's figures, report.html and reproduce.json.
    """
    from equipoise.app.arguments.checks import check_outputs, one_of, positive, seed_of
    from equipoise.app.arguments.many_runs import engine_from

    if paper is None:
        return _listed(json, out)
    one_of("paper", paper, list(PAPERS))
    first = seed_of(seed)
    seeds = range(first, first + int(positive("--runs", runs)))
    engine = engine_from(spreading)
    check_outputs(out)
    with busy("preparing", announce=False):
        from equipoise.app.engine.spread import spread_over
        from equipoise.app.logbook.output import hand_over
        from equipoise.app.runs.terminal_waiting import AT_TERMINAL

    with engine() as pool:

        def by(what: str) -> "Spread":
            return spread_over(pool, partial(AT_TERMINAL.many, what))

        output = PAPERS[paper].run(Requested(seeds, by))
    hand_over(output, json, out)
    return 0


def _ivanov(requested: Requested) -> "Output":
    """Return Ivanov's experiments, and one balancing for its figures."""
    from equipoise.app.runs.balancing import Goal, Limits, run
    from equipoise.app.views.study.ivanov_views import output_of
    from equipoise.io.testbed.presets import read_preset
    from equipoise.simulation.bench import SimulatedBench
    from equipoise.study.papers import ivanov_balancing
    from equipoise.study.papers.ivanov_run import ivanov_run

    preset, seed = read_preset("sputnix"), requested.seeds[0]
    done = ivanov_run(preset, requested.seeds, requested.by)
    law = ivanov_balancing.LAWS[0]
    bed = ivanov_balancing.bed_of(ivanov_balancing.Trial(law, preset, seed, drifts=True))
    goal = Goal(ivanov_balancing.TARGET, ivanov_balancing.REACHED)
    with busy("balancing"):
        balancing = run(SimulatedBench(bed, seed), goal, Limits(law=law), None)
    return output_of(done, balancing)


def _lee(requested: Requested) -> "Output":
    """Return Lee's two slews, of one seed."""
    from equipoise.app.views.study.lee_views import output_of
    from equipoise.io.testbed.presets import read_preset
    from equipoise.study.papers.lee_rows import lee_run

    return output_of(lee_run(read_preset("kau"), requested.seeds[0], busy))


def _dasilva(requested: Requested) -> "Output":
    """Return the review's figure and tables."""
    from equipoise.app.runs.comparison import chosen_methods, run_methods
    from equipoise.app.views.study.review_run_views import output_of
    from equipoise.estimation.method_contract import Options
    from equipoise.io.testbed.presets import read_preset
    from equipoise.study.method_record import Scene
    from equipoise.study.papers import review_run
    from equipoise.study.papers.null_vector import null_vector

    bed, seeds = read_preset("reference-table"), requested.seeds
    with busy("looking for the null vector"):
        null = null_vector(read_preset("tas2"))
    moves = ((review_run.MOVED_AT, review_run.MOVE),)
    scene = Scene(bed, review_run.RECORD, moves, Options())
    methods = run_methods(scene, chosen_methods(()), seeds, requested.by("estimating"))
    laws = review_run.laws_run(bed, seeds, requested.by("balancing"))
    weights = read_preset("weights-by-hand")
    by_hand = review_run.by_hand(bed, weights, seeds, requested.by("balancing by hand"))
    return output_of(review_run.ReviewRun(bed, seeds, null, methods, laws, by_hand))


def _table1(requested: Requested) -> "Output":
    """Return the review's thirteen testbeds, each by its own method and by ours."""
    from equipoise.app.views.study.table1_views import output_of
    from equipoise.io.testbed.presets import read_preset
    from equipoise.study.papers.table1 import TABLE1
    from equipoise.study.papers.table1_run import table1_runs

    beds = {entry.preset: read_preset(entry.preset) for entry in TABLE1}
    runs = table1_runs(beds, TABLE1, requested.seeds, requested.by("balancing"))
    return output_of(runs, beds[TABLE1[0].preset], requested.seeds)


@dataclass(frozen=True, slots=True)
class Paper:
    """A paper that can be reproduced."""

    title: str
    run: Callable[[Requested], "Output"]


PAPERS = {
    "ivanov2021": Paper("Ivanov et al. 2021: identification and balancing by a camera", _ivanov),
    "dasilva2021": Paper("da Silva et al. 2021: the null vector, methods and laws", _dasilva),
    "lee": Paper("Lee et al.: the integration method on two slews by gyros", _lee),
    "table1": Paper("da Silva et al. 2021, Table 1: thirteen testbeds, each balanced", _table1),
}


def _listed(json: bool, out: Path | None) -> int:
    """Print the papers and what they ask for."""
    from equipoise.app.logbook.output import print_result
    from equipoise.app.views.study.items_views import blocks, document_of
    from equipoise.model.errors import InputError

    if out is not None:
        raise InputError("--out", "no paper", f"one of {', '.join(PAPERS)}")
    papers = {name: paper.title for name, paper in PAPERS.items()}
    print_result(document_of(papers), blocks(papers), json)
    return 0
