"""The picture and the table of ``docs/architecture.md`` are those of the code."""

from tests.support import rooms


def test_the_picture_of_the_rooms_equals_the_code():
    assert rooms.PICTURE.read_text(encoding="utf-8") == rooms.picture(), "run `make rooms`"


def test_the_table_of_the_rooms_equals_the_code():
    text = rooms.PAGE.read_text(encoding="utf-8")
    assert text == rooms.page(text), "run `make rooms`"


def test_every_room_states_its_duty_in_one_sentence():
    duties = [room.duty for room in rooms.all_rooms(rooms.rooms())]
    assert [duty for duty in duties if not duty.endswith(".") or len(duty.split()) > 25] == []
