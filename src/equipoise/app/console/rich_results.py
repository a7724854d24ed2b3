"""Estimates, findings and steps as tables and lines for the terminal."""

import math
from collections.abc import Iterator, Sequence

from rich.console import Group
from rich.table import Table
from rich.text import Text

from equipoise.app.console.rich_tables import quiet_table, titled
from equipoise.app.text.before_after import HEADS, Change, rows
from equipoise.app.text.numbers import fixed, interval, significant, with_sd
from equipoise.app.text.units import PER_DEG, UM, unit_for
from equipoise.maths.whiteness import WHITE
from equipoise.model.estimate import COM, Estimate, Parameter, Residual
from equipoise.model.finding import Finding
from equipoise.model.step import Step
from equipoise.model.verdict import Verdict

MARKS = {"content": "  ", "motion": "  ", "problem": "! ", "mended": "~ "}
FINDING_STYLE = {"content": "", "motion": "", "problem": "bold yellow", "mended": "dim"}
STEP_STYLE = {
    "measurement": "dim",
    "estimate": "",
    "move": "cyan",
    "place": "bold cyan",
    "control": "cyan",
    "verify": "bold",
    "stop": "bold",
}


def finding_line(finding: Finding) -> Table:
    """Return a finding; '!' marks what an estimate will suffer from, '~' what was set right."""
    line = Table.grid()
    line.add_column(width=2, no_wrap=True)
    line.add_column()
    cells_ = (MARKS[finding.kind], finding.sentence)
    line.add_row(*map(Text, cells_), style=FINDING_STYLE[finding.kind])
    return line


def step_line(step: Step) -> Table:
    """Return a step: when, what, and what came of it."""
    line = Table.grid(padding=(0, 2))
    line.add_column(width=9, justify="right", no_wrap=True)
    line.add_column(width=8, no_wrap=True)
    line.add_column()
    cells_ = (f"{step.time:.1f} s", step.kind, step.sentence)
    line.add_row(*map(Text, cells_), style=STEP_STYLE[step.kind])
    return line


def cells(parameter: Parameter) -> tuple[str, str, str, str, str]:
    """Return name, value, sd, 95 % interval and unit, in the unit of the bench."""
    unit = unit_for(parameter.name, parameter.unit)
    value, sd = parameter.value * unit.factor, parameter.sd * unit.factor
    low, high = parameter.low95 * unit.factor, parameter.high95 * unit.factor
    value_text, sd_text = with_sd(value, sd)
    return parameter.name, value_text, sd_text, interval(value, low, high, sd), unit.name


def parameter_table(title: str, parameters: Sequence[Parameter]) -> Group:
    """Return named values with sd and 95 % interval."""
    table = quiet_table()
    table.add_column("", style="bold")
    for head in ("value", "sd", "95 % interval"):
        table.add_column(head, justify="right")
    table.add_column("unit")
    for parameter in parameters:
        table.add_row(*cells(parameter), style="" if parameter.observable else "dim")
    return titled(title, table)


def groups(estimate: Estimate) -> Iterator[tuple[str, list[Parameter]]]:
    """Return the parameters in the groups in which they are told."""

    def of(*stems: str) -> list[Parameter]:
        return [p for p in estimate.parameters if p.name.startswith(stems)]

    yield "Centre of mass and inertia about P, masses at home", of(*COM, "inertia_P_")
    yield "Centre of mass, masses as they stand at the end", of("com_end_")
    reported = of("com_", "inertia_P_")
    yield "Also estimated", [p for p in estimate.parameters if p not in reported]
    yield "Ratios, which do not need the scale", list(estimate.ratios)


def estimate_tables(estimate: Estimate) -> list[Group]:
    """Return one table for each group that is not empty."""
    return [parameter_table(title, group) for title, group in groups(estimate) if group]


def residual_line(residual: Residual) -> str:
    """Return what the model leaves, and what it predicted of rows that it was not shown."""
    if residual.error_index is not None:
        return _linear_line(residual)
    attitude = residual.attitude_rms is not None
    unit = "deg" if attitude else "deg/s"
    fitted = residual.attitude_rms if attitude else residual.rate_rms
    text = f"Residual: {_rms(fitted)} {unit} rms per axis fitted"
    if residual.held_out_rms is not None and residual.held_out_span is not None:
        start, end = residual.held_out_span
        text += (
            f"; {_rms(residual.held_out_rms)} {unit} predicted for {start:.4g} to {end:.4g} s "
            "by a fit that was not shown them"
        )
    if residual.steady_rms is not None and fitted is not None and residual.steady_rms > fitted:
        text += f"; {_rms(residual.steady_rms)} {unit} without the torque that wanders"
    return f"{text}. Lag-one correlation {fixed(residual.lag_one, 2)}; {_white(residual)}."


def noise_floor_line(verdict: Verdict) -> str:
    """Return which offsets the record of a verdict cannot tell from none; empty without one."""
    if verdict.noise_floor is None:
        return ""
    reported = (f"{axis} {significant(um, 2)} um" if math.isfinite(um) else f"{axis} not seen"
            for axis, um in zip("xyz", UM * verdict.noise_floor, strict=True))  # fmt: skip
    return (
        f"Noise floor of this record (95 %): {', '.join(reported)}. "
        "A smaller offset cannot be told from none."
    )


def _linear_line(residual: Residual) -> str:
    """Return what the rows of a linear method leave, with Lee's error indices."""
    text = f"Error index {residual.error_index:.3g}: share of the rows' known side that is left"
    if residual.error_indices:
        name, worst = max(residual.error_indices.items(), key=lambda item: item[1])
        text += f"; parameter error index of {name} {worst:.2g}, the greatest"
    return f"{text}. They take rows for independent and columns for exact: they are no intervals."


def _white(residual: Residual) -> str:
    """Say whether what is left is white noise, by the portmanteau test."""
    if residual.whiteness < WHITE:
        return f"not white noise (p < {WHITE:g})"
    return f"white noise as far as rows tell (p = {residual.whiteness:.2g})"


def _rms(value: float | None) -> str:
    return "?" if value is None else f"{value * PER_DEG:.3g}"


def change_table(change: Change) -> Group:
    """Return before and after side by side; the truth beside it when it is known."""
    lines = list(rows(change))
    shown = len(HEADS) if lines[0].truth_before else len(HEADS) - 2
    table = quiet_table()
    for k, head in enumerate(HEADS[:shown]):
        table.add_column(head, justify="left" if k < 2 else "right", style="bold" if not k else "")
    for line in lines:
        table.add_row(*line[:shown])
    return titled("Before and after", table)
