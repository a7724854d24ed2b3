"""Sphinx extension: pages for people who use a keyboard or a screen reader.

Sphinx and Furo leave headings without a level, boxes that scroll but take no focus, and lists
without terms in long signatures. Each is mended in the HTML; axe-core finds none of them then.
"""

import re
from collections.abc import MutableMapping
from typing import Any

AFTER_FURO = 900  # its handler of the same event has the default priority, 500
TEXTS = ("body", "furo_navigation_tree")
MENDED = (
    ('<p class="caption" role="heading">', '<p class="caption" role="heading" aria-level="2">'),
    ("<pre>", '<pre tabindex="0">'),
    ('<div class="table-wrapper', '<div tabindex="0" class="table-wrapper'),
)
PARAMETERS = re.compile(r"<dl>\s*((?:<dd>(?:(?!</?d[dl]>).)*</dd>\s*)+)</dl>", re.DOTALL)


def mended(html: str) -> str:
    """Return the HTML of a page, or of a part of it, without these faults."""
    for fault, without in MENDED:
        html = html.replace(fault, without)
    return PARAMETERS.sub(_lines, html)


def _lines(found: re.Match[str]) -> str:
    """Return the parameters of a signature as lines instead of a list."""
    lines = found[1].replace("<dd>", '<span class="parameter">').replace("</dd>", "</span>")
    return f'<span class="parameters">{lines}</span>'


def mend(_app: Any, _page: str, _template: str, context: MutableMapping[str, Any], _: Any) -> None:
    """Mend the parts of a page before the theme puts them together."""
    for name in TEXTS:
        if context.get(name):
            context[name] = mended(context[name])


def setup(app: Any) -> dict[str, bool]:
    """Tell Sphinx."""
    app.connect("html-page-context", mend, priority=AFTER_FURO)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
