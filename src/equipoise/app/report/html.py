"""A document as one HTML file that needs no other."""

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import singledispatch
from importlib.resources import files
from string import Template
from urllib.parse import quote

from equipoise.app.report import scripts
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
from equipoise.app.text.charts import Chart, Heatmap, Replay
from equipoise.app.text.escaping import for_html
from equipoise.app.text.still import correlation, course_table

Drawings = Mapping[str, bytes]  # SVG, by name
PLAIN = ' !"$()*+,-./:;<=>?@[]^_`{|}~'  # letters of a data: address that stand for themselves
PATH, LONG = re.compile(rb' d="[^"]*"'), re.compile(rb"(\.\d\d)\d+")
TEMPLATE = Template((files("equipoise.app.report") / "page.html").read_text(encoding="utf-8"))
CELL_STYLE = (files("equipoise.app.report") / "cell.css").read_text(encoding="utf-8").strip()


def html(document: Document, drawings: Drawings) -> str:
    """Return the file's text."""
    body = "\n".join(_section(section, drawings) for section in document.sections)
    title, platform = for_html(document.title), for_html(document.platform)
    modules = scripts.packed(document)
    if modules is None:
        body = f'<p class="note">{for_html(scripts.STILL)}</p>\n{body}'
    return TEMPLATE.substitute(
        title=title,
        platform=platform,
        style=scripts.style(),
        body=body,
        scripts=_scripts(modules) if modules else "",
    )


def _scripts(modules: str) -> str:
    data = f'<script type="application/octet-stream" id="modules">{modules}</script>'
    return f"{data}\n<script>\n{scripts.loader()}</script>"


def fragment(blocks: Iterable[Block]) -> str:
    """Return blocks without figures as a part of a page."""
    return "".join(map(_set, blocks))


def notebook_cell(blocks: Iterable[Block]) -> str:
    """Return blocks without figures as the result of a cell, with a style of its own."""
    return f'<div class="equipoise"><style>{CELL_STYLE}</style>{fragment(blocks)}</div>'


def _section(section: Section, drawings: Drawings) -> str:
    head = f"<h2>{for_html(section.title)}</h2>" if section.title else ""
    body = "".join(_block(block, drawings) for block in section.blocks)
    return f"<section>{head}{body}</section>"


def _block(block: Block, drawings: Drawings) -> str:
    if isinstance(block, Figure):
        caption = f"<figcaption>{for_html(block.caption)}</figcaption>"
        return f"<figure>{_drawn(block.name, drawings[block.name])}{caption}</figure>"
    if isinstance(block, Chart) and block.drawing:
        return _live(block, _drawn(block.name, drawings[block.name]), block.drawing)
    return _live(block) if isinstance(block, Chart | Replay) else _set(block)


def _live(block: Chart | Replay, drawn: str = "", still: str = "") -> str:
    """Return the place that scripts fill, with what stands there without them: a drawing, or none.

    Chart and drawing each have their caption.
    """
    caption = f'<span class="of-chart">{for_html(block.caption)}</span>'
    if drawn:
        caption += f'<span class="of-drawing">{for_html(still)}</span>'
    named = f'data-kind="{block.kind}" data-name="{for_html(block.name)}"'
    hidden = "" if drawn else " hidden"
    return (
        f'<figure {named}{hidden}><div class="live" hidden></div>{drawn}'
        f"<figcaption>{caption}</figcaption></figure>"
    )


def _drawn(name: str, drawing: bytes) -> str:
    """Return an SVG as a picture, its paths to a hundredth of a point.

    Addresses lose line ends: blanks stand in their place.
    """
    short = PATH.sub(lambda path: LONG.sub(rb"\1", path[0]), drawing)
    data = quote(short.replace(b"\n", b" "), safe=PLAIN)
    return f"<img alt=\"{for_html(name)}\" src='data:image/svg+xml,{data}'>"


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
def _(block: Chart) -> str:
    return _set(course_table(block))


@_set.register
def _(block: Heatmap) -> str:
    heads = "".join(f'<th scope="col">{k}</th>' for k in range(1, len(block.names) + 1))
    rows = zip(block.names, block.values, strict=True)
    body = "".join(
        f'<tr><th scope="row">{k} {for_html(name)}</th>{"".join(map(_correlation, values))}</tr>'
        for k, (name, values) in enumerate(rows, 1)
    )
    note = f'<p class="note">{for_html(block.note)}</p>' if block.note else ""
    return (
        f'<div class="wide" tabindex="0"><table class="heat"><caption>{for_html(block.title)}'
        f"</caption><thead><tr><td></td>{heads}</tr></thead><tbody>{body}</tbody></table></div>{note}"
    )


def _correlation(value: float | None) -> str:
    if value is None:
        return "<td></td>"
    sign, share = "plus" if value > 0 else "minus", f"{abs(value):.0%}"
    return f'<td class="{sign}" style="--share:{share}">{correlation(value)}</td>'


@_set.register
def _(block: Table) -> str:
    notes = "".join(f'<p class="note">{for_html(note)}</p>' for note in block.notes)
    if block.rows:
        return _grid(block) + notes
    return (f"<h3>{for_html(block.title)}</h3>" if block.title else "") + notes


def _grid(block: Table) -> str:
    title = f"<caption>{for_html(block.title)}</caption>" if block.title else ""
    body = "".join(_row(row, block.columns) for row in block.rows)
    head = _head(block.columns)
    table = f"<table>{title}{head}<tbody>{body}</tbody></table>"
    return f'<div class="wide" tabindex="0">{table}</div>'


def _head(columns: Sequence[Column]) -> str:
    if not any(column.title for column in columns):
        return ""
    cells = (
        f'<th scope="col"{_kind(c)}>{for_html(c.title)}</th>' if c.title else "<td></td>"
        for c in columns
    )
    return f"<thead><tr>{''.join(cells)}</tr></thead>"


def _row(row: Row, columns: Sequence[Column]) -> str:
    """Return a row; its first cell names it."""
    pairs = list(zip(row.cells, columns, strict=True))
    first = "".join(f'<th scope="row"{_kind(c)}>{_lines(cell)}</th>' for cell, c in pairs[:1])
    cells = "".join(f"<td{_kind(column)}>{_lines(cell)}</td>" for cell, column in pairs[1:])
    tone = "" if row.tone == "plain" else f' class="{row.tone}"'
    return f"<tr{tone}>{first}{cells}</tr>"


def _kind(column: Column) -> str:
    kind = "fold" if column.fold else "right" if column.align == "right" else ""
    return f' class="{kind}"' if kind else ""


def _lines(text: str) -> str:
    return "<br>".join(map(for_html, text.split("\n")))
