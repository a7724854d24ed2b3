"""The newest of each channel, and the greatest tilt of each second of the last minute."""

import numpy as np
import pytest

from equipoise.app.live.latest_rows import SPAN, Newest, after, masses_of, tilt_of, time_of
from equipoise.model.recording import Recording, Samples

UP = np.array([0.0, 0.0, 1.0])


def leaning(t, degrees):
    """Rows of a platform that leans about x."""
    half = np.radians(np.broadcast_to(degrees, np.shape(t))) / 2
    zero = np.zeros_like(half)
    return Samples(np.asarray(t), np.column_stack([np.cos(half), np.sin(half), zero, zero]))


def test_the_last_row_of_each_channel_counts():
    rows = Recording(
        attitude=leaning([0.5, 1.5], [3.0, 2.0]),
        rate=Samples(np.array([1.0, 1.7]), np.array([[1.0, 0.0, 0.0], [0.0, 0.03, 0.04]])),
        mass_names=("x", "y"),
        masses=Samples(np.array([1.2]), np.array([[0.001, -0.0025]])),
    )
    known = after(Newest(), rows, UP)
    assert (time_of(known), tilt_of(known)) == ("     1.70 s", "tilt   2.00 deg")
    assert known.rate == pytest.approx(0.05)
    assert masses_of(known) == ["x    1.00 mm", "y   -2.50 mm"]
    assert known.counts == {"attitude": 2, "rate": 2, "masses": 1}
    assert {s: round(np.degrees(v), 9) for s, v in known.tilts.items()} == {0: 3.0, 1: 2.0}


def test_what_brings_nothing_new_changes_nothing():
    known = after(Newest(), Recording(attitude=leaning([1.5], 2.0)), UP)
    empty = Samples(np.zeros(0), np.zeros((0, 4)))
    for rows in (Recording(), Recording(attitude=empty)):
        again = after(known, rows, UP)
        assert (again.time, again.tilt, again.counts) == (1.5, known.tilt, {"attitude": 1})


def test_a_second_in_parts_keeps_its_greatest_tilt():
    known = Newest()
    for k, degrees in enumerate([1.0, 5.0, 2.0]):
        known = after(known, Recording(attitude=leaning([4.2 + 0.2 * k], degrees)), UP)
    assert np.degrees(known.tilts[4]) == pytest.approx(5.0)
    assert np.degrees(known.tilt) == pytest.approx(2.0)


def test_no_more_than_a_minute_is_kept_whatever_comes_at_once():
    t = np.arange(0.0, 1000.0, 0.1)
    at_once = after(Newest(), Recording(attitude=leaning(t, 1.0)), UP)
    in_parts = Newest()
    for part in np.split(t, 100):
        in_parts = after(in_parts, Recording(attitude=leaning(part, 1.0)), UP)
    assert list(in_parts.tilts) == list(at_once.tilts) == list(range(1000 - SPAN, 1000))
