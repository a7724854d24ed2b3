"""Gyro and accelerometer of a table without an attitude: MuJoCo's, in any order, sign and unit."""

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.assessment.hypotheses.gyros import ORDERS, SIGNS
from equipoise.assessment.hypotheses.inertial_unit import inertial_unit
from equipoise.assessment.hypotheses.number_table import NumberTable
from equipoise.model.units import DEG, G0
from tests.oracle.vector_records import MPU6050, case
from tests.support import thorough

SECONDS = 40.0
NAMES = ("ms", "ax", "ay", "az", "gx", "gy", "gz")
COUNT, RATE = G0 / 16384, DEG / 131  # of an MPU6050


@pytest.fixture(scope="module")
def rows():
    """Return time (s), specific force (m/s^2) and rate (rad/s) of an IMU, with noise and zeros."""
    record = case(3, MPU6050, SECONDS).recording
    return np.column_stack([record.rate.t, record.accelerometer.values, record.rate.values])


def table(rows, order=(0, 1, 2), signs=(1, 1, 1), names=NAMES):
    """Return rows as counts; axis k of the gyro is ``signs[k]`` times column ``order[k]``."""
    rates = np.empty((len(rows), 3))
    rates[:, order] = rows[:, 4:] * np.array(signs)
    counts = np.round(np.column_stack([rows[:, 1:4] / COUNT, rates / RATE]))
    return NumberTable(names, np.column_stack([np.round(1e3 * rows[:, 0]), counts]))


EVERY = [(order, signs) for order in ORDERS for signs in SIGNS]


@pytest.mark.parametrize(("order", "signs"), thorough.some(EVERY, 12))
def test_order_signs_and_factors_are_found_by_how_gravity_turns(rows, order, signs):
    unit = inertial_unit(table(rows, order, signs))
    assert unit.gyro.columns == tuple(f"g{'xyz'[k]}" for k in order)
    assert unit.gyro.signs == signs
    assert unit.gyro.factor == pytest.approx(RATE, rel=1e-12)
    assert unit.accelerometer.factor == pytest.approx(COUNT, rel=1e-12)
    assert (unit.clock.column, unit.clock.unit, unit.up) == ("ms", "ms", "z")


def test_a_gyro_of_another_platform_is_none(rows):
    other = case(4, MPU6050, SECONDS).recording
    mixed = np.column_stack([rows[:, :4], other.rate.values])
    assert inertial_unit(table(mixed)) is None


def test_a_platform_at_rest_shows_no_gyro(rows):
    rng = np.random.default_rng(1)
    still = np.array([0.1, 0.2, 9.8, 0.0, 0.0, 0.0]) + rng.normal(0.0, 0.01, (len(rows), 6))
    assert inertial_unit(table(np.column_stack([rows[:, 0], still]))) is None


@pytest.mark.parametrize("names", [
    ("ms", "c1", "c2", "c3", "gx", "gy", "gz"),
    ("ms", "ax", "ay", "az", "gx", "gy", "rate_y"),
])  # fmt: skip
def test_columns_without_their_names_are_left_alone(rows, names):
    assert inertial_unit(table(rows, names=names)) is None
