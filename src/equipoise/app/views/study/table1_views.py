"""Table 1 of the review made again, for terminal, JSON and report."""

from collections.abc import Sequence

from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.text.blocks import Blocks, Section
from equipoise.app.text.json_lists import REPRODUCE
from equipoise.app.views.study.paper_views import paper_table
from equipoise.model.testbed import Testbed
from equipoise.study.papers.table1_rows import rows_of
from equipoise.study.papers.table1_run import Ran

PAPER = "da Silva et al. 2021, A review of balancing methods for satellite simulators, Table 1"


def output_of(runs: Sequence[Ran], testbed: Testbed, seeds: Sequence[int]) -> Output:
    """Return all that is handed over; ``testbed`` is the first of the thirteen."""
    rows = tuple(row for run in runs for row in rows_of(*run))
    document = REPRODUCE.write({"paper": "table1", "seeds": seeds, "rows": rows})
    blocks: Blocks = (paper_table("The thirteen testbeds of Table 1", rows),)

    def record() -> RunRecord:
        return RunRecord(
            title="The testbeds of da Silva et al.'s Table 1 balanced",
            requested={"paper": PAPER, "platforms of each": str(len(seeds))},
            testbed=testbed,
            conclusion=(),
            sections=(Section("Printed and measured results", blocks),),
            origin=origin(),
        )

    return Output("reproduce", document, blocks, record)
