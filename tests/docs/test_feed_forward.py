"""The C header and the table of fields are those that the sender packs by."""

from equipoise.io.stream.c_header import header, table
from tests.support.write_feed_forward import FILE, PAGE, table_on


def test_the_header_that_ships_is_that_of_the_fields():
    assert FILE.read_text(encoding="utf-8") == header()


def test_the_table_of_the_page_is_that_of_the_fields():
    assert table_on(PAGE.read_text(encoding="utf-8")) == table().strip()
