"""Rows of devices whose units report at their own times."""

import numpy as np
import pytest

from equipoise.hardware.links.device_rows import DeviceRows
from equipoise.model.devices import JetPair, Magnetorquer, ReactionWheel

X = np.array([1.0, 0.0, 0.0])
WHEEL = ReactionWheel("w", X, 1e-4, 500.0, 0.005, speed=7.0)
COIL = Magnetorquer("m", X, 0.4)
JET = JetPair("j", X, 0.05)


def test_a_row_waits_for_every_unit_and_lies_on_the_line_between_reports():
    """The wheel at 0.00 and 0.04 s, the coil at 0.01 and 0.03: rows at 0.01 (the base) and 0.03."""
    rows = DeviceRows((WHEEL, COIL), (("w",), ("m",)))
    rows.reported(0, 0.0, [10.0])
    rows.reported(1, 0.01, [0.1])
    assert rows.rows() == []
    rows.reported(0, 0.04, [14.0])
    assert rows.rows() == []  # the first row is what the next one's means count from
    rows.reported(1, 0.03, [0.3])
    ((t, values),) = rows.rows()
    assert t == 0.03
    assert values == pytest.approx([13.0, 0.3])
    rows.reported(1, 0.05, [0.3])
    ((t, values),) = rows.rows()
    assert (t, values[0]) == (0.04, pytest.approx(14.0))


def test_a_jet_has_the_mean_since_the_row_before_and_no_impulse_is_lost():
    """A total of 2 mN m s comes within rows of another unit, and reports of both are left out."""
    rows, found = DeviceRows((COIL, JET), (("m",), ("j",))), []
    rng = np.random.default_rng(2)
    total = 0.0
    rows.reported(0, 0.0, [0.0])
    rows.reported(1, 0.0, [0.0])
    for k in range(1, 400):
        if rng.random() < 0.1:
            total += 0.002 * rng.choice([-1.0, 1.0])
        if rng.random() < 0.8:
            rows.reported(0, 0.0203 * k, [0.0])
        if rng.random() < 0.8:
            rows.reported(1, 0.02 * k + 0.003, [total])
            last = total
        found += rows.rows()
    rows.reported(0, 100.0, [0.0])
    rows.reported(1, 100.0, [last])
    found += rows.rows()
    t = np.array([when for when, _ in found])
    assert np.all(np.diff(t) > 0)
    since = np.diff(t, prepend=0.0)
    impulse = float(np.sum(since * np.array([values[1] for _, values in found])))
    assert impulse == pytest.approx(last, abs=1e-12)
    assert abs(last) > 0.005


def test_a_device_that_no_unit_drives_stays_as_it_is_at_the_start():
    rows = DeviceRows((WHEEL, COIL), (("m",),))
    for k in range(3):
        rows.reported(0, 0.02 * k, [0.2])
    assert [values.tolist() for _, values in rows.rows()] == [[7.0, 0.2], [7.0, 0.2]]


def test_counts_that_began_anew_are_no_impulse():
    rows = DeviceRows((JET,), (("j",),))
    for k in range(3):
        rows.reported(0, 0.02 * k, [0.5])
    assert len(rows.rows()) == 2
    rows.begin()
    for k in range(10, 13):
        rows.reported(0, 0.02 * k, [0.0])
    assert [values.tolist() for _, values in rows.rows()] == [[0.0], [0.0]]


def test_a_report_that_is_no_later_than_the_one_before_is_dropped():
    rows = DeviceRows((COIL,), (("m",),))
    for t, value in ((0.0, 0.1), (0.02, 0.2), (0.02, 0.3), (0.01, 0.4), (0.04, 0.2)):
        rows.reported(0, t, [value])
    assert [t for t, _ in rows.rows()] == [0.02, 0.04]
