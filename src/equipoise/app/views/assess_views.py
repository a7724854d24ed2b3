"""An assessment for terminal, JSON and report."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.console.rich_results import residual_line, step_line
from equipoise.app.console.rich_tables import show_sheet
from equipoise.app.console.terminal import stdout
from equipoise.app.figures.balancing import com_over_hours, residual_torque, torque_in_range
from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.recording import swing_spectrum
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.run_record import Account, origin
from equipoise.app.runs.assessment import AssessedPlatform
from equipoise.app.text.numbers import significant, with_sd
from equipoise.app.text.sheet import Sheet
from equipoise.app.text.units import MICRO, UM
from equipoise.app.views.identify_views import show_findings
from equipoise.assessment.metrics.allan import FEWEST
from equipoise.assessment.metrics.swing_height import Hanging
from equipoise.maths.gaussian_length import Bounded
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.estimate import COM
from equipoise.procedure.identification.assess import Assessment
from equipoise.procedure.identification.drift_metrics import OverHours
from equipoise.procedure.identification.record_courses import RecordCourses

MODES = {0: "slow swing", 1: "quick swing", None: "both swings, as one"}
PERCENT = 100.0
Row = tuple[str, str, str, str, str, str]


def sheets_of(done: Assessment) -> list[Sheet]:
    """Return the tables of an assessment; where its fit cannot be used, of what was felt alone."""
    usable = [range_sheet(done), metrics_sheet(done)] if done.estimate.outcome.usable else []
    return [*usable, residual_torque_sheet(done)]


def range_sheet(done: Assessment) -> Sheet:
    """Return what counts: torque within the range, distance from the target."""
    torque, tilt = done.torque, np.degrees(done.torque.tilt)
    lines = [
        [f"torque within {tilt:g} deg, rms", *bounds(torque.rms, MICRO), "uN m"],
        [
            f"torque within {tilt:g} deg, greatest",
            significant(torque.worst * MICRO),
            f"up to {significant(torque.worst_high * MICRO)}",
            "",
            "uN m",
        ],
        ["centre of mass from its target", *bounds(done.offset, UM), "um"],
    ]
    remark = (
        f"The inertia is known to {PERCENT * done.inertia_sd:.2g} %, and all of this goes with it. "
        "Floor: what a perfect platform could be proven to in this recording."
    )
    heads = ("", "found", "95 % bounds", "floor", "unit")
    return Sheet("What gravity does to the platform as it stands", heads, lines, (remark,))


def bounds(found: Bounded, factor: float) -> tuple[str, str, str]:
    """Return value, bounds and floor as texts."""
    value, low, high, floor = (significant(x * factor) for x in found)
    return value, f"{low} to {high}", floor


def metrics_sheet(done: Assessment) -> Sheet:
    """Return the centre of mass as the fit and the simple looks have it."""
    lines = [list(row) for row in metric_rows(done)]
    metrics = done.metrics
    remarks = [
        "All at the inertia that the fit found. Off: from the fit, in sd of the difference.",
        f"The looks see {metrics.duration:.3g} s of swing since the masses stopped"
        + (f"; no period: {metrics.quiet}." if metrics.quiet else "."),
    ]
    for fit in (metrics.torque_fit, metrics.energy_fit):
        if fit is not None and not fit.outcome.usable:
            remarks.append(f"{fit.method}: {fit.outcome.sentence}")
    heads = ("", "com x, um", "y", "z", "distance from P, um", "off")
    return Sheet("Centre of mass, as the masses stand, by several looks", heads, lines, remarks)


def metric_rows(done: Assessment) -> Iterator[Row]:
    """Yield a row a look."""
    yield ("trajectory fit", *components(done.com, done.com_unscaled),
           length_text(*distance(done.com, done.com_unscaled)), "")  # fmt: skip
    metrics = done.metrics
    named = ((f"torque, slopes over {metrics.window:.3g} s", metrics.torque_fit),
             ("energy", metrics.energy_fit))  # fmt: skip
    for name, fit in named:
        if fit is not None and fit.outcome.usable:
            com, covariance = fit.com, fit.covariance_of(COM)
            off = (com - done.com) / np.sqrt(np.diag(covariance + done.com_unscaled))
            yield (name, *components(com, covariance), length_text(*distance(com, covariance)),
                   f"{np.abs(off).max():.1f}")  # fmt: skip
    for hanging in metrics.hanging:
        yield period_row(done, hanging)


def period_row(done: Assessment, hanging: Hanging) -> Row:
    """Return the row of a swing."""
    period, sd = 1 / hanging.swing.frequency, hanging.swing.sd / hanging.swing.frequency**2
    value, spread = hanging.moment / done.weight, hanging.sd / done.weight
    fit, fit_sd = distance(done.com, done.com_unscaled)
    name = f"{MODES[hanging.mode]}, {' +/- '.join(with_sd(period, sd))} s"
    off = abs(value - fit) / float(np.hypot(spread, fit_sd))
    return name, "", "", "", length_text(value, spread), f"{off:.1f}"


def distance(com: Vector3, covariance: Matrix3) -> tuple[float, float]:
    """Return the distance from P (m) and its sd."""
    size = float(np.linalg.norm(com))
    way: Vector3 = com / max(size, 1e-12)
    return size, float(np.sqrt(way @ covariance @ way))


def components(com: Vector3, covariance: Matrix3) -> tuple[str, str, str]:
    """Return x, y, z with their sd, um."""
    sd: Floats = np.sqrt(np.diag(covariance))
    x, y, z = (length_text(float(c), float(s)) for c, s in zip(com, sd, strict=True))
    return x, y, z


def length_text(value: float, sd: float) -> str:
    """Return a length in um with its sd."""
    return " ± ".join(with_sd(value * UM, sd * UM))


def residual_torque_sheet(done: Assessment) -> Sheet:
    """Return what was felt along the record, with the noise of feeling it."""
    lines = list[list[str]]()
    metrics = done.metrics
    response = (("torque felt", metrics.torque, "uN m"), ("energy of motion", metrics.energy, "uJ"))
    for name, observed, unit in response:
        if observed is not None:
            value, sd = with_sd(observed.rms * MICRO, observed.rms_sd * MICRO)
            lines.append([name, f"{value} ± {sd}", significant(observed.greatest * MICRO),
                          significant(observed.noise * MICRO, 2), unit])  # fmt: skip
    heads = ("", "rms, noise taken off", "greatest", "noise", "unit")
    indices = [
        f"{fit.method} {fit.residual.error_index:.2g}"
        for fit in (metrics.torque_fit, metrics.energy_fit)
        if fit is not None and fit.residual is not None and fit.residual.error_index is not None
    ]
    remarks = [f"Error indices (EI): {', '.join(indices)}."] if indices else []
    if done.estimate.residual is not None:
        remarks.append(residual_line(done.estimate.residual))
    return Sheet("Along the record: all torques together, and energy", heads, lines, remarks)


def show_result(reported: AssessedPlatform) -> None:
    """Print what the recording holds, steps, tables and the verdict."""
    console, done, steps = stdout(), reported.done, reported.steps
    verdict = steps[-1].verdict
    show_findings(reported.findings)
    console.print()
    for step in steps[:-1]:
        console.print(step_line(step))
    for sheet in sheets_of(done):
        show_sheet(sheet)
    if reported.before is not None:
        show_sheet(change_sheet(reported.before, done))
    if reported.hours is not None:
        show_sheet(hours_sheet(reported.hours))
    console.print()
    for sentence in done.estimate.unobservable:
        console.print(f"! {sentence}", style="yellow", markup=False)
    style = "" if verdict is None else "bold green" if verdict.passed else "bold red"
    if verdict is not None and not verdict.sure:
        style = "bold yellow"
    console.print(steps[-1].sentence, style=style, markup=False)


def change_sheet(before: Assessment, after: Assessment) -> Sheet:
    """Return two recordings side by side."""
    tilt = np.degrees(after.torque.tilt)
    rows = (
        (f"torque within {tilt:g} deg, rms, uN m", before.torque.rms, after.torque.rms, MICRO),
        ("centre of mass from its target, um", before.offset, after.offset, UM),
    )
    lines = [
        [name, *(" (".join(bounds(each, factor)[:2]) + ")" for each in (old, new)), fall(old, new)]
        for name, old, new, factor in rows
    ]
    heads = ("", "before (95 %)", "after (95 %)", "")
    return Sheet("Before and after", heads, lines)


def hours_sheet(hours: OverHours) -> Sheet:
    """Return drift, walk and Allan deviation of looks along a recording."""
    title, wander = f"The centre of mass over time, by {len(hours.t)} looks", hours.wander
    left_out = f"{hours.left_out} looks could not be used."
    if wander is None:
        few = f"{len(hours.t)} looks are too few: drift and Allan deviation need {FEWEST}."
        return Sheet(title, ("",), (), (few, left_out) if hours.left_out else (few,))
    per_minute, root = 60 * UM, 60**0.5 * UM
    lines = [
        ["drift, um/min", *(" ± ".join(with_sd(float(d) * per_minute, float(s) * per_minute))
                            for d, s in zip(wander.drift, wander.drift_sd, strict=True)), ""],
        ["walk, um/sqrt(min)", *(significant(float(c) * root, 2) for c in wander.walk), ""],
    ]  # fmt: skip
    for span, deviation, alone, error in zip(
        wander.span, wander.deviation, wander.measurements_alone, wander.error, strict=True
    ):
        reported = (f"{d * UM:.2g} ({a * UM:.2g})" for d, a in zip(deviation, alone, strict=True))
        lines.append([f"Allan deviation, {span:.4g} s, um", *reported, f"{PERCENT * error:.0f} %"])
    remarks = ["In brackets: what looks that only err would leave. Last: relative sd."]
    remarks += [left_out] if hours.left_out else []
    return Sheet(title, ("", "x", "y", "z", ""), lines, remarks)


def fall(before: Bounded, after: Bounded) -> str:
    """Say by how much a value fell or rose, as far as both bounds tell."""
    if after.high < before.low:
        least, most = before.low / after.high, before.high / max(after.low, 1e-300)
        return f"fell {least:.3g} times at least" + (f", {most:.3g} at most" if after.low else "")
    if after.low > before.high:
        return f"rose {after.low / before.high:.3g} times at least"
    return "no change that the recordings show"


def account_of(reported: AssessedPlatform, courses: RecordCourses) -> Account:
    """Return the assessment as a report."""
    done, before, options = reported.done, reported.before, reported.done.options
    requested = {
        "recording": done.recording.source,
        "target": f"({', '.join(f'{UM * x:g}' for x in options.target)}) um",
        "range of tilts": f"{np.degrees(options.tilt):g} deg",
    }
    if before is not None:
        requested["before"] = before.recording.source
    requested |= {f"required {n}": each.sentence for n, each in enumerate(done.judged, 1)}
    more = [] if before is None else [change_sheet(before, done)]
    more += [] if reported.hours is None else [hours_sheet(reported.hours)]
    return Account(
        title="Assessment",
        requested=requested,
        testbed=done.testbed,
        chapters={"Steps": reported.steps},
        step_pictures=pictures_of_steps(reported.steps, Frame(done.testbed, motions=courses.steps)),
        origin=origin(sha256=done.recording.sha256),
        findings=reported.findings,
        estimate=done.estimate,
        verdict=reported.steps[-1].verdict,
        pictures=list(pictures_of(reported)),
        sheets=(*sheets_of(done), *more),
    )


def pictures_of(reported: AssessedPlatform) -> Iterator[Picture]:
    """Yield the figures."""
    done, hours = reported.done, reported.hours
    if done.estimate.outcome.usable:
        yield Picture("torque_in_range", torque_in_range.CAPTION, torque_in_range.draw(done))
    if done.metrics.torque is not None:
        yield Picture(
            "residual_torque", residual_torque.CAPTION, residual_torque.draw(done.metrics.torque)
        )
    if done.metrics.spectrum is not None:
        yield Picture("swing_spectrum", swing_spectrum.CAPTION, swing_spectrum.draw(done))
    if hours is not None and hours.wander is not None:
        drawn = com_over_hours.draw(hours, hours.wander)
        yield Picture("com_over_hours", com_over_hours.CAPTION, drawn)
