"""The reproduction of Lee et al. for terminal, JSON and report."""

from collections.abc import Sequence

from equipoise.app.figures.papers.lee_catalogue import pictures_of
from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.text.blocks import (
    Blocks,
    Column,
    Paragraph,
    Section,
    Table,
    number,
    table,
)
from equipoise.app.text.json_lists import REPRODUCE_LEE
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import with_sd
from equipoise.app.views.study.paper_views import paper_table
from equipoise.maths.linalg import element_sizes
from equipoise.model.estimate import BODY, COM, INERTIA, Estimate
from equipoise.model.observability import Observability
from equipoise.model.testbed import Testbed
from equipoise.model.units import DEG, G_CM, PERCENT
from equipoise.study.papers.lee import (
    DAMPING,
    DURATION,
    FREQUENCY,
    INTEGRAL,
    Manoeuvre,
    formulations,
    singular_times,
    true_values,
    warns,
)
from equipoise.study.papers.lee_course import Courses, courses_of
from equipoise.study.papers.lee_rows import LeeRun

SHOWN = BODY
SENSORS = ("fine attitude", "the preset's own")
LEAST = (
    "Cramer-Rao bound: no unbiased method has a smaller sd. Fine attitude: 0.02 deg at 100 Hz "
    "beside the gyro of table 1, as simulated here; the preset's own sensors are those it assumes "
    "of a bench. Percent is of sqrt(J_ii J_jj), or of a component of m r."
)


def name_of(parameter: str) -> str:
    """Return an unknown as tables call it."""
    return f"m r {parameter[-1]}" if parameter in COM else f"J {parameter[-2:]}"


def factors(testbed: Testbed) -> dict[str, float]:
    """Return by what to multiply each unknown in SI to show it."""
    return dict.fromkeys(INERTIA, 1.0) | dict.fromkeys(COM, testbed.body.mass / G_CM)


def percents(testbed: Testbed) -> dict[str, float]:
    """Return one percent of sqrt(J_ii J_jj), or of the component of m r, SI."""
    truth = true_values(testbed)
    sizes = dict(zip(INERTIA, element_sizes(testbed.body.inertia_P), strict=True))
    sizes |= {name: abs(truth[name]) for name in COM}
    return {name: PERCENT * float(size) for name, size in sizes.items()}


def cell_of(estimate: Estimate, name: str, done: Manoeuvre) -> str:
    """Return value, sd and error of an unknown, as one text."""
    if not estimate.has(name):
        return ""
    found, factor = estimate.parameters[estimate.index(name)], factors(done.testbed)[name]
    value, sd = with_sd(found.value * factor, found.sd * factor)
    error = (found.value - true_values(done.testbed)[name]) / percents(done.testbed)[name]
    return f"{value} ({sd}) {error:+.2g}%"


def output_of(done: LeeRun) -> Output:
    """Return all that is handed over."""

    def record() -> RunRecord:
        courses = [courses_of(run.slew.recording, run.testbed) for run in done.slews]
        return record_of(done, courses)

    return Output("reproduce", document_of(done), blocks(done), record)


def blocks(done: LeeRun) -> Blocks:
    """Return the paper's findings, a table a slew, what each method says of itself, the bounds."""
    slews = (block for run in done.slews for block in slew_blocks(run))
    beside = paper_table("Lee et al. compared with this program", done.rows)
    return (beside, *slews, bound_table(done.slews))


def slew_blocks(done: Manoeuvre) -> Blocks:
    """Return what the methods found in one slew, and what each says of itself."""
    remarks = (
        Paragraph(f"{name}: {found.outcome.sentence}", "caution" if warns(found) else "plain")
        for name, found in done.estimates.items()
    )
    return (slew_table(done), *remarks)


def slew_table(done: Manoeuvre) -> Table:
    """Return what the methods found in one slew."""
    truth, factor = true_values(done.testbed), factors(done.testbed)
    lines = [
        [name_of(name), f"{truth[name] * factor[name]:g}"]
        + [cell_of(estimate, name, done) for estimate in done.estimates.values()]
        for name in SHOWN
    ]
    near = singular_times(done.slew)
    reported = (
        "no singularity" if near is None else f"singular from {near[0]:.1f} to {near[1]:.1f} s"
    )
    angles = ", ".join(f"{angle:g}" for angle in done.start)
    title = f"From ({angles}) deg, {reported}: value (sd) error; J in kg m2, m r in g cm"
    return table(title, (Column(), number("truth"), *map(number, done.estimates)), lines)


def bound_table(runs: Sequence[Manoeuvre]) -> Table:
    """Return the least sd that any method can reach, in percent."""
    heads = [f"{run.start[0]:g} deg, {sensors}" for run in runs for sensors in SENSORS]
    lines = list[list[str]]()
    for name in SHOWN:
        bounds = [bound for run in runs for bound in (run.bound, run.coarse_bound)]
        share = percents(runs[0].testbed)[name]
        lines.append([name_of(name), *(f"{least(b)[name] / share:.2g} %" for b in bounds)])
    columns = (Column(), *map(number, heads))
    return table("Cramer-Rao bounds", columns, lines, (LEAST,))


def least(bound: Observability) -> dict[str, float]:
    """Return the bounds of what is shown, SI."""
    return {name: float(bound.sd[bound.names.index(name)]) for name in SHOWN}


def document_of(done: LeeRun) -> View:
    """Return the reproduction as JSON, SI units."""
    loop = {"frequency_rad_s": FREQUENCY, "damping": DAMPING, "integral_rad_s": INTEGRAL}
    slews = [slew_of(run) for run in done.slews]
    return REPRODUCE_LEE.write(
        {"seed": done.seed, "rows": done.rows, "loop": loop, "manoeuvres": slews}
    )


def slew_of(run: Manoeuvre) -> View:
    """Return what the document says of one slew."""
    return {
        "start": [angle * DEG for angle in run.start],
        "singular": singular_times(run.slew),
        "truth": true_values(run.testbed),
        "estimates": run.estimates,
        "warns": {name: warns(found) for name, found in run.estimates.items()},
        "least_sd": least(run.bound),
        "least_sd_of_preset_sensors": least(run.coarse_bound),
    }


def record_of(done: LeeRun, courses: Sequence[Courses]) -> RunRecord:
    """Return the reproduction as a report; drawing its figures takes a while."""
    large, small = zip(done.slews, courses, strict=True)
    simulated = {
        "paper": "Lee et al., Mass Properties Estimation of a Satellite Simulator Based on the "
        "Integration Method, section V",
        "seed": str(done.seed),
        "each slew": f"{DURATION:g} s, PID of {FREQUENCY:g} rad/s, damping {DAMPING:g}, integral "
        f"{INTEGRAL:g} rad/s; singularity-robust steering",
    }
    return RunRecord(
        title="Lee et al.'s simulation reproduced",
        requested=simulated | formulations(),
        testbed=done.slews[0].testbed,
        conclusion=(),
        sections=(Section("Results", blocks(done)),),
        origin=origin(),
        figures=list(pictures_of(large, small)),
    )
