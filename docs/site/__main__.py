"""`python -m docs.site FOLDER`: gather the pages, draw the gallery, and build the site.

Pages are gathered in FOLDER-pages. Words after FOLDER go to Sphinx. Exit code: that of Sphinx; a
warning is an error.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

import jaxtyping  # noqa: F401  first: signatures then have the shapes of arrays
from sphinx.cmd.build import main as build

from docs.site.gathered import DOCS
from docs.site.pages import write_pages


def main(words: Sequence[str]) -> int:
    """Build the site into the folder that is named first."""
    if not words:
        sys.exit("python -m docs.site FOLDER: name the folder to build into")
    folder = Path(words[0])
    pages = folder.with_name(folder.name + "-pages")
    write_pages(pages)
    strict = ["--fail-on-warning", "--keep-going", "--quiet"]
    return build([*strict, "-c", str(DOCS), str(pages), str(folder), *words[1:]])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
