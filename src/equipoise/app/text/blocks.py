"""A result as blocks that terminal, HTML and PDF set alike: texts and names of figures, no layout.

Numbers come as texts, formatted once; a renderer adds none and rounds none.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Literal, TypeVar

from pydantic import Field, TypeAdapter, ValidationError

from equipoise.app.text.charts import Chart, Heatmap, Replay
from equipoise.app.text.escaping import for_json
from equipoise.app.text.numbers import typeset
from equipoise.model.errors import InputError

SCHEMA = "equipoise/report/1"
Record = TypeVar("Record")

Tone = Literal["plain", "good", "bad", "caution", "quiet"]  # how a medium is to set it off


@dataclass(frozen=True, slots=True)
class Heading:
    """A title within a section."""

    text: str
    kind: Literal["heading"] = "heading"


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A few sentences."""

    text: str
    tone: Tone = "plain"
    kind: Literal["paragraph"] = "paragraph"


@dataclass(frozen=True, slots=True)
class Claim:
    """The sentence that counts, good news or bad."""

    text: str
    tone: Tone = "plain"
    kind: Literal["claim"] = "claim"


@dataclass(frozen=True, slots=True)
class Item:
    """One sentence of several."""

    text: str
    tone: Tone = "plain"


@dataclass(frozen=True, slots=True)
class Items:
    """Sentences, one below the other, each with the mark of its tone."""

    items: tuple[Item, ...]
    kind: Literal["items"] = "items"


@dataclass(frozen=True, slots=True)
class Pairs:
    """Names and what belongs to them."""

    pairs: tuple[tuple[str, str], ...]
    kind: Literal["pairs"] = "pairs"


@dataclass(frozen=True, slots=True)
class Column:
    """What stands in a column; without a unit its values have none, or each row has its own."""

    heading: str = ""
    unit: str = ""
    align: Literal["left", "right"] = "left"
    fold: bool = False  # long texts, which may be broken into lines

    @property
    def title(self) -> str:
        """Heading and unit as one text."""
        return ", ".join(filter(None, (self.heading, self.unit)))


@dataclass(frozen=True, slots=True)
class Row:
    """The texts of a row, one for each column."""

    cells: tuple[str, ...]
    tone: Tone = "plain"


@dataclass(frozen=True, slots=True)
class Table:
    """A table under its title; notes stand below it. The first column names the rows."""

    title: str
    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    notes: tuple[str, ...] = ()
    kind: Literal["table"] = "table"


@dataclass(frozen=True, slots=True)
class Moment:
    """A step of a procedure: when, what, and what came of it."""

    time: str
    what: str
    text: str
    kind: Literal["moment"] = "moment"


@dataclass(frozen=True, slots=True)
class Figure:
    """A figure, by the name of its file, and its caption."""

    name: str
    caption: str
    kind: Literal["figure"] = "figure"


Block = (
    Heading | Paragraph | Claim | Items | Pairs | Table | Moment | Figure | Chart | Replay | Heatmap
)
Blocks = tuple[Block, ...]


@dataclass(frozen=True, slots=True)
class Section:
    """What stands below one title; without a title, what comes before the first."""

    title: str
    blocks: tuple[Annotated[Block, Field(discriminator="kind")], ...]


@dataclass(frozen=True, slots=True)
class Document:
    """A whole report."""

    title: str
    platform: str
    sections: tuple[Section, ...]
    schema: Literal["equipoise/report/1"] = SCHEMA

    @property
    def figures(self) -> tuple[str, ...]:
        """Names of all figures, in their order."""
        blocks = (block for section in self.sections for block in section.blocks)
        return tuple(
            block.name
            for block in blocks
            if isinstance(block, Figure) or (isinstance(block, Chart) and block.drawing)
        )


def number(heading: str, unit: str = "") -> Column:
    """Return a column of numbers."""
    return Column(heading, unit, "right")


def prose(heading: str = "") -> Column:
    """Return a column of long texts."""
    return Column(heading, fold=True)


def table(
    title: str,
    columns: Iterable[Column],
    rows: Iterable[Row | Sequence[str]],
    notes: Iterable[str] = (),
) -> Table:
    """Return a table; rows without a tone may come as texts alone."""
    made = (row if isinstance(row, Row) else Row(tuple(row)) for row in rows)
    return Table(title, tuple(columns), tuple(made), tuple(notes))


def tabulated(
    title: str,
    records: Iterable[Record],
    *cells: tuple[Column, Callable[[Record], str]],
    notes: Iterable[str] = (),
) -> Table:
    """Return a table with a row a record; beside each column stands what it shows of one."""
    rows = ([text(record) for _, text in cells] for record in records)
    return table(title, (column for column, _ in cells), rows, notes)


def items(texts: Iterable[str], tone: Tone = "plain") -> Blocks:
    """Return sentences of one tone as a list; nothing where there are none."""
    found = tuple(Item(text, tone) for text in texts)
    return (Items(found),) if found else ()


def sentences(blocks: Iterable[Block]) -> Iterator[str]:
    """Yield the texts of claims, headings and items, in their order."""
    for block in blocks:
        if isinstance(block, Claim | Heading):
            yield block.text
        elif isinstance(block, Items):
            yield from (item.text for item in block.items)


def paragraphs(*texts: str) -> Blocks:
    """Return a paragraph for each text that is not empty."""
    return tuple(Paragraph(text) for text in texts if text)


def printed(document: Document) -> Document:
    """Return a document whose tables have units as a printed page has them."""
    return replace(document, sections=tuple(map(_printed_section, document.sections)))


def _printed_section(section: Section) -> Section:
    blocks = (_printed_table(b) if isinstance(b, Table) else b for b in section.blocks)
    return replace(section, blocks=tuple(blocks))


def _printed_table(block: Table) -> Table:
    columns = (replace(column, unit=typeset(column.unit)) for column in block.columns)
    rows = (replace(row, cells=tuple(map(typeset, row.cells))) for row in block.rows)
    return replace(block, columns=tuple(columns), rows=tuple(rows))


_DOCUMENT = TypeAdapter(Document)


def text_of_document(document: Document) -> str:
    """Return a document as JSON."""
    return for_json(_DOCUMENT.dump_json(document, indent=1).decode())


def document_of_text(text: str | bytes, source: str) -> Document:
    """Return the document that a JSON text holds. Raises InputError with what is wrong."""
    try:
        return _DOCUMENT.validate_json(text)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"])) or "the document"
        raise InputError(f"{source}: {where}", first["msg"], f"a report, {SCHEMA}") from error
