"""A design for terminal, JSON and report."""

import math
from collections.abc import Sequence

import numpy as np

from equipoise.app.figures.design_catalogue import pictures_of
from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.text.blocks import (
    Block,
    Blocks,
    Claim,
    Column,
    Paragraph,
    Section,
    Table,
    items,
    number,
    paragraphs,
    table,
    tabulated,
)
from equipoise.app.text.json_results import DESIGN
from equipoise.app.text.json_shape import View
from equipoise.model.arrays import Floats, Matrix3
from equipoise.model.reasons.reason import Reason, distinct
from equipoise.model.units import DEG, GRAM, MM, PERCENT, UM, UN_M
from equipoise.planning.sizing.budget import Budget
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.environment import not_stated
from equipoise.planning.sizing.expected_torque import Line
from equipoise.planning.sizing.limits import plain, worth_listing
from equipoise.planning.sizing.mass_steps import MassStep
from equipoise.planning.sizing.reachable_set import Reach, furthest, tolerance, volume, weakest
from equipoise.planning.sizing.sizing import Sizing


def output_of(found: Sizing) -> Output:
    """Return all that is handed over."""
    return Output("design", document(found), blocks(found), lambda: record_of(found))


def blocks(found: Sizing) -> Blocks:
    """Return the tables, what was not counted, what is odd, and what it all comes to."""
    return (*tables_of(found), *remarks_of(found), outcome_claim(found))


def tables_of(found: Sizing) -> Blocks:
    """Return reach, steps, least sd, budget, and what to buy next."""
    return (
        reach_table(found),
        steps_table(found.steps, found.case.tilt),
        measurement_table(found.budgets, found.case.testbed.body.inertia_P),
        budget_table(found),
        better_table(found),
        *together_table(found),
    )


def remarks_of(found: Sizing) -> Blocks:
    """Return what was not counted, what is odd, how far masses reach, and what limits them."""
    missing = ", ".join(uncounted(found.case))
    uncounted_text = f"Not stated, and therefore neglected: {missing}."
    quiet: tuple[Block, ...] = (Paragraph(uncounted_text, "quiet"),) if missing else ()
    odd = (
        f"Records of {', '.join(f'{length:g}' for length in lengths)} s: {reason.sentence}"
        for reason, lengths in cautions(found)
    )
    return (
        *quiet,
        *items(odd, "caution"),
        *paragraphs(found.reached, found.limit),
    )


def outcome_claim(found: Sizing) -> Claim:
    """Return whether what is required can be met."""
    if found.required is None:
        return Claim(found.verdict.sentence)
    return Claim(found.verdict.sentence, "good" if found.verdict.passed else "bad")


def record_of(found: Sizing) -> RunRecord:
    """Return the design as a report."""
    case = found.case
    required = "" if found.required is None else f"{plain(found.required / UN_M)} uN m"
    requested = {
        "target": f"({', '.join(f'{x / UM:g}' for x in case.target)}) um",
        "range of tilts": f"{case.tilt / DEG:.3g} deg",
        "records": ", ".join(f"{budget.first.duration:g} s" for budget in found.budgets),
        "measurements and moves": str(case.moves),
    }
    return RunRecord(
        title="Capability of masses and sensors",
        requested=requested | ({"torque required": required} if required else {}),
        testbed=case.testbed,
        conclusion=(outcome_claim(found),),
        sections=(Section("Reach, resolution, bounds and torque budget", tables_of(found)),
                  Section("Assumptions and remarks", remarks_of(found))),
        origin=origin(),
        figures=pictures_of(found),
    )  # fmt: skip


def reach_table(found: Sizing) -> Table:
    """Return how far the centre of mass can be shifted, and how far it has to be."""
    bed = found.case.testbed
    needed = zip(found.case.target - bed.body.com, bed.com_sd, strict=True)
    wanted = (f"{plain(way / UM)} +/- {plain(sd / UM)}" for way, sd in needed)
    shown = ([plain(end / UM) for end in side] for side in ends(found.reach))
    rows = zip("xyz", *shown, wanted, strict=True)
    columns = (Column("along"), *(number(heading, "um") for heading in ("from", "to", "needed")))
    return table("Reach: shifts of the centre of mass from home", columns, rows)


def steps_table(steps: Sequence[MassStep], tilt: float) -> Table:
    """Return what each mass does with one step, and how truly it stops."""
    return tabulated(
        "Resolution: smallest effect of each mass",
        steps,
        (Column("mass"), lambda step: step.mass.name),
        (number("", "g"), lambda step: plain(step.mass.mass / GRAM)),
        (number("step", "mm"), lambda step: plain(step.mass.resolution / MM)),
        (number("step", "um"), lambda step: plain(step.shift / UM)),
        (number("step", "uN m"), lambda step: plain(step.torque / UN_M)),
        (number(f"rms within {tilt / DEG:.3g} deg", "uN m"),
         lambda step: plain(step.within_tilt / UN_M)),
        (number("stop sd", "um"), lambda step: plain(step.stop_sd / UM)),
    )  # fmt: skip


def measurement_table(budgets: Sequence[Budget], inertia_P: Matrix3) -> Table:
    """Return the least sd from records of several lengths, and the torque left after them."""
    moments = np.diag(inertia_P)
    return tabulated(
        "Cramer-Rao bounds of a free swing with one move, and of the last measurement",
        budgets,
        (Column("record"), lambda budget: f"{budget.first.duration:g} s"),
        (number("com first", "um"), lambda budget: triple(budget.first.com_sd / UM)),
        (number("inertia sd", "%"),
         lambda budget: triple(budget.first.inertia_sd[:3] / PERCENT / moments)),
        (number("com last", "um"), lambda budget: triple(budget.last.com_sd / UM)),
        (number("residual", "uN m"), lambda budget: plain(budget.torque / UN_M)),
    )  # fmt: skip


def triple(values: Floats) -> str:
    """Return three numbers with two digits."""
    return "  ".join(two_digits(v) for v in values)


def two_digits(value: float) -> str:
    """Return a number with two digits, unless it is unobservable or too small to matter."""
    if not math.isfinite(value):
        return "unobservable"
    return "<0.001" if value < 0.001 else f"{value:.2g}"


def budget_table(found: Sizing) -> Table:
    """Return the lines of the budget, the largest first."""
    budget = found.budget
    rows = [
        (
            line.cause,
            rms_text(line.moment),
            plain(line.torque / UN_M),
            share(line, budget),
            line.basis,
        )
        for line in budget.lines
    ]
    rows.append(("together", "", plain(budget.torque / UN_M), "", ""))
    columns = (Column(), number("x  y  z rms", "um"), number("rms", "uN m"),
               number("share of variance"), Column("from"))  # fmt: skip
    title = (
        f"Residual torque after {found.case.moves} measurements of "
        f"{found.case.measurement_time:g} s and as many moves, within "
        f"{found.case.tilt / DEG:.3g} deg of level"
    )
    return table(title, columns, rows)


def rms_text(moment: Matrix3 | None) -> str:
    """Return the root mean square of each component, um."""
    return "" if moment is None else triple(np.sqrt(np.diag(moment)) / UM)


def share(line: Line, budget: Budget) -> str:
    """Return the share of a line in the sum of all squares."""
    part = line.torque**2 / PERCENT / sum(other.torque**2 for other in budget.lines)
    return f"{part:.0f} %" if part >= 1 else "< 1 %"


def better_table(found: Sizing) -> Table:
    """Return what would be left if one thing were better."""
    shown = worth_listing(found.budget, found.better)
    rows = [(b.name, plain(b.torque / UN_M), f"{b.within / PERCENT:.3g} %") for b in shown] or [
        ("no single improvement changes it by 1 %", "", "")
    ]
    now = f"{plain(found.budget.torque / UN_M)} now"
    columns = (Column("improvement"), number(f"residual ({now})", "uN m"), number("within reach"))
    return table("Improvements, most effective first", columns, rows)


def together_table(found: Sizing) -> Blocks:
    """Return what changes leave that are made one after the other, where one is not enough."""
    rows = [(b.name, plain(b.torque / UN_M)) for b in found.together]
    columns = (Column("improvement"), number("residual then", "uN m"))
    return (table("Improvements together, in the order of what limits", columns, rows),) * bool(
        rows
    )


def uncounted(case: Case) -> tuple[str, ...]:
    """Return what nothing was stated of, and what therefore does not count."""
    rails = () if case.rail_lean > 0 else ("misalignment of the rails",)
    return (*rails, *not_stated(case.around))


def cautions(found: Sizing) -> list[tuple[Reason, list[float]]]:
    """Return what is odd about the records, each once, with their lengths (s)."""
    measurements = [
        measurement for budget in found.budgets for measurement in (budget.first, budget.last)
    ]
    reasons = distinct(reason for measurement in measurements for reason in measurement.cautions)
    return [
        (reason, list(dict.fromkeys(m.duration for m in measurements if reason in m.cautions)))
        for reason in reasons
    ]


def document(found: Sizing) -> View:
    """Return a design as JSON, SI units."""
    return DESIGN.write({
        "found": found,
        "reach": reach_of_masses(found),
        "not_stated": uncounted(found.case),
        "cautions": [{"reason": reason, "records_s": s} for reason, s in cautions(found)],
    })  # fmt: skip


def reach_of_masses(found: Sizing) -> View:
    """Return what the masses can reach."""
    low, high = ends(found.reach)
    return {
        "found": found,
        "low_m": low,
        "high_m": high,
        "tolerance_m": tolerance(found.reach),
        "weakest_direction": weakest(found.reach),
        "volume_m3": volume(found.reach),
    }


def ends(reach: Reach) -> tuple[list[float], list[float]]:
    """Return the shifts farthest against and along each axis, m."""
    axes = np.eye(3)
    low = [-furthest(reach, -axis) + 0.0 for axis in axes]
    return low, [furthest(reach, axis) for axis in axes]
