"""A page as one HTML file that needs no other."""

import base64
from collections.abc import Iterable, Mapping, Sequence
from functools import partial, singledispatch
from html import escape
from importlib.resources import files
from string import Template

from equipoise.app.text.blocks import (
    Block,
    Claim,
    Drawn,
    Grid,
    Heading,
    Items,
    Moment,
    Page,
    Pairs,
    Paragraph,
    Section,
)

Images = Mapping[str, bytes]  # PNG, by name
TEMPLATE = Template((files("equipoise.app.report") / "page.html").read_text(encoding="utf-8"))


def html(page: Page, images: Images) -> str:
    """Return the file's text."""
    body = "\n".join(_section(section, images) for section in page.sections)
    title, platform = escape(page.title), escape(page.platform)
    return TEMPLATE.substitute(title=title, platform=platform, body=body)


def fragment(blocks: Iterable[Block]) -> str:
    """Return blocks without figures as a part of a page."""
    return "".join(map(_set, blocks))


def _section(section: Section, images: Images) -> str:
    head = f"<h2>{escape(section.title)}</h2>" if section.title else ""
    body = "".join(
        _figure(b, images[b.name]) if isinstance(b, Drawn) else _set(b) for b in section.blocks
    )
    return f"<section>{head}{body}</section>"


def _figure(drawn: Drawn, image: bytes) -> str:
    data = base64.b64encode(image).decode()
    source = f'<img alt="{escape(drawn.name)}" src="data:image/png;base64,{data}">'
    return f"<figure>{source}<figcaption>{escape(drawn.caption)}</figcaption></figure>"


@singledispatch
def _set(block: Block) -> str:
    raise TypeError(type(block))


@_set.register
def _(block: Heading) -> str:
    return f"<h3>{escape(block.text)}</h3>"


@_set.register
def _(block: Paragraph) -> str:
    return f"<p>{escape(block.text)}</p>"


@_set.register
def _(block: Claim) -> str:
    kind = "good" if block.good else "bad"
    return f'<p class="verdict {kind}">{escape(block.text)}</p>'


@_set.register
def _(block: Items) -> str:
    return "<ul>" + "".join(f"<li>{escape(text)}</li>" for text in block.texts) + "</ul>"


@_set.register
def _(block: Pairs) -> str:
    pairs = (f"<dt>{escape(k)}</dt><dd>{escape(v)}</dd>" for k, v in block.pairs)
    return f"<dl>{''.join(pairs)}</dl>"


@_set.register
def _(block: Moment) -> str:
    when, what = f"<time>{escape(block.time)}</time>", f"<b>{escape(block.what)}</b>"
    return f'<div class="moment">{when}{what}<span>{escape(block.text)}</span></div>'


@_set.register
def _(block: Grid) -> str:
    head = "".join(f"<th>{escape(h)}</th>" for h in block.heads) if any(block.heads) else ""
    body = "".join(map(partial(_line, words=block.words), block.lines))
    top = f"<thead><tr>{head}</tr></thead>" if head else ""
    return f'<div class="wide"><table>{top}<tbody>{body}</tbody></table></div>'


def _line(cells: Sequence[str], words: Sequence[int]) -> str:
    return "<tr>" + "".join(_cell(cell, k in words) for k, cell in enumerate(cells)) + "</tr>"


def _cell(text: str, words: bool) -> str:
    kind = ' class="words"' if words else ""
    return f"<td{kind}>{escape(text)}</td>"
