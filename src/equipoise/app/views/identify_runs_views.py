"""An identification from several recordings for terminal, JSON and report."""

from collections.abc import Iterator
from functools import partial

from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.estimate import run_boxes
from equipoise.app.report.build import estimate_sections, findings_section, steps_section
from equipoise.app.report.run_record import Logged, Output, RunRecord, origin
from equipoise.app.runs.recordings.joint_identification import IdentifiedRun, JointIdentification
from equipoise.app.text.blocks import (
    Blocks,
    Column,
    Item,
    Items,
    Section,
    Table,
    number,
    tabulated,
)
from equipoise.app.text.estimate_text import (
    cells,
    estimate_tables,
    outcome_claim,
    unobservable_items,
)
from equipoise.app.text.json_results import IDENTIFY_RUNS
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import fixed, significant, unit_for, with_sd
from equipoise.app.text.run_blocks import TONES, verdict_claim
from equipoise.model.estimate import BODY, COM
from equipoise.model.joint_estimate import Spread

BESIDE = ("chi-square of the deviation from the joint estimate, in its sd",)


def output_of(done: JointIdentification) -> Output:
    """Return all that is handed over."""
    return Output(
        "identify_runs", document(done), blocks(done), lambda: record_of(done), logged_of(done)
    )


def blocks(done: JointIdentification) -> Blocks:
    """Return the joint estimate and the two sentences that count, the runs, and their problems."""
    return (
        *estimate_tables(done.estimate),
        outcome_claim(done.estimate),
        verdict_claim(done.verdict),
        *unobservable_items(done.estimate),
        *tables_of(done),
        *problem_items(done),
    )


def problem_items(done: JointIdentification) -> Blocks:
    """Return from what problem of which recording an estimate suffers."""
    found = tuple(
        Item(f"{run.name}: {finding.sentence}", TONES[finding.kind])
        for run in done.runs
        for finding in run.findings
        if finding.kind in ("problem", "wrong")
    )
    return (Items(found),) if found else ()


def tables_of(done: JointIdentification) -> Blocks:
    """Return the runs, each by itself, and how they scatter."""
    scatter = done.joint.scatter
    spread = () if scatter is None or not scatter.spreads else (spread_table(scatter.spreads),)
    return (runs_table(done), *spread)


def runs_table(done: JointIdentification) -> Table:
    """Return each run by itself."""
    return tabulated(
        "Runs, each by itself",
        done.runs,
        (Column("run"), lambda run: run.name),
        *((number(name, "um"), partial(value_of, name)) for name in COM),
        (number("chi-square"), lambda run: deviation_of(run, "chi_square", 3)),
        (number("expected"), lambda run: deviation_of(run, "freedom", 2)),
        (number("probability"), lambda run: deviation_of(run, "probability", 2)),
        notes=BESIDE,
    )


def value_of(name: str, run: IdentifiedRun) -> str:
    """Return a value with its sd, if the run has it."""
    if not run.estimate.has(name):
        return ""
    _, value, sd, _, _ = cells(run.estimate.parameters[run.estimate.index(name)])
    return f"{value} ± {sd}"


def deviation_of(run: IdentifiedRun, what: str, digits: int) -> str:
    """Return a number of how much a run deviates; of one that is left out, that it is."""
    if run.deviation is None:
        return "" if run.used else "left out"
    return significant(getattr(run.deviation, what), digits)


def spread_table(spreads: tuple[Spread, ...]) -> Table:
    """Return how the runs scatter, and what they state."""
    return tabulated(
        "Scatter over the runs, centre of mass and inertia about P, masses at home",
        spreads,
        (Column(), lambda s: s.name),
        (number("runs"), lambda s: str(s.runs)),
        (number("mean"), lambda s: scaled(s, s.mean)),
        (number("sd between runs"), lambda s: scaled(s, s.sd_between)),
        (number("stated sd, rms"), lambda s: scaled(s, s.sd_stated)),
        (Column("unit"), lambda s: unit_for(s.name, s.unit).name),
    )


def scaled(spread: Spread, value: float) -> str:
    """Return a number in the unit of the bench, with the digits that the stated sd bears."""
    size = unit_for(spread.name, spread.unit).size
    _, sd = with_sd(spread.mean / size, spread.sd_stated / size)
    return fixed(value / size, len(sd.partition(".")[2]))


def document(done: JointIdentification) -> View:
    """Return the joint estimate, each run's, and the verdict on their scatter as JSON."""
    return IDENTIFY_RUNS.write(done)


def logged_of(done: JointIdentification) -> Logged:
    """Return what a logbook keeps beside the report."""
    estimate = done.estimate
    return Logged("identify", estimate.method, "recording", None, estimate, is_file=True)


def pictures(done: JointIdentification) -> Iterator[Picture]:
    """Yield Fig. 9 of the runs that the joint estimate is made of."""
    boxed = boxes_of(done)
    if boxed:
        yield Picture("figure09_runs", run_boxes.CAPTION, run_boxes.draw(boxed))


def boxes_of(done: JointIdentification) -> dict[str, run_boxes.Boxed]:
    """Return each parameter of the body that two runs show."""
    if done.joint.scatter is None:
        return {}
    stated = dict(zip(BODY, done.stated, strict=True))
    estimates, found = [run.estimate for run in done.used], done.estimate
    return {
        spread.name: run_boxes.Boxed(
            [e.values((spread.name,))[0] for e in estimates if e.sees((spread.name,))],
            spread.unit,
            found.parameters[found.index(spread.name)] if found.has(spread.name) else None,
            float(stated[spread.name]),
        )
        for spread in done.joint.scatter.spreads
    }


def record_of(done: JointIdentification) -> RunRecord:
    """Return the identification as a report."""
    return RunRecord(
        title="Mass properties from several recordings of one platform",
        requested={f"recording {k}": run.name for k, run in enumerate(done.runs, 1)},
        testbed=done.testbed,
        conclusion=(outcome_claim(done.estimate), verdict_claim(done.verdict)),
        sections=(
            *findings_sections(done),
            steps_section("Steps", done.steps, {}),
            Section("Runs", tables_of(done)),
            *estimate_sections(done.estimate, done.testbed),
        ),
        origin=origin(**{f"sha256 of {run.name}": run.recording.sha256 for run in done.runs}),
        figures=list(pictures(done)),
    )


def findings_sections(done: JointIdentification) -> Iterator[Section]:
    """Yield what each recording holds."""
    for run in done.runs:
        for section in findings_section(run.findings):
            yield Section(f"Content of {run.name}", section.blocks)
