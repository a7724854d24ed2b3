"""The report of a run, as a document of blocks. It adds no number of its own."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from equipoise.app.figures.catalogue import Picture
from equipoise.app.report.run_record import RunRecord
from equipoise.app.text.blocks import (
    Block,
    Blocks,
    Column,
    Document,
    Figure,
    Heading,
    Pairs,
    Paragraph,
    Section,
    Table,
    number,
    paragraphs,
    tabulated,
)
from equipoise.app.text.charts import Chart, Drawn, Replay
from equipoise.app.text.estimate_text import estimate_tables, residual_line, unobservable_items
from equipoise.app.text.run_blocks import finding_items, moment_of, reason_items
from equipoise.app.text.testbed_comparison import beside_testbed
from equipoise.model.estimate import Estimate
from equipoise.model.finding import Finding
from equipoise.model.step import Step
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.model.units import DEG, GRAM, MM, UT

ALL_OBSERVED = "The data or a prior determine every quantity above."


def report(record: RunRecord) -> Document:
    """Return the document."""
    return Document(record.title, record.testbed.name, tuple(_sections(record)))


def _sections(record: RunRecord) -> Iterator[Section]:
    if record.conclusion:
        yield Section("", record.conclusion)
    yield Section("Request", (_pairs(record.requested),))
    yield Section("Platform", tuple(_platform(record.testbed)))
    yield from record.sections
    if record.figures or record.charts:
        yield Section("Figures", figure_blocks(record.figures, record.charts))
    yield Section("Provenance", (_pairs(record.origin),))


def findings_section(findings: Sequence[Finding]) -> tuple[Section, ...]:
    """Return what a recording holds; nothing where that is nothing."""
    return (Section("Content of the recording", finding_items(findings)),) if findings else ()


def steps_section(title: str, steps: Sequence[Step], figures: Mapping[Step, Picture]) -> Section:
    """Return each step, and its figure if it has one."""
    blocks: list[Block] = []
    for step in steps:
        blocks.append(moment_of(step))
        if step in figures:
            blocks.append(figure_of(figures[step]))
    return Section(title, tuple(blocks))


def figure_blocks(pictures: Sequence[Picture], charts: Sequence[Drawn]) -> Blocks:
    """Return replays, pictures in their order, each as its chart if it has one, other charts."""
    by_name = {chart.name: chart for chart in charts if isinstance(chart, Chart)}
    shown = {picture.name for picture in pictures}
    replays = (chart for chart in charts if isinstance(chart, Replay))
    return (
        *replays,
        *(_chart_or_figure(picture, by_name.get(picture.name)) for picture in pictures),
        *(chart for name, chart in by_name.items() if name not in shown),
    )


def _chart_or_figure(picture: Picture, chart: Chart | None) -> Block:
    """Return the chart with its picture as still form, else the picture."""
    return figure_of(picture) if chart is None else replace(chart, drawing=picture.caption)


def estimate_sections(
    estimate: Estimate | None, testbed: Testbed, *more: Block
) -> tuple[Section, ...]:
    """Return the mass properties beside the testbed's, what else is said, what is unobservable."""
    if estimate is None:
        return ()
    found: Blocks = (
        Paragraph(estimate.outcome.sentence),
        *(beside_testbed(shown, estimate, testbed) for shown in estimate_tables(estimate)),
        *paragraphs(residual_line(estimate.residual)),
        *more,
    )
    unobserved = unobservable_items(estimate) or (Paragraph(ALL_OBSERVED),)
    return Section("Mass properties", found), Section("What the data cannot show", unobserved)


def figure_of(picture: Picture) -> Figure:
    """Return where a picture stands, and its caption."""
    return Figure(picture.name, picture.caption)


def _platform(bed: Testbed) -> Iterator[Block]:
    yield _pairs(_platform_pairs(bed))
    if bed.masses:
        yield masses_table("", bed.masses)
    yield from reason_items(bed.mended)
    if bed.assumed:
        yield Heading("Assumed, not measured")
        yield _pairs(bed.assumed)


def masses_table(title: str, masses: Iterable[SlidingMass]) -> Table:
    """Return what is stated of sliding masses."""
    return tabulated(
        title,
        masses,
        (Column("sliding mass"), lambda mass: mass.name),
        (number("mass", "g"), lambda mass: f"{mass.mass / GRAM:.4g}"),
        (number("travel", "mm"),
         lambda mass: f"{mass.travel[0] / MM:g} to {mass.travel[1] / MM:g}"),
        (number("step", "mm"), lambda mass: f"{mass.resolution / MM:g}"),
        (number("accuracy (1 sd)", "mm"), lambda mass: f"{mass.accuracy / MM:g}"),
    )  # fmt: skip


def _platform_pairs(bed: Testbed) -> dict[str, str]:
    pairs = {"file": bed.source, "mass": f"{bed.body.mass:.5g} kg"}
    if bed.attitude is not None:
        noise = f"{bed.attitude.noise / DEG:.3g} deg (1 sd)"
        pairs["camera"] = f"{bed.attitude.rate:g} Hz, {noise}"
    if bed.gyro is not None:
        pairs["gyro"] = f"{bed.gyro.rate:g} Hz, {bed.gyro.noise / DEG:.3g} deg/s (1 sd)"
    if bed.accelerometer is not None:
        noise = f"{bed.accelerometer.noise:.3g} m/s2 (1 sd)"
        pairs["accelerometer"] = f"{bed.accelerometer.rate:g} Hz, {noise}"
    if bed.sun is not None:
        pairs["sun sensor"] = f"{bed.sun.rate:g} Hz, {bed.sun.noise:.3g} of a unit vector (1 sd)"
    if bed.magnetometer is not None:
        noise = f"{bed.magnetometer.noise / UT:.3g} uT (1 sd)"
        pairs["magnetometer"] = f"{bed.magnetometer.rate:g} Hz, {noise}"
    return pairs


def _pairs(pairs: Mapping[str, str]) -> Pairs:
    return Pairs(tuple(pairs.items()))
