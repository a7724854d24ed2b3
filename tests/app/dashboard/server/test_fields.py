"""Values that a page sends for a field, and what of them is taken."""

import pytest

from equipoise.app.dashboard.server.fields import flag_of, number_of, text_of
from equipoise.model.errors import InputError


@pytest.mark.parametrize(
    ("read", "raw", "found"),
    [
        (flag_of, "yes", "found 'yes'"),
        (flag_of, 1, "found 1"),
        (number_of, "1e999", "found '1e999'"),
        (number_of, True, "found True"),
        (text_of, 5, "found 5"),
    ],
)
def test_a_value_of_another_kind_is_refused_as_it_was_found(read, raw, found):
    with pytest.raises(InputError, match=found):
        read(raw)


def test_values_of_their_kind_are_taken_as_they_are():
    assert [flag_of(False), number_of(" 2.5 "), number_of(""), text_of(None)] == [
        False,
        2.5,
        None,
        "",
    ]
