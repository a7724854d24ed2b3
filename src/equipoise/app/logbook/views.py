"""Runs of a logbook as tables for the terminal and as JSON."""

import math
from collections.abc import Mapping, Sequence

from equipoise.app.logbook.testbed_history import letters
from equipoise.app.text.blocks import (
    Blocks,
    Column,
    Paragraph,
    Row,
    Table,
    Tone,
    number,
    paragraphs,
    table,
)
from equipoise.app.text.json_lists import LOGBOOK, RUNS_COMPARED
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import decimals_for, fixed, is_known, unit_for
from equipoise.io.documents.logbook import Logbook
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, INERTIA, Parameter, normalised_difference
from equipoise.model.logged_run import Ending, LoggedRun, Usability
from equipoise.model.verdict import VerdictOutcome

TONES: Mapping[Ending, Tone] = {
    VerdictOutcome.PASSED: "good",
    VerdictOutcome.FAILED: "bad",
    VerdictOutcome.HALTED: "bad",
    VerdictOutcome.UNDECIDED: "caution",
    Usability.USABLE: "good",
    Usability.NOT_USABLE: "bad",
}
MEANING = "com: as judged, masses in their present positions; identify: masses at home"
TO_MINUTE = 16  # characters of a time, to the minute


def runs_blocks(book: Logbook, runs: Sequence[LoggedRun]) -> Blocks:
    """Return a line for each run; the centre of mass as it was judged, else with masses at home."""
    if not runs:
        return paragraphs("No such run.")
    headings = ("made at", "platform", "build", "what", "by", "outcome", "com, um")
    columns = (number(""), *(Column(h, fold=h == "platform") for h in headings))
    build = letters(book)
    rows = (
        Row(
            (
                str(k), local(run), run.platform, build[run.platform, run.configuration],
                run.kind, run.method, run.outcome, com_text(book, run),
            ),
            TONES[run.outcome],
        )
        for k, run in enumerate(runs, 1)
    )  # fmt: skip
    return table("", columns, rows), Paragraph(MEANING, "quiet")


def local(run: LoggedRun) -> str:
    """Return when a run was made, on the clock that it was made by, to the minute."""
    return run.made_at[:TO_MINUTE].replace("T", " ")


def com_text(book: Logbook, run: LoggedRun) -> str:
    """Return the centre of mass that counts: as judged, else with masses at home."""
    numbers = book.numbers(run.name, "standing") or book.numbers(run.name, "home")
    known = {p.name: p for p in numbers}
    if not all(name in known for name in COM):
        return ""
    return "(" + ", ".join(_short(known[name]) for name in COM) + ")"


def _short(parameter: Parameter) -> str:
    unit = unit_for(parameter.name, parameter.unit)
    value, sd = parameter.value / unit.size, parameter.sd / unit.size
    if not parameter.observable:
        return "?"
    return fixed(value, max(decimals_for(sd), 0)) if is_known(value, sd) else f"{value:.4g}"


def chosen(runs: Sequence[LoggedRun], name: str) -> LoggedRun:
    """Return a run by its number in the list, or by its name, with or without its month's folder.

    Raises InputError if there is none, or if the name is that of several.
    """
    by_number = {str(k): run for k, run in enumerate(runs, 1)}
    if name in by_number:
        return by_number[name]
    named = [run for run in runs if run.name == name] or [
        run for run in runs if run.name.rpartition("/")[2] == name
    ]
    if len(named) == 1:
        return named[0]
    found = f"'{name}', the name of {len(named)} runs" if named else f"'{name}'"
    raise InputError("--compare", found, f"a number from 1 to {len(runs)}, or a name")


def compared(book: Logbook, runs: Sequence[LoggedRun]) -> Table:
    """Return the numbers of several runs side by side.

    Below each of the later ones stands how far it is from the first, in sd of the difference of
    two independent estimates.
    """
    numbers = [_by_name(book, run) for run in runs]
    names = [name for name in (*COM, *INERTIA) if all(name in each for each in numbers)]
    columns = (
        Column(),
        Column("unit"),
        *(number(f"{k}: {local(r)}") for k, r in enumerate(runs, 1)),
    )
    lines: list[list[str]] = []
    for name in names:
        first, *others = (each[name] for each in numbers)
        unit = unit_for(name, first.unit)
        reported = [f"{_short(p)} ({_separation(p, first)})" for p in others]
        lines.append([name, unit.name, _short(first), *reported])
    remarks = [f"{k}: {r.name}, {r.platform}, {r.method}" for k, r in enumerate(runs, 1)]
    return table(
        "Masses at home; in brackets: difference from the first, in sd", columns, lines, remarks
    )


def _by_name(book: Logbook, run: LoggedRun) -> dict[str, Parameter]:
    return {p.name: p for p in book.numbers(run.name, "home")}


def _separation(parameter: Parameter, other: Parameter) -> str:
    deviation = normalised_difference(parameter, other)
    return f"{deviation:+.1f}" if math.isfinite(deviation) and deviation else "unobservable"


def runs_json(book: Logbook, runs: Sequence[LoggedRun]) -> View:
    """Return runs with their numbers."""
    return LOGBOOK.write({"runs": [_run(book, run) for run in runs]})


def compared_json(book: Logbook, runs: Sequence[LoggedRun]) -> View:
    """Return several runs, and how far each is from the first."""
    first = _by_name(book, runs[0])
    deviations = {
        run.name: {
            n: normalised_difference(p, first[n])
            for n, p in _by_name(book, run).items()
            if n in first
        }
        for run in runs[1:]
    }
    return RUNS_COMPARED.write({"runs": [_run(book, r) for r in runs], "sd_from_first": deviations})


def _run(book: Logbook, run: LoggedRun) -> View:
    return {
        "run": run,
        "parameters": book.numbers(run.name, "home"),
        "com_as_judged": book.numbers(run.name, "standing"),
    }
