"""The picture and the table of ``docs/architecture.md`` are those of the code."""

import re
from pathlib import Path

from tests.support import rooms


def test_the_picture_of_the_rooms_equals_the_code():
    assert rooms.PICTURE.read_text(encoding="utf-8") == rooms.picture(), "run `make rooms`"


def test_the_table_of_the_rooms_equals_the_code():
    text = rooms.PAGE.read_text(encoding="utf-8")
    assert text == rooms.page(text), "run `make rooms`"


def test_the_text_of_every_room_stands_in_its_box():
    for room in rooms.rooms():
        _, top, _, height = rooms.box(room.name)
        lines = [
            int(y) for y in re.findall(r'<text x="\d+" y="(\d+)"', "".join(rooms.drawn_room(room)))
        ]
        assert max(lines) < top + height, room.name


def test_every_room_states_its_duty_in_one_sentence():
    duties = [room.duty for room in rooms.all_rooms(rooms.rooms())]
    assert [duty for duty in duties if not duty.endswith(".") or len(duty.split()) > 25] == []


def paths_in(page: Path) -> list[str]:
    """Return what stands in backticks and is a path of a source file; NEW.py stands for any."""
    return re.findall(
        r"`((?:[a-z_\d.-]+/)+[a-z_\d-]+\.(?:py|toml|js|md|typ))`", page.read_text("utf-8")
    )


def test_every_source_file_that_a_page_names_is_there():
    starts = ("", "src/equipoise", "docs", "tests")
    pages = [*(rooms.ROOT / "docs").rglob("*.md"), *rooms.ROOT.glob("*.md")]
    missing = [
        f"{page.relative_to(rooms.ROOT)}: {path}"
        for page in pages
        if page.name != "CHANGELOG.md"  # of former versions, too
        for path in paths_in(page)
        if not any((rooms.ROOT / start / path).exists() for start in starts)
    ]
    assert missing == []
