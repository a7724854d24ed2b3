"""Sphinx extension: `docs/NAME.md` in code type becomes a link to that page.

Pages name each other by their paths in the repository, which a reader of the repository can open.
"""

import re
from typing import Any

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.transforms import SphinxTransform

from docs.site.gathered import FROM_ROOT

NAMED = re.compile(r"docs/([\w./-]+)\.md")


def page_named(text: str) -> str | None:
    """Return the page of the site that a path in the repository stands for."""
    if text in FROM_ROOT:
        return FROM_ROOT[text].removesuffix(".md")
    found = NAMED.fullmatch(text)
    return found[1] if found else None


class LinkedNames(SphinxTransform):
    """Wraps each name of a page, unless it is part of a link already."""

    default_priority = 500

    def apply(self, **_: Any) -> None:
        """Replace the names in one page."""
        pages = self.env.found_docs
        for name in list(self.document.findall(nodes.literal)):
            page = page_named(name.astext())
            inside = isinstance(name.parent, nodes.reference | pending_xref)
            if page in pages and page != self.env.docname and not inside:
                link = pending_xref(
                    "", name.deepcopy(), refdomain="std", reftype="doc", reftarget=f"/{page}",
                    refdoc=self.env.docname, refexplicit=True, refwarn=True,
                )  # fmt: skip
                name.replace_self(link)


def setup(app: Any) -> dict[str, bool]:
    """Tell Sphinx."""
    app.add_transform(LinkedNames)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
