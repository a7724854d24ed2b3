"""A calibration for terminal and testbed file, in mm, g and deg."""

from collections.abc import Iterator

from rich.console import Group
from rich.table import Table

from equipoise.app.console.rich_results import parameter_table, residual_line
from equipoise.app.console.rich_tables import quiet_table, titled
from equipoise.app.console.terminal import stdout
from equipoise.app.text.numbers import with_sd
from equipoise.app.text.units import PER_DEG
from equipoise.model.estimate import COM, INERTIA, Estimate, Parameter
from equipoise.model.testbed import Testbed

# Head of a column, what its parameter is called, unit a SI unit.
DRIVES = (
    ("gain", "gain_{}", 1.0),
    ("g mm / mm", "product_{}", 1e3),
    ("rail off, deg", "across_{}_1", PER_DEG),
    ("across, deg", "across_{}_2", PER_DEG),
    ("backlash, mm", "backlash_{}", 1e3),
    ("stops scatter, mm", "scatter_{}", 1e3),
)
RAILS = tuple((letter, "axis_{}_" + letter, 1.0) for letter in "xyz")
SENSORS = ("gyro_", "plumb_")
STAYS = (
    "How sensors stand is not written to a testbed file, which has no keys for it: identify finds "
    "the camera's lean again in each record, and the gyro's axes with --term gyro_scale --term "
    "gyro_cross. What balances with that gyro does not know: turn its axes in its own settings."
)


def said(parameter: Parameter, factor: float) -> str:
    """Return a number with its sd, that it was trusted, or that the moves did not show it."""
    if not parameter.observable:
        return "not shown"
    value, sd = with_sd(parameter.value * factor, parameter.sd * factor)
    if sd == "held":
        return f"{value} trusted" if parameter.sd == 0 else value
    return f"{value} +/- {sd}"


def drive_table(
    found: Estimate, names: list[str], columns: tuple[tuple[str, str, float], ...]
) -> Table:
    """Return one line for each mass."""
    table = quiet_table()
    table.add_column("mass", style="bold")
    for head, _, _ in columns:
        table.add_column(head, justify="right")
    for name in names:
        cells = [said(found.parameters[found.index(key.format(name))], f) for _, key, f in columns]
        table.add_row(name, *cells)
    return table


def tables_of(found: Estimate, names: list[str]) -> Iterator[Group]:
    """Return the tables, of masses that moved, of sensors and of the body."""
    if names:
        yield titled("Drives, with sd", drive_table(found, names, DRIVES))
        yield titled("Rails, body axes", drive_table(found, names, RAILS))
    sensors = [p for p in found.parameters if p.name.startswith(SENSORS)]
    body = [p for p in found.parameters if p.name in (*COM, *INERTIA)]
    for title, group in (
        ("Gains over their mean", found.ratios),
        ("Gyro's axes from the camera's body axes, and the camera's vertical", sensors),
        ("Centre of mass and inertia about P, masses at home", body),
    ):
        if group:
            yield parameter_table(title, group)


def show_calibration(found: Estimate, testbed: Testbed) -> None:
    """Print drives, rails, sensors, the body, and what it all rests on."""
    console = stdout()
    names = [m.name for m in testbed.masses if found.has(f"gain_{m.name}")]
    for table in tables_of(found, names):
        console.print()
        console.print(table)
    console.print()
    still = [m.name for m in testbed.masses if m.name not in names]
    if still and names:
        console.print(f"Never moved, so not shown: {', '.join(still)}.", markup=False)
    stays = (STAYS,) if any(p.name.startswith(SENSORS) for p in found.parameters) else ()
    for sentence in (*found.unobservable, *found.unexplained, *stays):
        console.print(sentence, markup=False)
    if found.residual is not None:
        console.print(residual_line(found.residual), markup=False)
    style = "bold green" if found.outcome.usable else "bold red"
    console.print(found.outcome.sentence, style=style, markup=False)


def remarks_of(found: Estimate, testbed: Testbed) -> dict[str, str]:
    """Return what is written behind each calibrated key of a mass."""
    remarks: dict[str, str] = {}
    for mass in testbed.masses:
        if not found.has(f"gain_{mass.name}"):
            continue
        one, two = (found.parameters[found.index(f"across_{mass.name}_{k}")] for k in (1, 2))
        off = f"{said(one, PER_DEG)} and {said(two, PER_DEG)} deg off as stated"
        reported = {
            "gain": said(found.parameters[found.index(f"gain_{mass.name}")], 1.0),
            "axis": off,
            "backlash_mm": said(found.parameters[found.index(f"backlash_{mass.name}")], 1e3),
        }
        remarks |= {f"{key} {mass.name}": f"calibrated: {text}" for key, text in reported.items()}
    return remarks
