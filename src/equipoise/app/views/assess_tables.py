"""The tables of an assessment."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.text.blocks import Column, Table, number, table
from equipoise.app.text.estimate_text import residual_line
from equipoise.app.text.numbers import significant, with_sd
from equipoise.assessment.metrics.allan import FEWEST
from equipoise.assessment.metrics.swing_height import Hanging
from equipoise.maths.gaussian_length import Bounded
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.estimate import COM
from equipoise.model.units import MINUTE, PERCENT, UM, UN_M
from equipoise.procedure.identification.assess import Assessment
from equipoise.procedure.identification.drift_metrics import OverHours

MODES = {0: "slow swing", 1: "quick swing", None: "both swings, as one"}
Row = tuple[str, str, str, str, str, str]


def range_table(done: Assessment) -> Table:
    """Return what counts: torque within the range, distance from the target."""
    torque, tilt = done.torque, np.degrees(done.torque.tilt)
    lines = [
        [f"torque within {tilt:g} deg, rms", *bounds(torque.rms, UN_M), "uN m"],
        [
            f"torque within {tilt:g} deg, greatest",
            significant(torque.worst / UN_M),
            f"up to {significant(torque.worst_high / UN_M)}",
            "",
            "uN m",
        ],
        ["centre of mass from its target", *bounds(done.offset, UM), "um"],
    ]
    remark = (
        f"The inertia is known to {done.inertia_sd / PERCENT:.2g} %, and all of this goes with it. "
        "Floor: what a perfect platform could be proven to in this recording."
    )
    columns = (Column(), *map(number, ("found", "95 % bounds", "floor")), Column("unit"))
    return table("What gravity does to the platform as it stands", columns, lines, (remark,))


def bounds(found: Bounded, unit: float) -> tuple[str, str, str]:
    """Return value, bounds and floor as texts."""
    value, low, high, floor = (significant(x / unit) for x in found)
    return value, f"{low} to {high}", floor


def measurements_table(done: Assessment) -> Table:
    """Return the centre of mass by the fit and by simpler methods."""
    lines = [list(row) for row in metric_rows(done)]
    metrics = done.metrics
    remarks = [
        "All at the inertia that the fit found. Off: from the fit, in sd of the difference.",
        f"The others use {metrics.duration:.3g} s of swing since the masses stopped"
        + (f"; no period: {metrics.quiet}." if metrics.quiet else "."),
    ]
    for fit in (metrics.torque_fit, metrics.energy_fit):
        if fit is not None and not fit.outcome.usable:
            remarks.append(f"{fit.method}: {fit.outcome.sentence}")
    columns = (Column(), number("com x", "um"), number("y"), number("z"),
               number("distance from P", "um"), number("off"))  # fmt: skip
    title = "Centre of mass, as the masses stand, by several methods"
    return table(title, columns, lines, remarks)


def metric_rows(done: Assessment) -> Iterator[Row]:
    """Yield a row a method."""
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
    value, spread = hanging.moment / done.testbed.weight, hanging.sd / done.testbed.weight
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
    return " ± ".join(with_sd(value / UM, sd / UM))


def torque_table(done: Assessment) -> Table:
    """Return torque and energy along the record, with their noise."""
    lines = list[list[str]]()
    metrics = done.metrics
    series = (
        ("residual torque", metrics.torque, "uN m"),
        ("energy of motion", metrics.energy, "uJ"),
    )
    for name, observed, unit in series:
        if observed is not None:
            value, sd = with_sd(observed.rms / UN_M, observed.rms_sd / UN_M)
            lines.append([name, f"{value} ± {sd}", significant(observed.greatest / UN_M),
                          significant(observed.noise / UN_M, 2), unit])  # fmt: skip
    columns = (Column(), *map(number, ("rms, noise taken off", "greatest", "noise")),
               Column("unit"))  # fmt: skip
    title = "Along the record: all torques together, and energy"
    return table(title, columns, lines, torque_notes(done))


def torque_notes(done: Assessment) -> list[str]:
    """Return how well the fits explain their rows."""
    metrics, residual = done.metrics, done.estimate.residual
    indices = [
        f"{fit.method} {fit.residual.error_index:.2g}"
        for fit in (metrics.torque_fit, metrics.energy_fit)
        if fit is not None and fit.residual is not None and fit.residual.error_index is not None
    ]
    notes = [f"Error indices (EI): {', '.join(indices)}."] if indices else []
    return notes if residual is None else [*notes, residual_line(residual)]


def change_table(before: Assessment, after: Assessment) -> Table:
    """Return two recordings side by side."""
    tilt = np.degrees(after.torque.tilt)
    rows = (
        (f"torque within {tilt:g} deg, rms", before.torque.rms, after.torque.rms, UN_M, "uN m"),
        ("centre of mass from its target", before.offset, after.offset, UM, "um"),
    )
    lines = [
        [name, *(" (".join(bounds(each, unit)[:2]) + ")" for each in (old, new)), name_of_unit,
         fall(old, new)]
        for name, old, new, unit, name_of_unit in rows
    ]  # fmt: skip
    columns = (Column(), number("before (95 %)"), number("after (95 %)"), Column("unit"), Column())
    return table("Before and after", columns, lines)


def hours_table(hours: OverHours) -> Table:
    """Return drift, walk and Allan deviation of measurements along a recording."""
    title, wander = f"The centre of mass over time, by {len(hours.t)} measurements", hours.wander
    left_out = f"{hours.left_out} measurements could not be used."
    if wander is None:
        few = f"{len(hours.t)} are too few: drift and Allan deviation need {FEWEST}."
        return table(title, (), (), (few, left_out) if hours.left_out else (few,))
    per_minute, root = UM / MINUTE, UM / MINUTE**0.5
    lines = [
        ["drift", *(" ± ".join(with_sd(float(d) / per_minute, float(s) / per_minute))
                    for d, s in zip(wander.drift, wander.drift_sd, strict=True)), "um/min", ""],
        ["walk", *(significant(float(c) / root, 2) for c in wander.walk), "um/sqrt(min)", ""],
    ]  # fmt: skip
    for span, deviation, alone, error in zip(
        wander.span, wander.deviation, wander.measurements_alone, wander.error, strict=True
    ):
        texts = (f"{d / UM:.2g} ({a / UM:.2g})" for d, a in zip(deviation, alone, strict=True))
        name, spread = f"Allan deviation, {span:.4g} s", f"{error / PERCENT:.0f} %"
        lines.append([name, *texts, "um", spread])
    remarks = ["In brackets: what the errors of the measurements alone would leave."]
    remarks += [left_out] if hours.left_out else []
    columns = (Column(), *map(number, "xyz"), Column("unit"), number("relative sd"))
    return table(title, columns, lines, remarks)


def fall(before: Bounded, after: Bounded) -> str:
    """Say by how much a value fell or rose, as far as both bounds show it."""
    if after.high < before.low:
        least, most = before.low / after.high, before.high / max(after.low, 1e-300)
        return f"fell {least:.3g} times at least" + (f", {most:.3g} at most" if after.low else "")
    if after.low > before.high:
        return f"rose {after.low / before.high:.3g} times at least"
    return "no change that the recordings show"
