"""Methods compared, as tables, JSON and CSV."""

from collections.abc import Iterator, Sequence

import numpy as np

from equipoise.app.text.blocks import Column, Table, number, table, tabulated
from equipoise.app.text.csv_lines import csv_lines
from equipoise.app.text.json_lists import COMPARE_METHODS
from equipoise.app.text.json_shape import View
from equipoise.app.views.study.law_views import short
from equipoise.maths.linalg import element_sizes
from equipoise.model.arrays import Floats
from equipoise.model.estimate import COM
from equipoise.model.units import DEG, MEGABYTE, MS, PERCENT, UM
from equipoise.study.compare_methods import MethodComparison, MethodSummary, Ratios, Share
from equipoise.study.method_run import JUDGED, MethodRun
from equipoise.study.recommend import advised_method, lacks

OPEN = (
    "Neither these records nor an option fix the common scale of inertia and centre "
    "of mass, so there is no bound to compare with: give --move, --hold or --prior."
)
READ = (
    "RMSE / bound: root mean square error, each in units of its record's Cramer-Rao "
    "bound (for the same unknowns; a method with prior information may be below 1). "
    "bias: the part that averaging does not remove. holds: coverage of 95 % "
    "intervals, over runs without a warning. NEES: squared error over covariance per "
    "parameter; ideally 1. wrong: runs with an error above 5 sd and no warning. "
    "warned: runs with a warning about the intervals. failed: refused, not usable or "
    "aborted; excluded from statistics. Methods without failure and with valid "
    "intervals come first."
)
TAKES = (
    "ms: median processor time per record. MB: peak memory of Python and NumPy. "
    "settles, s: time after which the com error stays below a tenth of its initial "
    "value, for sequential methods; never: in most runs."
)


def figure(value: float, digits: int = 2) -> str:
    """Return a number with so many digits, "-" for none."""
    if np.isnan(value):
        return "-"
    return f"{value:.0e}".replace("e+0", "e") if abs(value) >= 1e4 else short(value, digits)


def percent(share: Share) -> str:
    """Return a share in percent, "-" of nothing."""
    return f"{share.value / PERCENT:.0f} %" if share.of else "-"


def some(count: int) -> str:
    """Return a count of what is not wished for, "-" for none."""
    return str(count) if count else "-"


def shown_order(found: MethodComparison) -> list[MethodSummary]:
    """Return the methods: those that qualify first, each part by its error of com."""

    def place(method: MethodSummary) -> tuple[bool, float]:
        ratio = method.com.rmse
        return bool(lacks(method, "com")), np.inf if np.isnan(ratio) else ratio

    return sorted(found.methods, key=place)


def tables(found: MethodComparison) -> Iterator[Table]:
    """Yield the tables of a comparison."""
    yield overview(found)
    yield com_table(found)
    if any(method.inertia.stated.part for method in found.methods):
        yield inertia_table(found)
    if any(np.isfinite(method.time) for method in found.methods):
        yield cost_table(found)


def overview(found: MethodComparison) -> Table:
    """Return accuracy and honesty, one line a method; say where an open scale forbids both."""
    unscaled = () if np.any(np.isfinite(found.bound)) else (OPEN,)
    return tabulated(
        f"RMSE / bound of {len(found.seeds)} records of {found.scene.testbed.name}",
        shown_order(found),
        (Column(), lambda method: method.method),
        (number("com"), lambda method: ratio_text(method.com)),
        (number("J"), lambda method: ratio_text(method.inertia)),
        (number("bias"), lambda method: figure(method.com.bias)),
        (number("holds"), lambda method: percent(method.coverage)),
        (number("NEES"), lambda method: figure(method.nees)),
        (number("wrong"), lambda method: some(method.confident_wrong)),
        (number("warned"), lambda method: some(method.warned)),
        (number("failed"), lambda method: some(method.failed)),
        notes=(*unscaled, READ, *at_stop(found), *failures(found)),
    )


def at_stop(found: MethodComparison) -> Iterator[str]:
    """Yield in how many records the platform meets its stop, if in any."""
    if found.met_stop:
        limit = found.scene.testbed.tilt_limit / DEG
        yield (
            f"In {found.met_stop} of {len(found.seeds)} records the platform meets its "
            f"stop, at {limit:.3g} deg of tilt: its equilibrium is too far from level "
            "for any release. No method models this."
        )


def cost_table(found: MethodComparison) -> Table:
    """Return what a record takes of those that were not refused, the quickest first."""
    return tabulated(
        "Cost per record",
        sorted((m for m in found.methods if np.isfinite(m.time)), key=lambda m: m.time),
        (Column(), lambda method: method.method),
        (number("", "ms"), lambda method: figure(method.time / MS)),
        (number("", "MB"),
         lambda method: "-" if method.memory is None else figure(method.memory / MEGABYTE)),
        (number("settles", "s"),
         lambda method: "-" if method.settled is None else seconds(method.settled)),
        notes=(TAKES,),
    )  # fmt: skip


def seconds(value: float) -> str:
    """Return a time; infinite: never."""
    return "never" if np.isinf(value) else figure(value)


def ratio_text(ratios: Ratios) -> str:
    """Return RMSE / bound; with a mark where a method states only part of what is shown."""
    part = ratios.stated.part < ratios.stated.of
    return figure(ratios.rmse) + ("*" if part and ratios.stated.part else "")


def failures(found: MethodComparison) -> Iterator[str]:
    """Yield why methods failed, those together that say the same."""
    if any(0 < r.stated.part < r.stated.of for m in found.methods for r in (m.com, m.inertia)):
        yield "*: states only part of what the records determine."
    reasons = dict[str, list[str]]()
    for method in found.methods:
        if method.failed:
            reported = f"{method.method} ({method.failed})"
            reasons.setdefault(method.why, []).append(reported)
    for reason, methods in reasons.items():
        yield f"Failed: {', '.join(methods)}: {reason}"


def com_table(found: MethodComparison) -> Table:
    """Return bias and sd of the centre of mass along each axis and RMSE of the whole, um."""
    headings = (*(f"{what} {axis}" for axis in "xyz" for what in ("bias", "sd")), "RMSE")
    bound = [observed_text(b / UM) for b in found.bound[:3]]
    lines = [
        ["bound", "", bound[0], "", bound[1], "", bound[2], observed_text(norm(found.bound) / UM)]
    ]
    for method in shown_order(found):
        columns = np.stack([method.bias[:3], method.sd[:3]], axis=1) / UM
        if np.any(np.isfinite(method.rmse[:3])):
            whole = figure(norm(method.rmse) / UM)
            lines.append([method.method, *(figure(float(x)) for x in columns.ravel()), whole])
    remark = (
        "sd: of the errors over the runs. RMSE: of the vector, as far as it is "
        "stated. Bounds are root mean squares over the records. Masses at home; a "
        "method that states com only at the end of the record, such as the tracker, "
        "is compared there."
    )
    columns = (Column(), *map(number, headings))
    return table("Errors of the centre of mass, um", columns, lines, (remark,))


def norm(sizes: Floats) -> float:
    """Return the size of a centre of mass of which what is not nan is known."""
    return float(np.sqrt(np.nansum(sizes[:3] ** 2)))


def inertia_table(found: MethodComparison) -> Table:
    """Return RMSE of the inertia, percent of sqrt(J_ii J_jj)."""
    part = slice(3, 9)
    percent_of_size = PERCENT * element_sizes(found.scene.testbed.body.inertia_P)
    headings = (*(name[-2:] for name in JUDGED[part]), "bias / bound")
    lines = [["bound", *map(observed_text, found.bound[part] / percent_of_size), ""]]
    for method in shown_order(found):
        if method.inertia.stated.part:
            cells = map(figure, method.rmse[part] / percent_of_size)
            lines.append([method.method, *cells, figure(method.inertia.bias)])
    title = "RMSE of the inertia about P, percent of sqrt(J_ii J_jj)"
    return table(title, (Column(), *map(number, headings)), lines)


def observed_text(bound: float) -> str:
    """Return a bound; infinite: some records do not show it, nan: it was held."""
    return "unobservable" if np.isinf(bound) else "held" if np.isnan(bound) else figure(bound)


def methods_json(found: MethodComparison) -> View:
    """Return the comparison as JSON, SI units."""
    advice = {group: advised_method(found.methods, group) for group in ("com", "inertia")}
    return COMPARE_METHODS.write({"found": found, "parameters": JUDGED, "recommended": advice})


def methods_csv(runs: Sequence[MethodRun]) -> str:
    """Return one line a run: errors, stated sd and bounds, com in um and inertia in kg m2."""
    columns = [
        f"{name}_{what}_{'um' if name in COM else 'kg_m2'}"
        for what in ("error", "sd", "bound")
        for name in JUDGED
    ]
    heads = ("method", "seed", "ending", "warned", *columns, "nees", "settled_s", "time_s",
             "memory_bytes", "outcome")  # fmt: skip
    return csv_lines(heads, map(_csv_line, runs))


def _csv_line(run: MethodRun) -> list[object]:
    unit = np.where(np.isin(JUDGED, COM), UM, 1.0)
    values = np.concatenate([run.error / unit, run.sd / unit, run.bound / unit])
    cost = ("" if run.settled is None else plain(run.settled), plain(run.cost.time),
            "" if run.cost.memory is None else run.cost.memory)  # fmt: skip
    return [run.method, run.seed, run.ending, run.warned, *map(plain, values),
            plain(run.nees), *cost, run.sentence]  # fmt: skip


def plain(value: float) -> str:
    """Return a number for a file, "" for none."""
    return "" if np.isnan(value) else f"{value:.6g}"
