"""The tables of an assessment."""

import numpy as np

from equipoise.app.text.blocks import (
    Blocks,
    Column,
    Item,
    Items,
    Row,
    Table,
    Tone,
    number,
    table,
)
from equipoise.app.text.estimate_text import residual_line
from equipoise.app.text.numbers import significant, with_sd
from equipoise.assessment.metrics.allan import FEWEST
from equipoise.maths.gaussian_length import Bounded
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.units import MINUTE, PERCENT, UM, UN_M
from equipoise.procedure.identification.assess import Assessment
from equipoise.procedure.identification.cross_checks import CrossCheck, Metric, distance
from equipoise.procedure.identification.drift_metrics import OverHours


def range_table(done: Assessment) -> Table:
    """Return what counts: torque within the range, distance from the target."""
    torque, tilt = done.torque, np.degrees(done.torque.tilt)
    lines = [
        [f"gravity torque within {tilt:g} deg, rms", *bounds(torque.rms, UN_M), "uN m"],
        [
            f"gravity torque within {tilt:g} deg, maximum",
            significant(torque.worst / UN_M),
            f"up to {significant(torque.worst_high / UN_M)}",
            "",
            "uN m",
        ],
        ["distance of the centre of mass from its target", *bounds(done.offset, UM), "um"],
    ]
    remark = (
        f"The inertia is known to {done.inertia_sd / PERCENT:.2g} %, and all values "
        "are proportional to it. Detection limit: the bound that a perfect platform "
        "would get in this recording."
    )
    columns = (Column(), *map(number, ("value", "95 % bounds", "detection limit")), Column("unit"))
    return table("Residual gravity torque of the platform", columns, lines, (remark,))


def bounds(found: Bounded, unit: float) -> tuple[str, str, str]:
    """Return value, bounds and floor as texts."""
    value, low, high, floor = (significant(x / unit) for x in found)
    return value, f"{low} to {high}", floor


def measurements_table(done: Assessment) -> Table:
    """Return the centre of mass by the fit and by simpler methods."""
    lines = [fit_row(done), *(check_row(done, check) for check in done.checks)]
    notes = (
        (
            "All methods use the inertia of the fit. The fit's sd includes that of the "
            "inertia; the others' do not, because it is common to all. Difference: from "
            "the fit at that inertia, in sd of the difference."
        ),
        (f"The other methods use {done.metrics.duration:.3g} s of swing after the masses stopped."),
    )
    columns = (Column(), number("com x", "um"), number("y"), number("z"),
               number("distance from P", "um"), number("difference"),
               Column("included"))  # fmt: skip
    title = "Cross-checks: centre of mass with the masses in their present positions"
    return table(title, columns, lines, notes)


def fit_row(done: Assessment) -> Row:
    """Return the row of the fit."""
    size = length_text(*distance(done.com, done.com_covariance))
    return Row(("trajectory fit", *components(done.com, done.com_covariance), size, "", ""))


def check_row(done: Assessment, check: CrossCheck) -> Row:
    """Return the row of a cross-check."""
    found, name, counts = check.found, check_name(done, check), "yes" if check.counts else "no"
    if found is None:
        return Row((name, "", "", "", "", "", counts), "quiet")
    com = ("", "", "")
    if found.com is not None and found.covariance is not None:
        com = components(found.com, found.covariance)
    cells = (name, *com, length_text(found.distance, found.sd), f"{found.off:.1f}", counts)
    return Row(cells, tone_of(check))


def check_name(done: Assessment, check: CrossCheck) -> str:
    """Return what a cross-check goes by, with the time over which it goes."""
    if check.metric is Metric.TORQUE:
        return f"{check.metric.value}, slopes over {done.metrics.window:.3g} s"
    if check.found is None or check.found.swing is None:
        return check.metric.value
    swing = check.found.swing
    period = with_sd(1 / swing.frequency, swing.sd / swing.frequency**2)
    return f"{check.metric.value}, {' +/- '.join(period)} s"


def tone_of(check: CrossCheck) -> Tone:
    """Return how a cross-check is set off: one that disagrees, and one that does not count."""
    if check.disagrees:
        return "bad"
    return "plain" if check.counts else "quiet"


def check_items(done: Assessment) -> Blocks:
    """Return what each cross-check said, and whether it counts."""
    if not done.checks:
        return ()
    said = (Item(f"Cross-check, {check.sentence}", tone_of(check)) for check in done.checks)
    return (Items(tuple(said)),)


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
    title = "Disturbance torques along the record, and energy"
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
    outcome = before.estimate.outcome
    notes = (f"Before balancing: {outcome.sentence}",) if outcome.warns else ()
    return table("Before and after", columns, lines, notes)


def hours_table(hours: OverHours) -> Table:
    """Return drift, walk and Allan deviation of measurements along a recording."""
    title, wander = f"Centre of mass over time, {len(hours.t)} windows", hours.wander
    left_out = f"{hours.left_out} windows were not usable."
    if wander is None:
        few = f"{len(hours.t)} windows are too few: drift and Allan deviation need {FEWEST}."
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
    remarks = ["In brackets: the part caused by estimation errors alone."]
    remarks += [left_out] if hours.left_out else []
    columns = (Column(), *map(number, "xyz"), Column("unit"), number("relative sd"))
    return table(title, columns, lines, remarks)


def fall(before: Bounded, after: Bounded) -> str:
    """Say by how much a value fell or rose, as far as both bounds show it."""
    if after.high < before.low:
        least, most = before.low / after.high, before.high / max(after.low, 1e-300)
        return f"reduced by a factor of at least {least:.3g}" + (
            f", {most:.3g} at most" if after.low else ""
        )
    if after.low > before.high:
        return f"increased by a factor of at least {after.low / before.high:.3g}"
    return "no significant change"
