"""A design for terminal and JSON."""

import math
from collections.abc import Sequence

import numpy as np
from rich.console import Group

from equipoise.app.console.rich_tables import quiet_table, titled
from equipoise.app.console.terminal import stdout
from equipoise.app.text.json_document import View, numbers
from equipoise.app.text.units import GRAM, MICRO, MM, PER_DEG, UM
from equipoise.model.arrays import Floats, Matrix3
from equipoise.planning.sizing.budget import Budget
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.contribution import Line
from equipoise.planning.sizing.environment import not_stated
from equipoise.planning.sizing.limits import plain, worth_listing
from equipoise.planning.sizing.mass_steps import MassStep
from equipoise.planning.sizing.measurement_bound import MeasurementBound
from equipoise.planning.sizing.reachable_set import furthest, tolerance, volume, weakest
from equipoise.planning.sizing.sensitivity import Bettered
from equipoise.planning.sizing.sizing import Sizing

SCHEMA = "equipoise/design/1"
AXES = ("x", "y", "z")
PERCENT = 100.0


def grid(title: str, heads: Sequence[str], rows: Sequence[Sequence[str]], left: int = 1) -> Group:
    """Return a table; the first ``left`` columns are names, the others numbers."""
    table = quiet_table()
    for k, head in enumerate(heads):
        style = "bold" if k == 0 else ""
        table.add_column(head, justify="left" if k < left else "right", style=style)
    for row in rows:
        table.add_row(*row)
    return titled(title, table)


def reach_table(found: Sizing) -> Group:
    """Return how far the centre of mass can be shifted, and how far it has to be."""
    bed, reach = found.case.testbed, found.reach
    rows: list[tuple[str, ...]] = []
    for k, axis in enumerate(np.eye(3)):
        needed, sd = found.case.target[k] - bed.body.com[k], bed.com_sd[k]
        ends = [-furthest(reach, -axis) + 0.0, furthest(reach, axis)]
        wanted = f"{plain(needed * UM)} +/- {plain(sd * UM)}"
        rows.append((AXES[k], *(plain(end * UM) for end in ends), wanted))
    heads = ("along", "from, um", "to, um", "needed, um")
    return grid("Shifts of the centre of mass that the masses can make from home", heads, rows)


def steps_table(steps: Sequence[MassStep], tilt: float) -> Group:
    """Return what each mass does with one step, and how truly it stops."""
    rows = [
        (
            step.mass.name,
            plain(step.mass.mass * GRAM),
            plain(step.mass.resolution * MM),
            plain(step.shift * UM),
            plain(step.torque * MICRO),
            plain(step.within_tilt * MICRO),
            plain(step.stop_sd * UM),
        )
        for step in steps
    ]
    within = f"rms within {tilt * PER_DEG:.3g} deg"
    heads = ("mass", "g", "step, mm", "step, um", "step, uN m", within, "stop's sd, um")
    return grid("The least that each mass can do", heads, rows)


def measurement_table(budgets: Sequence[Budget], inertia_P: Matrix3) -> Group:
    """Return what records of several lengths tell, and what is left after them."""
    moments = np.diag(inertia_P)
    rows = [
        (
            f"{budget.first.duration:g} s",
            triple(budget.first.com_sd * UM),
            triple(PERCENT * budget.first.inertia_sd[:3] / moments),
            triple(budget.last.com_sd * UM),
            plain(budget.torque * MICRO),
        )
        for budget in budgets
    ]
    heads = ("record", "com first, um", "J first, %", "com last, um", "left, uN m")
    return grid("Least sd of a free swing with one move, and of the last look", heads, rows)


def triple(values: Floats) -> str:
    """Return three numbers with two digits."""
    return "  ".join(two_digits(v) for v in values)


def two_digits(value: float) -> str:
    """Return a number with two digits, if it is not too small to matter or not seen."""
    if not math.isfinite(value):
        return "not seen"
    return "<0.001" if value < 0.001 else f"{value:.2g}"


def budget_table(found: Sizing) -> Group:
    """Return the lines of the budget, the largest first."""
    budget = found.budget
    rows = [(*line_cells(line), share(line, budget), line.basis) for line in budget.lines]
    rows.append(("together", "", plain(budget.torque * MICRO), "", ""))
    heads = ("", "x  y  z, um rms", "uN m rms", "of squares", "from")
    title = (
        f"What is left after {found.case.moves} measurements of "
        f"{found.case.measurement_time:g} s and as many "
        f"moves, within {found.case.tilt * PER_DEG:.3g} deg of level"
    )
    return grid(title, heads, rows)


def line_cells(line: Line) -> tuple[str, str, str]:
    """Return cause, offset and torque."""
    offset = "" if line.moment is None else triple(rms(line.moment) * UM)
    return line.cause, offset, plain(line.torque * MICRO)


def rms(moment: Matrix3) -> Floats:
    """Return the root mean square of each component, m."""
    return np.sqrt(np.diag(moment))


def share(line: Line, budget: Budget) -> str:
    """Return the share of a line in the sum of all squares."""
    part = PERCENT * line.torque**2 / sum(other.torque**2 for other in budget.lines)
    return f"{part:.0f} %" if part >= 1 else "< 1 %"


def better_table(found: Sizing) -> Group:
    """Return what would be left if one thing were better."""
    shown = worth_listing(found.budget, found.better)
    rows = [(b.name, plain(b.torque * MICRO), f"{PERCENT * b.within:.3g} %") for b in shown] or [
        ("nothing that is one step better changes it by 1 %", "", "")
    ]
    now = f"{plain(found.budget.torque * MICRO)} now"
    heads = ("one thing better", f"left, uN m ({now})", "within reach")
    return grid("What to buy next, the best first", heads, rows)


def show_design(found: Sizing) -> None:
    """Print all of a design."""
    console = stdout()
    for table in (
        reach_table(found),
        steps_table(found.steps, found.case.tilt),
        measurement_table(found.budgets, found.case.testbed.body.inertia_P),
        budget_table(found),
        better_table(found),
    ):
        console.print(table)
        console.print()
    missing = uncounted(found.case)
    if missing:
        text = f"Not stated, and not counted: {', '.join(missing)}."
        console.print(text, markup=False, style="dim")
    for caution in cautions(found):
        console.print(f"! {caution}", style="yellow", markup=False)
    console.print(found.reached, markup=False)
    console.print(found.limit, markup=False)
    console.print(found.outcome.sentence, markup=False, style="bold")


def uncounted(case: Case) -> tuple[str, ...]:
    """Return what nothing was stated of, and what therefore does not count."""
    rails = () if case.rail_lean > 0 else ("lean of the rails",)
    return (*rails, *not_stated(case.around))


def cautions(found: Sizing) -> list[str]:
    """Return what is odd about the looks, each once, with their lengths."""
    reported: dict[str, list[str]] = {}
    for budget in found.budgets:
        for measurement in (budget.first, budget.last):
            for caution in measurement.cautions:
                lengths = reported.setdefault(caution, [])
                if f"{measurement.duration:g}" not in lengths:
                    lengths.append(f"{measurement.duration:g}")
    return [f"Records of {', '.join(lengths)} s: {text}" for text, lengths in reported.items()]


def design_json(found: Sizing) -> View:
    """Return a design, schema equipoise/design/1, SI."""
    case = found.case
    return {
        "schema": SCHEMA,
        "testbed": case.testbed.name,
        "source": case.testbed.source,
        "target_m": numbers(case.target),
        "tilt_rad": case.tilt,
        "moves": case.moves,
        "reach": reach_json(found),
        "masses": [step_json(step) for step in found.steps],
        "measurements": [budget_json(budget) for budget in found.budgets],
        "budget": [line_json(line) for line in found.budget.lines],
        "better": [bettered_json(b) for b in found.better],
        "limit": found.limit,
        "not_stated": list(uncounted(case)),
        "cautions": cautions(found),
        "outcome": {"met": found.outcome.usable, "sentence": found.outcome.sentence},
    }


def reach_json(found: Sizing) -> View:
    """Return what the masses can reach; facets are normal.shift <= height."""
    reach, axes = found.reach, np.eye(3)
    return {
        "rank": reach.rank,
        "low_m": [-furthest(reach, -axis) + 0.0 for axis in axes],
        "high_m": [furthest(reach, axis) for axis in axes],
        "tolerance_m": tolerance(reach),
        "weakest_direction": numbers(weakest(reach)),
        "volume_m3": volume(reach),
        "facet_normals": numbers(reach.normals),
        "facet_heights_m": numbers(reach.heights),
        "share_within": found.budget.within,
        "sentence": found.reached,
    }


def step_json(step: MassStep) -> View:
    """Return the least step of a mass."""
    return {
        "name": step.mass.name,
        "mass_kg": step.mass.mass,
        "step_m": step.mass.resolution,
        "com_step_m": step.shift,
        "torque_N_m": step.torque,
        "torque_within_tilt_N_m": step.within_tilt,
        "com_stop_sd_m": step.stop_sd,
    }


def budget_json(budget: Budget) -> View:
    """Return what a length of record comes to."""
    return {
        "record_s": budget.first.duration,
        "first": measurement_json(budget.first),
        "last": measurement_json(budget.last),
        "torque_N_m": budget.torque,
    }


def measurement_json(measurement: MeasurementBound) -> View:
    """Return what a look tells."""
    return {
        "com_sd_m": numbers(measurement.com_sd),
        "com_covariance_m2": numbers(measurement.com),
        "inertia_P_sd_kg_m2": numbers(measurement.inertia_sd),
        "peak_tilt_rad": measurement.peak_tilt,
    }


def line_json(line: Line) -> View:
    """Return a line of the budget."""
    moment = None if line.moment is None else numbers(line.moment)
    return {
        "name": line.name,
        "cause": line.cause,
        "torque_N_m": line.torque,
        "com_moment_m2": moment,
        "basis": line.basis,
    }


def bettered_json(better: Bettered) -> View:
    """Return what would be left with one thing better."""
    return {
        "change": better.name,
        "torque_N_m": better.torque,
        "share_within": better.within,
    }
