"""Laws compared, for terminal, JSON and CSV."""

from equipoise.app.text.blocks import Column, Table, number, table
from equipoise.app.text.csv_lines import csv_lines
from equipoise.app.text.json_lists import COMPARE_LAWS
from equipoise.app.text.json_shape import View
from equipoise.model.units import DEG, MM, PERCENT, UM, UN_M
from equipoise.study.compare_laws import Comparison, LawSummary, Middle, halted
from equipoise.study.law_run import LawRun
from equipoise.study.recommend import advised_law


def both(values: Middle, unit: float, digits: int = 2) -> str:
    """Return a median, and in brackets what 95 % stay below."""
    middle, most = values.median / unit, values.most / unit
    return f"{short(middle, digits)} ({short(most, digits)})"


def short(value: float, digits: int) -> str:
    """Return a number with so many digits, or whole where it has more before the point."""
    return f"{value:.0f}" if abs(value) >= 10.0**digits else f"{value:.{digits}g}"


def summary_cells(law: LawSummary) -> tuple[str, ...]:
    """Return one law as cells."""
    return (
        law.law,
        both(law.aside, UM),
        both(law.height, UM),
        both(law.torque, UN_M, 3),
        "-" if law.followed is None else both(law.followed, UN_M, 3),
        f"{law.within / law.runs / PERCENT:.0f} %",
        both(law.time, 1.0, 3),
        both(law.travel, MM, 3),
        f"{law.halted}",
        f"{law.late}",
        f"{law.false_passes}",
    )


def laws_table(found: Comparison) -> Table:
    """Return all laws, the one that leaves the least torque first, and who was refused why."""
    required = f"<= {found.required / UN_M:g} uN m"
    columns = (Column("law"), number("aside", "um"), number("height", "um"),
               number("torque", "uN m"), number("following"), number(required),
               number("time", "s"), number("travel", "mm"), number("halted"), number("late"),
               number("false"))  # fmt: skip
    lines = [summary_cells(law) for law in sorted(found.laws, key=lambda each: each.left.most)]
    said = (
        f"{len(found.seeds)} platforms of {found.testbed.name}; medians, in brackets what 95 % of "
        f"the runs stay below. Offsets from the target; torque rms within "
        f"{found.tilt / DEG:.3g} deg of level, {both(found.before, UN_M, 3)} uN m before; "
        "following: with masses that follow the tilt by the sag that was found. "
        "Halted: broken off for safety; late: out of time; false: passed by a verdict, and twice "
        "the tolerance off."
    )
    refused = [f"{each.law} was refused: {each.why}" for each in found.refusals]
    return table(f"Laws on {found.testbed.name}", columns, lines, (said, *refused))


def comparison_json(found: Comparison) -> View:
    """Return the comparison as JSON, SI units."""
    return COMPARE_LAWS.write({"found": found, "recommended": advised_law(found)})


def laws_csv(found: Comparison) -> str:
    """Return one line a run."""
    heads = ("law", "seed", "offset_x_um", "offset_y_um", "offset_z_um", "torque_uN_m",
             "followed_uN_m", "time_s", "travel_mm", "passed", "halted", "late",
             "verdict")  # fmt: skip
    return csv_lines(heads, map(_csv_line, found.runs))


def _csv_line(run: LawRun) -> list[object]:
    offset = [f"{x / UM:.6g}" for x in run.offset]
    followed = "" if run.followed is None else f"{run.followed / UN_M:.6g}"
    return [run.law, run.seed, *offset, f"{run.torque / UN_M:.6g}", followed,
            f"{run.time:.6g}", f"{run.travel / MM:.6g}", run.verdict.passed,
            halted(run), run.late, run.verdict.sentence]  # fmt: skip
