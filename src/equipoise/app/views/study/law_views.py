"""Laws compared, for terminal, JSON and CSV."""

from equipoise.app.text.blocks import Column, Table, number, tabulated
from equipoise.app.text.csv_lines import csv_lines
from equipoise.app.text.json_lists import COMPARE_LAWS
from equipoise.app.text.json_shape import View
from equipoise.model.units import DEG, MM, PERCENT, UM, UN_M
from equipoise.study.compare_laws import Comparison, Middle, halted
from equipoise.study.law_run import LawRun
from equipoise.study.recommend import advised_law


def both(values: Middle, unit: float, digits: int = 2) -> str:
    """Return a median, and in brackets what 95 % stay below."""
    middle, most = values.median / unit, values.most / unit
    return f"{short(middle, digits)} ({short(most, digits)})"


def short(value: float, digits: int) -> str:
    """Return a number with so many digits, or whole where it has more before the point."""
    return f"{value:.0f}" if abs(value) >= 10.0**digits else f"{value:.{digits}g}"


def laws_table(found: Comparison) -> Table:
    """Return all laws, the one that leaves the least torque first, and who was refused why."""
    said = (
        f"{len(found.seeds)} platforms of {found.testbed.name}. Medians; in brackets "
        "the 95th percentile. Offsets from the target. Torque rms within "
        f"{found.tilt / DEG:.3g} deg of level; {both(found.before, UN_M, 3)} uN m "
        "before. Following: masses follow the tilt by the estimated sag. Halted: "
        "stopped for safety. Late: time limit reached. False: passed by a verdict, "
        "but outside the tolerance."
    )
    refused = [f"{each.law} was refused: {each.why}" for each in found.refusals]
    laws = sorted(found.laws, key=lambda law: law.left.most)
    return tabulated(
        f"Laws on {found.testbed.name}",
        laws,
        (Column("law"), lambda law: law.law),
        (number("sideways", "um"), lambda law: both(law.aside, UM)),
        (number("height", "um"), lambda law: both(law.height, UM)),
        (number("torque", "uN m"), lambda law: both(law.torque, UN_M, 3)),
        (number("following"),
         lambda law: "-" if law.followed is None else both(law.followed, UN_M, 3)),
        (number(f"<= {found.required / UN_M:g} uN m"),
         lambda law: f"{law.within / law.runs / PERCENT:.0f} %"),
        (number("time", "s"), lambda law: both(law.time, 1.0, 3)),
        (number("travel", "mm"), lambda law: both(law.travel, MM, 3)),
        (number("halted"), lambda law: f"{law.halted}"),
        (number("late"), lambda law: f"{law.late}"),
        (number("false passes"), lambda law: f"{law.false_passes}"),
        notes=(said, *refused),
    )  # fmt: skip


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
