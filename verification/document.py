"""Results as a terminal table and as a page of the documentation."""

import platform
import re
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, version

from rich.table import Table
from rich.text import Text

from equipoise import __version__
from verification.result import Result, Row

MEASURED = re.compile(r"^Command: .*, (\d{4}-\d{2}-\d{2})\)\.$", re.MULTILINE)
# The sentences that it takes to say something; chosen: 80 letters.
BEGINNING = re.compile(r".{80,}?(?<!al)[.:](?=\s|$)", re.DOTALL)
HEADING = re.compile(r"^## (\w+)$", re.MULTILINE)
PACKAGES = ("numpy", "scipy", "numba", "mujoco")


def verdict_of(row: Row) -> str:
    """Return a row's verdict in a word."""
    return "yes" if row.ok else "NO"


def table_of(result: Result) -> Table:
    """Return a result as a table for the terminal."""
    table = Table(title=result.name, caption="\n".join(result.notes), caption_justify="left")
    for column in ("quantity", "found", "wanted", "ok"):
        table.add_column(column, overflow="fold")
    for row in result.rows:
        style = "green" if row.ok else "bold red"
        cells = (row.quantity, row.found, row.wanted)
        table.add_row(*map(Text, cells), Text(verdict_of(row), style=style))
    return table


def cell(text: str) -> str:
    """Return text as a cell of a Markdown table."""
    return text.replace("|", "\\|").replace("\n", " ")


def section(result: Result, command: str, seconds: float, date: str) -> str:
    """Return a result as a section of the page."""
    lines = [f"## {result.name}", "", result.claim, ""]
    if result.rows:
        lines += ["| quantity | found | wanted | ok |", "|---|---|---|---|"]
        lines += [
            f"| {cell(r.quantity)} | {cell(r.found)} | {cell(r.wanted)} | {verdict_of(r)} |"
            for r in result.rows
        ]
        lines.append("")
    lines += [line for note in result.notes for line in (note, "")]
    lines.append(f"Command: `{command}` ({seconds:.0f} s, {date}).")
    return "\n".join(lines)


def installed(package: str) -> str:
    """Return a package with its version."""
    try:
        return f"{package} {version(package)}"
    except PackageNotFoundError:
        return f"no {package}"


def versions() -> str:
    """Return what the numbers were made with."""
    python = f"Python {platform.python_version()}"
    others = ", ".join(installed(package) for package in PACKAGES)
    return f"Equipoise {__version__}, {python}, {others}, {platform.system()} {platform.machine()}"


def sections_of(text: str) -> dict[str, str]:
    """Return the sections of a page, by name."""
    places = list(HEADING.finditer(text))
    ends = [*(place.start() for place in places[1:]), len(text)]
    return {
        place[1]: text[place.start() : end].rstrip()
        for place, end in zip(places, ends, strict=True)
    }


def date_of(section: str) -> str:
    """Return the day on which a section was measured, as its command line states it."""
    return MEASURED.findall(section)[-1]


def claim_of(section: str) -> str:
    """Return what a section claims, of a long claim the first sentences."""
    claim = section.split("\n\n")[1]
    found = BEGINNING.match(claim)
    return (found[0] if found else claim).rstrip(".:") + "."


def missed_in(sections: str) -> tuple[int, int]:
    """Return how many numbers of some sections are not as wanted, and how many there are."""
    kept, missed = (sections.count(f"| {verdict} |\n") for verdict in ("yes", "NO"))
    return missed, kept + missed


def index_of(sections: Iterable[str]) -> str:
    """Return the list of sections: claim, numbers that are not as wanted, day of measurement."""
    rows = [
        f"| [{name}](#{name}) | {cell(claim_of(text))} | "
        f"{' of '.join(map(str, missed_in(text)))} | {date_of(text)} |"
        for name, text in sections_of("\n\n".join(sections)).items()
    ]
    return "\n".join(["| section | claim | not as wanted | measured |", "|---|---|---|---|", *rows])


def page(sections: Iterable[str]) -> str:
    """Return the whole page."""
    sections = tuple(sections)
    body = "\n\n".join(sections)
    missed, found = missed_in(body)
    head = (
        "# What was verified\n\nWritten by `make verify`; do not edit. Each section is one "
        "file of `verification/`, and says when it was measured. Tests in `tests/statistical` call "
        "the same functions with fewer seeds.\n\n"
        f"{versions()}. {found} numbers, {missed} not as wanted."
    )
    return f"{head}\n\n{index_of(sections)}\n\n{body}\n"
