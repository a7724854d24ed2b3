"""The sparkline's letters and columns, worked by hand."""

import pytest

from equipoise.app.text.sparkline import BLOCKS, PLAIN, in_columns, sparkline


def test_letters_go_in_eighths_from_zero_to_the_greatest():
    assert sparkline([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]) == "▁▂▃▄▅▆▇██"
    assert sparkline([4.0, 0.0, 2.0]) == "█▁▅"


def test_plain_letters_mean_the_same():
    assert sparkline([4.0, 0.0, 2.0], PLAIN) == "#_="
    assert len(PLAIN) == len(BLOCKS)
    assert PLAIN.isascii()


def test_what_is_not_known_is_blank_and_nothing_at_all_is_no_letter():
    assert sparkline([2.0, None, 1.0]) == "█ ▅"
    assert sparkline([None]) == " "
    assert sparkline([]) == ""


def test_a_platform_that_stands_level_is_a_low_line():
    assert sparkline([0.0, 0.0]) == "▁▁"


def test_each_second_has_a_column_where_there_is_room():
    assert in_columns({7: 1.0, 8: 3.0, 10: 2.0}, 60, 60) == ([1.0, 3.0, None, 2.0], 4)


def test_narrow_columns_hold_the_greatest_of_whole_seconds():
    """Of 3 s each: 7 and 8 in one that begins at 6, 10 in the next, which begins at 9."""
    assert in_columns({7: 1.0, 8: 3.0, 10: 2.0}, 60, 20) == ([3.0, 2.0], 6)


def test_a_column_stays_what_it_was_while_time_goes_on():
    observed = {second: float(second % 7) for second in range(100)}
    early, _ = in_columns({s: v for s, v in observed.items() if s < 90}, 60, 20)
    late, _ = in_columns(observed, 60, 20)
    assert early[4:] == late[:-4]  # the newest begin at 87 s and at 99 s


@pytest.mark.parametrize("width", [-5, 0, 1, 7, 20, 59, 60, 200])
def test_no_more_columns_than_there_is_room_for_and_no_more_than_the_span(width):
    columns, seconds = in_columns({second: 1.0 for second in range(500)}, 60, width)
    assert 1 <= len(columns) <= max(min(width, 60), 1)
    assert seconds <= 60


def test_nothing_known_has_no_columns():
    assert in_columns({}, 60, 60) == ([], 0)
