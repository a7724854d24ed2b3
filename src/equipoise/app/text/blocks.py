"""A report as blocks that any medium can set: texts and names of figures, no layout."""

from dataclasses import dataclass, replace
from typing import Annotated, Literal

from pydantic import Field, TypeAdapter, ValidationError

from equipoise.app.text.units import typeset
from equipoise.model.errors import InputError

SCHEMA = "equipoise/report/1"


@dataclass(frozen=True, slots=True)
class Heading:
    """A title within a section."""

    text: str
    kind: Literal["heading"] = "heading"


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A few sentences."""

    text: str
    kind: Literal["paragraph"] = "paragraph"


@dataclass(frozen=True, slots=True)
class Claim:
    """The sentence that counts: good news or bad."""

    text: str
    good: bool
    kind: Literal["claim"] = "claim"


@dataclass(frozen=True, slots=True)
class Items:
    """Sentences, one below the other."""

    texts: tuple[str, ...]
    kind: Literal["items"] = "items"


@dataclass(frozen=True, slots=True)
class Pairs:
    """Names and what belongs to them."""

    pairs: tuple[tuple[str, str], ...]
    kind: Literal["pairs"] = "pairs"


@dataclass(frozen=True, slots=True)
class Grid:
    """A table; columns of ``words`` may be folded."""

    heads: tuple[str, ...]
    lines: tuple[tuple[str, ...], ...]
    words: tuple[int, ...] = ()
    kind: Literal["grid"] = "grid"


@dataclass(frozen=True, slots=True)
class Moment:
    """A step of a procedure: when (s), what, and what came of it."""

    time: str
    what: str
    text: str
    kind: Literal["moment"] = "moment"


@dataclass(frozen=True, slots=True)
class Drawn:
    """A figure, by the name of its file, and its caption."""

    name: str
    caption: str
    kind: Literal["drawn"] = "drawn"


Block = Heading | Paragraph | Claim | Items | Pairs | Grid | Moment | Drawn


@dataclass(frozen=True, slots=True)
class Section:
    """What stands below one title; without a title, what comes before the first."""

    title: str
    blocks: tuple[Annotated[Block, Field(discriminator="kind")], ...]


@dataclass(frozen=True, slots=True)
class Page:
    """A whole report."""

    title: str
    platform: str
    sections: tuple[Section, ...]
    schema: Literal["equipoise/report/1"] = SCHEMA

    @property
    def figures(self) -> tuple[str, ...]:
        """Names of all figures, in their order."""
        blocks = (block for section in self.sections for block in section.blocks)
        return tuple(block.name for block in blocks if isinstance(block, Drawn))


def typeset_page(page: Page) -> Page:
    """Return a page whose tables have units as a printed page has them."""
    return replace(page, sections=tuple(map(_typeset, page.sections)))


def _typeset(section: Section) -> Section:
    blocks = (
        replace(b, lines=tuple(tuple(map(typeset, line)) for line in b.lines))
        if isinstance(b, Grid)
        else b
        for b in section.blocks
    )
    return replace(section, blocks=tuple(blocks))


_PAGE = TypeAdapter(Page)


def text_of_page(page: Page) -> str:
    """Return a page as a JSON document."""
    return _PAGE.dump_json(page, indent=1).decode()


def page_of_text(text: str | bytes, source: str) -> Page:
    """Return the page that a JSON document holds. Raises InputError with what is wrong."""
    try:
        return _PAGE.validate_json(text)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"])) or "the document"
        raise InputError(f"{source}: {where}", first["msg"], f"a report, {SCHEMA}") from error
