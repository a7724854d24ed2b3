"""The reproduction of Ivanov et al. for terminal, JSON and report."""

from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.papers.ivanov_catalogue import pictures_of
from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.runs.balancing import Balancing
from equipoise.app.text.blocks import Blocks, Section
from equipoise.app.text.json_lists import REPRODUCE
from equipoise.app.text.json_shape import View
from equipoise.app.views.balancing import balance_views
from equipoise.app.views.study.paper_views import paper_table
from equipoise.model.units import MINUTE, UM
from equipoise.study.papers.ivanov import DRIFT
from equipoise.study.papers.ivanov_balancing import SPEEDS
from equipoise.study.papers.ivanov_run import IvanovRun

PAPER = (
    "Ivanov et al. 2021, Estimation of an inertia tensor and automatic balancing of a "
    "microsatellite mockup on an air-bearing testbed, sections 4 and 5"
)


def output_of(done: IvanovRun, balancing: Balancing) -> Output:
    """Return all that is handed over."""
    return Output("reproduce", document_of(done), blocks(done), lambda: record_of(done, balancing))


def blocks(done: IvanovRun) -> Blocks:
    """Return the paper's numbers beside ours."""
    return (paper_table("Ivanov et al. 2021 compared with this program", done.rows),)


def document_of(done: IvanovRun) -> View:
    """Return the reproduction as JSON."""
    return REPRODUCE.write({"paper": "ivanov2021", "seeds": done.seeds, "rows": done.rows})


def record_of(done: IvanovRun, balancing: Balancing) -> RunRecord:
    """Return the reproduction as a report; drawing its figures takes a while."""
    slow, fast = SPEEDS * MINUTE / UM
    simulated = {
        "paper": PAPER,
        "seeds": f"{done.seeds[0]} to {done.seeds[-1]}",
        "drift, not declared": f"{DRIFT * MINUTE / UM:g} um/min in sections 4 and 5, "
        f"{slow:g} to {fast:g} um/min where it is balanced",
    }
    return RunRecord(
        title="Ivanov et al.'s experiments reproduced",
        requested=simulated,
        testbed=done.preset,
        conclusion=(),
        sections=(Section("The paper's numbers compared with ours", blocks(done)),),
        origin=origin(),
        figures=[*pictures_of(done), *balancing_pictures(balancing)],
    )


def balancing_pictures(balancing: Balancing) -> list[Picture]:
    """Return Figs. 14 and 15."""
    return balance_views.pictures_of(balancing, balancing.courses())
