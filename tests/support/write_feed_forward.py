"""The C header that ships and its page's table: python -m tests.support.write_feed_forward."""

from pathlib import Path

from equipoise.io.stream.c_header import HEADER, header, table

DOCS = Path(__file__).parents[2] / "docs"
PAGE, FILE = DOCS / "feed-forward.md", DOCS / "feed-forward" / HEADER
BEGIN = "<!-- fields: written by `python -m tests.support.write_feed_forward` -->"
END = "<!-- end of fields -->"


def table_on(page: str) -> str:
    """Return the table that a page has now."""
    return page.partition(BEGIN)[2].partition(END)[0].strip()


def with_table(page: str) -> str:
    """Return a page with the table as the fields have it."""
    before, _, rest = page.partition(BEGIN)
    return f"{before}{BEGIN}\n\n{table()}\n{END}{rest.partition(END)[2]}"


if __name__ == "__main__":
    FILE.write_text(header(), encoding="utf-8")
    PAGE.write_text(with_table(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
