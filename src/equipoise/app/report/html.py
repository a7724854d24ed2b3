"""A document as one HTML file that needs no other."""

import base64
from collections.abc import Iterable, Mapping, Sequence
from functools import singledispatch
from importlib.resources import files
from string import Template

from equipoise.app.text.blocks import (
    Block,
    Claim,
    Column,
    Document,
    Figure,
    Heading,
    Items,
    Moment,
    Pairs,
    Paragraph,
    Row,
    Section,
    Table,
)
from equipoise.app.text.escaping import for_html

Drawings = Mapping[str, bytes]  # SVG, by name
TEMPLATE = Template((files("equipoise.app.report") / "page.html").read_text(encoding="utf-8"))
CELL_STYLE = (files("equipoise.app.report") / "cell.css").read_text(encoding="utf-8").strip()


def html(document: Document, drawings: Drawings) -> str:
    """Return the file's text."""
    body = "\n".join(_section(section, drawings) for section in document.sections)
    title, platform = for_html(document.title), for_html(document.platform)
    return TEMPLATE.substitute(title=title, platform=platform, body=body)


def fragment(blocks: Iterable[Block]) -> str:
    """Return blocks without figures as a part of a page."""
    return "".join(map(_set, blocks))


def notebook_cell(blocks: Iterable[Block]) -> str:
    """Return blocks without figures as the result of a cell, with a style of its own."""
    return f'<div class="equipoise"><style>{CELL_STYLE}</style>{fragment(blocks)}</div>'


def _section(section: Section, drawings: Drawings) -> str:
    head = f"<h2>{for_html(section.title)}</h2>" if section.title else ""
    body = "".join(
        _figure(b, drawings[b.name]) if isinstance(b, Figure) else _set(b) for b in section.blocks
    )
    return f"<section>{head}{body}</section>"


def _figure(figure: Figure, drawing: bytes) -> str:
    data = base64.b64encode(drawing).decode()
    source = f'<img alt="{for_html(figure.name)}" src="data:image/svg+xml;base64,{data}">'
    return f"<figure>{source}<figcaption>{for_html(figure.caption)}</figcaption></figure>"


@singledispatch
def _set(block: Block) -> str:
    raise TypeError(type(block))


@_set.register
def _(block: Heading) -> str:
    return f"<h3>{for_html(block.text)}</h3>"


@_set.register
def _(block: Paragraph) -> str:
    tone = "" if block.tone == "plain" else f' class="{block.tone}"'
    return f"<p{tone}>{for_html(block.text)}</p>"


@_set.register
def _(block: Claim) -> str:
    return f'<p class="verdict {block.tone}">{for_html(block.text)}</p>'


@_set.register
def _(block: Items) -> str:
    lines = (f'<li class="{item.tone}">{for_html(item.text)}</li>' for item in block.items)
    return f"<ul>{''.join(lines)}</ul>"


@_set.register
def _(block: Pairs) -> str:
    pairs = (f"<dt>{for_html(k)}</dt><dd>{for_html(v)}</dd>" for k, v in block.pairs)
    return f"<dl>{''.join(pairs)}</dl>"


@_set.register
def _(block: Moment) -> str:
    when, what = f"<time>{for_html(block.time)}</time>", f"<b>{for_html(block.what)}</b>"
    return f'<div class="moment">{when}{what}<span>{for_html(block.text)}</span></div>'


@_set.register
def _(block: Table) -> str:
    title = f"<h3>{for_html(block.title)}</h3>" if block.title else ""
    notes = "".join(f'<p class="note">{for_html(note)}</p>' for note in block.notes)
    return title + (_grid(block) if block.rows else "") + notes


def _grid(block: Table) -> str:
    body = "".join(_row(row, block.columns) for row in block.rows)
    return f'<div class="wide"><table>{_head(block.columns)}<tbody>{body}</tbody></table></div>'


def _head(columns: Sequence[Column]) -> str:
    if not any(column.title for column in columns):
        return ""
    cells = (f"<th{_kind(column)}>{for_html(column.title)}</th>" for column in columns)
    return f"<thead><tr>{''.join(cells)}</tr></thead>"


def _row(row: Row, columns: Sequence[Column]) -> str:
    pairs = zip(row.cells, columns, strict=True)
    cells = (f"<td{_kind(column)}>{_lines(cell)}</td>" for cell, column in pairs)
    tone = "" if row.tone == "plain" else f' class="{row.tone}"'
    return f"<tr{tone}>{''.join(cells)}</tr>"


def _kind(column: Column) -> str:
    kind = "fold" if column.fold else "right" if column.align == "right" else ""
    return f' class="{kind}"' if kind else ""


def _lines(text: str) -> str:
    return "<br>".join(map(for_html, text.split("\n")))
