"""Mass properties from parts and swings, for terminal, report and JSON, in g, um and kg m2."""

from collections.abc import Iterator

from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.text.blocks import Blocks, Column, Section, Table, number, tabulated
from equipoise.app.text.estimate_text import outcome_claim, parameter_table
from equipoise.app.text.json_results import INERTIA
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import significant, with_sd
from equipoise.model.mass_budget import MassBudget
from equipoise.model.testbed import Testbed
from equipoise.model.units import GRAM, PERCENT

SHARES = "Shares of the variances of the sum of parts, before any swing."


def output_of(found: MassBudget, testbed: Testbed | None) -> Output:
    """Return all that is handed over; a report shows the testbed that has this body."""

    def record() -> RunRecord:
        assert testbed is not None
        return record_of(found, testbed)

    return Output("inertia", document(found), blocks(found), record)


def document(found: MassBudget) -> View:
    """Return the numbers, SI."""
    return INERTIA.write(found)


def blocks(found: MassBudget) -> Blocks:
    """Return mass properties, parts, swings, and what it all rests on."""
    return (*tables(found), outcome_claim(found.estimate))


def tables(found: MassBudget) -> Iterator[Table]:
    """Yield mass properties about both points, then parts and swings."""
    title = f"{found.stated.name}: mass, centre of mass from P, inertia about P"
    yield parameter_table(title, found.estimate.parameters)
    yield parameter_table("Inertia about the centre of mass", found.central)
    yield parts_table(found)
    if found.checks:
        yield swings_table(found)


def percent(share: float) -> str:
    """Return a share, in percent."""
    return f"{share / PERCENT:.0f}"


def parts_table(found: MassBudget) -> Table:
    """Return what each part contributes, the most doubtful of the inertia first."""
    return tabulated(
        "Parts",
        found.shares,
        (Column("part"), lambda share: share.name),
        (number("mass", "g"), lambda share: significant(share.mass / GRAM, 4)),
        (number("of mass", "%"), lambda share: percent(share.of_mass)),
        (number("of com", "%"), lambda share: percent(share.of_com)),
        (number("of inertia", "%"), lambda share: percent(share.of_inertia)),
        notes=(SHARES,),
    )


def swings_table(found: MassBudget) -> Table:
    """Return what each swing measured beside what all of it says."""
    return tabulated(
        "Swings: moments of inertia about their axes, with weight and fixture",
        found.checks,
        (Column("swing"), lambda check: check.name),
        (number("measured", "kg m2"), lambda check: with_sd(check.measured, check.measured_sd)[0]),
        (number("sd", "kg m2"), lambda check: with_sd(check.measured, check.measured_sd)[1]),
        (number("combined", "kg m2"), lambda check: with_sd(check.expected, check.measured_sd)[0]),
        (number("difference", "sd"), lambda check: f"{check.off:.1f}"),
    )


def record_of(found: MassBudget, testbed: Testbed) -> RunRecord:
    """Return the budget as a report."""
    return RunRecord(
        title="Mass properties from parts and swings",
        requested={"parts": found.stated.source, "method": found.estimate.method},
        testbed=testbed,
        conclusion=(outcome_claim(found.estimate),),
        sections=(Section("Results", tuple(tables(found))),),
        origin=origin(),
    )
