"""An estimate as tables and sentences."""

import math
from collections.abc import Iterator, Sequence

from equipoise.app.text.blocks import Blocks, Claim, Column, Row, Table, Tone, items, number, table
from equipoise.app.text.numbers import fixed, interval, significant, unit_for, with_sd
from equipoise.maths.whiteness import WHITE
from equipoise.model.estimate import COM, Estimate, Parameter, Residual
from equipoise.model.outcome import OutcomeCode, Trust
from equipoise.model.units import DEG, UM
from equipoise.model.verdict import Verdict

TONES: dict[Trust, Tone] = {
    Trust.TRUSTWORTHY: "good",
    Trust.WIDENED: "good",
    Trust.NOT_TRUSTWORTHY: "caution",
    Trust.NOT_USABLE: "bad",
}
COLUMNS = (Column(), *map(number, ("value", "sd", "95 % interval")), Column("unit"))


def cells(parameter: Parameter) -> tuple[str, str, str, str, str]:
    """Return name, value, sd, 95 % interval and unit, in the unit of the bench."""
    unit = unit_for(parameter.name, parameter.unit)
    value, sd = parameter.value / unit.size, parameter.sd / unit.size
    low, high = parameter.low95 / unit.size, parameter.high95 / unit.size
    value_text, sd_text = with_sd(value, sd)
    return parameter.name, value_text, sd_text, interval(value, low, high, sd), unit.name


def parameter_table(title: str, parameters: Sequence[Parameter]) -> Table:
    """Return named values with sd and 95 % interval."""
    rows = (Row(cells(p), "plain" if p.observable else "quiet") for p in parameters)
    return table(title, COLUMNS, rows)


def groups(estimate: Estimate) -> Iterator[tuple[str, list[Parameter]]]:
    """Return the parameters in the groups in which they are shown."""

    def of(*stems: str) -> list[Parameter]:
        return [p for p in estimate.parameters if p.name.startswith(stems)]

    yield "Centre of mass and inertia about P, masses at home", of(*COM, "inertia_P_")
    yield "Centre of mass, masses as positioned at the end", of("com_end_")
    shown = of("com_", "inertia_P_")
    yield "Also estimated", [p for p in estimate.parameters if p not in shown]
    yield "Ratios (independent of the scale)", list(estimate.ratios)


def estimate_tables(estimate: Estimate) -> tuple[Table, ...]:
    """Return one table for each group that is not empty."""
    return tuple(parameter_table(title, group) for title, group in groups(estimate) if group)


def unobservable_items(estimate: Estimate) -> Blocks:
    """Return what the data cannot show; nothing where they show all."""
    return items((reason.sentence for reason in estimate.unobservable), "caution")


def outcome_claim(estimate: Estimate) -> Claim:
    """Return the sentence that sums an estimate up; one of a part alone is no good news."""
    tone = TONES[estimate.outcome.trust]
    whole = estimate.outcome.code is OutcomeCode.ESTIMATED
    return Claim(estimate.outcome.sentence, tone if whole or tone != "good" else "caution")


def residual_line(residual: Residual | None) -> str:
    """Return what the model leaves, and what it predicted of rows that it was not shown."""
    if residual is None:
        return ""
    if residual.error_index is not None:
        return _linear_line(residual)
    attitude = residual.attitude_rms is not None
    unit = "deg" if attitude else "deg/s"
    fitted = residual.attitude_rms if attitude else residual.rate_rms
    text = f"Residuals: {_rms(fitted)} {unit} rms per axis"
    if residual.held_out_rms is not None and residual.held_out_span is not None:
        start, end = residual.held_out_span
        text += (
            f"; {_rms(residual.held_out_rms)} {unit} predicted for {start:.4g} to "
            f"{end:.4g} s by a fit without these data"
        )
    if residual.steady_rms is not None and fitted is not None and residual.steady_rms > fitted:
        text += f"; {_rms(residual.steady_rms)} {unit} without process noise"
    return f"{text}. Lag-one autocorrelation {fixed(residual.lag_one, 2)}; {_white(residual)}."


def noise_floor_line(verdict: Verdict) -> str:
    """Return the offsets that the record of a verdict cannot distinguish from zero."""
    if verdict.noise_floor is None:
        return ""
    reported = (f"{axis} {significant(um, 2)} um" if math.isfinite(um) else f"{axis} unobservable"
            for axis, um in zip("xyz", verdict.noise_floor / UM, strict=True))  # fmt: skip
    return f"Detection limit (95 %): {', '.join(reported)}."


def _linear_line(residual: Residual) -> str:
    """Return what the rows of a linear method leave, with Lee's error indices."""
    text = f"Error index {residual.error_index:.3g}: relative residual of the rows"
    if residual.error_indices:
        name, worst = max(residual.error_indices.items(), key=lambda item: item[1])
        text += f"; maximum parameter error index {worst:.2g} ({name})"
    return (
        f"{text}. These indices assume independent rows and exact columns; they are no intervals."
    )


def _white(residual: Residual) -> str:
    """Say whether what is left is white noise, by the portmanteau test."""
    if residual.whiteness < WHITE:
        return f"not white noise (p < {WHITE:g})"
    return f"consistent with white noise (p = {residual.whiteness:.2g})"


def _rms(value: float | None) -> str:
    return "?" if value is None else f"{value / DEG:.3g}"
