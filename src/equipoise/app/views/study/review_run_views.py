"""The reproduction of the review, da Silva et al. 2021, for terminal, JSON and report."""

from collections.abc import Iterator

from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.papers.null_vector import pictures_of as null_pictures
from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.text.blocks import Blocks, Section
from equipoise.app.text.json_lists import REPRODUCE
from equipoise.app.text.json_shape import View
from equipoise.app.views.study.comparison_report import law_pictures, method_pictures
from equipoise.app.views.study.paper_views import paper_table
from equipoise.app.views.study.review_views import laws_table, methods_table
from equipoise.study.papers.review_run import ReviewRun

PAPER = (
    "da Silva et al. 2021, A review of balancing methods for satellite simulators, section 4.2 "
    "with Fig. 3, Tables 2 and 3"
)


def output_of(done: ReviewRun) -> Output:
    """Return all that is handed over."""
    return Output("reproduce", document_of(done), blocks(done), lambda: record_of(done))


def blocks(done: ReviewRun) -> Blocks:
    """Return the review's claims beside ours, and its Tables 2 and 3 measured."""
    name = done.testbed.name
    return (
        paper_table("da Silva et al. 2021 compared with this program", done.rows),
        methods_table(done.methods.methods, name),
        laws_table(done.every_law, name),
    )


def document_of(done: ReviewRun) -> View:
    """Return the reproduction as JSON."""
    return REPRODUCE.write({"paper": "dasilva2021", "seeds": done.seeds, "rows": done.rows})


def record_of(done: ReviewRun) -> RunRecord:
    """Return the reproduction as a report."""
    return RunRecord(
        title="The review of da Silva et al. reproduced",
        requested={"paper": PAPER, "seeds": f"{done.seeds[0]} to {done.seeds[-1]}"},
        testbed=done.testbed,
        conclusion=(),
        sections=(Section("Claims of the review, and measurements", blocks(done)),),
        origin=origin(),
        figures=list(pictures_of(done)),
    )


def pictures_of(done: ReviewRun) -> Iterator[Picture]:
    """Yield Fig. 3, and what Tables 2 and 3 compare."""
    yield from null_pictures(done.null)
    yield from method_pictures(done.methods)
    yield from law_pictures(done.laws)
