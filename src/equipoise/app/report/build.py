"""The report of a run, as a page of blocks. It adds no number of its own."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from equipoise.app.console.rich_results import cells, groups, noise_floor_line, residual_line
from equipoise.app.figures.catalogue import Picture
from equipoise.app.report.run_record import Account
from equipoise.app.text.before_after import HEADS, rows
from equipoise.app.text.blocks import (
    Block,
    Claim,
    Drawn,
    Grid,
    Heading,
    Items,
    Moment,
    Page,
    Pairs,
    Paragraph,
    Section,
)
from equipoise.app.text.numbers import fixed
from equipoise.app.text.units import GRAM, MM, PER_DEG
from equipoise.model.estimate import Estimate
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed

ALL_OBSERVED = "Every quantity above was seen in the data or given beforehand."


def report(account: Account) -> Page:
    """Return the page."""
    sections = (section for part in SECTIONS for section in part(account))
    return Page(account.title, account.testbed.name, tuple(sections))


def _verdict(account: Account) -> Iterator[Section]:
    if account.verdict is not None:
        claim = Claim(account.verdict.sentence, account.verdict.passed)
        floor = noise_floor_line(account.verdict)
        yield Section("", (claim, Paragraph(floor)) if floor else (claim,))
    elif account.estimate is not None:
        outcome = account.estimate.outcome
        yield Section("", (Claim(outcome.sentence, outcome.usable),))


def _change(account: Account) -> Iterator[Section]:
    if account.change is None:
        return
    lines = [list(row) for row in rows(account.change)]
    last = len(HEADS) if any(line[-1] for line in lines) else len(HEADS) - 2
    yield Section("Before and after", (_grid(HEADS[:last], (line[:last] for line in lines)),))


def _requested(account: Account) -> Iterator[Section]:
    yield Section("What was asked", (_pairs(account.requested),))


def _platform(account: Account) -> Iterator[Section]:
    bed = account.testbed
    masses = [
        [
            mass.name,
            f"{mass.mass * GRAM:.4g}",
            f"{mass.travel[0] * MM:g} to {mass.travel[1] * MM:g}",
            f"{mass.resolution * MM:g}",
            f"{mass.accuracy * MM:g}",
        ]
        for mass in bed.masses
    ]
    heads = ("sliding mass", "g", "travel, mm", "step, mm", "accuracy (1 sd), mm")
    blocks: list[Block] = [_pairs(_platform_pairs(bed))]
    if masses:
        blocks.append(_grid(heads, masses))
    if bed.assumed:
        blocks += [Heading("Assumed, not measured"), _pairs(bed.assumed)]
    yield Section("Platform", tuple(blocks))


def _platform_pairs(bed: Testbed) -> dict[str, str]:
    pairs = {"file": bed.source, "mass": f"{bed.body.mass:.5g} kg"}
    if bed.attitude is not None:
        noise = f"{bed.attitude.noise * PER_DEG:.3g} deg (1 sd)"
        pairs["camera"] = f"{bed.attitude.rate:g} Hz, {noise}"
    if bed.gyro is not None:
        pairs["gyro"] = f"{bed.gyro.rate:g} Hz, {bed.gyro.noise * PER_DEG:.3g} deg/s (1 sd)"
    return pairs


def _findings(account: Account) -> Iterator[Section]:
    if account.findings:
        lines = ((f.kind, f.sentence) for f in account.findings)
        yield Section("What the recording holds", (_grid(("", ""), lines, (1,)),))


def _steps(account: Account) -> Iterator[Section]:
    for title, steps in account.chapters.items():
        yield Section(title, tuple(_reported(steps, account.step_pictures)))


def _reported(steps: Sequence[Step], pictures: Mapping[Step, Picture]) -> Iterator[Block]:
    """Yield each step, and its figure if it has one."""
    for step in steps:
        yield Moment(f"{fixed(step.time, 1)} s", step.kind, step.sentence)
        if step in pictures:
            yield _drawn(pictures[step])


def _sheets(account: Account) -> Iterator[Section]:
    for sheet in account.sheets:
        table = _grid(sheet.heads, sheet.lines, sheet.words[1:])
        yield Section(sheet.title, (table, *map(Paragraph, sheet.remarks)))


def _mass_properties(account: Account) -> Iterator[Section]:
    estimate = account.estimate
    if estimate is None:
        return
    heads = ("", "value", "sd", "95 % interval", "unit")
    blocks: list[Block] = [Paragraph(estimate.outcome.sentence)]
    for title, group in groups(estimate):
        if group:
            blocks += [Heading(title), _grid(heads, map(cells, group))]
    if estimate.residual is not None:
        blocks.append(Paragraph(residual_line(estimate.residual)))
    yield Section("Mass properties", tuple(blocks))


def _unseen(account: Account) -> Iterator[Section]:
    if account.estimate is not None:
        yield Section("What the data cannot see", (_unseen_block(account.estimate),))


def _unseen_block(estimate: Estimate) -> Block:
    return Items(tuple(estimate.unobservable)) if estimate.unobservable else Paragraph(ALL_OBSERVED)


def _figures(account: Account) -> Iterator[Section]:
    if account.pictures:
        yield Section("Figures", tuple(map(_drawn, account.pictures)))


def _origin(account: Account) -> Iterator[Section]:
    yield Section("Where this comes from", (_pairs(account.origin),))


SECTIONS = (
    _verdict,
    _change,
    _requested,
    _platform,
    _findings,
    _steps,
    _sheets,
    _mass_properties,
    _unseen,
    _figures,
    _origin,
)


def _drawn(picture: Picture) -> Drawn:
    return Drawn(picture.name, picture.caption)


def _pairs(pairs: Mapping[str, str]) -> Pairs:
    return Pairs(tuple(pairs.items()))


def _grid(heads: Sequence[str], lines: Iterable[Sequence[str]], words: Sequence[int] = ()) -> Grid:
    return Grid(tuple(heads), tuple(map(tuple, lines)), tuple(words))
