"""All pages of the site, in one folder from which Sphinx builds."""

from pathlib import Path

from docs.site.card_pages import card_pages
from docs.site.command_pages import command_pages
from docs.site.gallery import gallery
from docs.site.gathered import gathered, write_changed
from docs.site.python_pages import python_pages
from docs.site.schema_pages import schema_pages


def write_pages(folder: Path) -> None:
    """Leave the repository's pages and those made of the code in a folder."""
    written = {
        place: text.encode()
        for pages in (command_pages(), python_pages(), schema_pages(), card_pages())
        for place, text in pages
    }
    write_changed(folder, dict(gathered()) | written | dict(gallery()))
