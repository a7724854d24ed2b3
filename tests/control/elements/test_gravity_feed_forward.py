"""Gravity's torque ahead: numbers by hand, the one regressor, and differences."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.elements.gravity_feed_forward import (
    Ahead,
    Heavy,
    Moving,
    gravity_ahead,
    is_usable,
    sag_columns,
)
from equipoise.dynamics.regressor import MOMENT, SAG, TORQUE, WIDTH, regressor
from equipoise.maths.attitude import exponential, from_euler321, multiply
from equipoise.model.units import UM

LEVEL = np.array([1.0, 0.0, 0.0, 0.0])
STIFF = Heavy(4.0, 9.8, np.zeros(5), np.zeros((5, 5)))
SOFT = Heavy(14.0, 9.81, np.array([8.0, -3, 2, -5, 4]) * UM, np.diag([1.0, 2, 3, 4, 5]) * UM**2)


def moving(**other) -> Moving:
    """Return a platform at rest, its centre of mass 3 um aside along x and 50 um low."""
    at_rest = Moving(LEVEL, np.zeros(3), np.array([3.0, 0, -50]) * UM, np.zeros(3),
                     np.zeros((12, 12)))  # fmt: skip
    return replace(at_rest, **other)


def test_a_level_platform_is_turned_by_its_sideways_offset_alone():
    """4 kg, 3 um: m r = 12e-6 kg m along x, gravity 9.8 along -z, torque 1.176e-4 N m about y."""
    found = gravity_ahead(moving(), STIFF, 0.0)
    assert found.first_moment == pytest.approx([12e-6, 0, -200e-6])
    assert found.gravity == pytest.approx([0, 0, -9.8])
    assert found.torque == pytest.approx([0, 1.176e-4, 0])


def test_a_platform_turns_on_until_then():
    """Rolled by 0.1 rad/s for 2 s: it hangs 50 um low, so that gravity turns it back."""
    com = np.array([0.0, 0, -50]) * UM
    found = gravity_ahead(moving(com=com, rate=np.array([0.1, 0, 0])), STIFF, 2.0)
    at_rest = gravity_ahead(moving(com=com, q=from_euler321(0.2, 0.0, 0.0)), STIFF, 0.0)
    assert found.torque == pytest.approx(at_rest.torque)
    assert found.torque == pytest.approx([-4 * 9.8 * 50e-6 * np.sin(0.2), 0, 0])


def test_its_centre_of_mass_drifts_on_until_then():
    found = gravity_ahead(moving(drift=np.array([0.5, 0, 0]) * UM), STIFF, 4.0)
    assert found.first_moment == pytest.approx([4 * 5e-6, 0, -200e-6])


def test_the_torque_is_that_of_the_one_regressor():
    """Columns of the first moment and of sag, times m r and the five terms."""
    q = from_euler321(0.3, -0.2, 0.5)
    found = gravity_ahead(moving(q=q), SOFT, 0.0)
    columns = np.zeros((3, WIDTH))
    regressor((0.0, 0.0, 0.0), tuple(map(float, found.gravity)), 0.0, 0.0, 14.0, 9.81, True,
              columns)  # fmt: skip
    rigid = columns[:, MOMENT : MOMENT + 3] @ (14.0 * np.array([3.0, 0, -50]) * UM)
    sagging = columns[:, TORQUE + SAG : TORQUE + SAG + 5] @ SOFT.sag
    assert np.linalg.norm(sagging) > 0.1 * np.linalg.norm(rigid)
    assert found.torque == pytest.approx(rigid + sagging, rel=1e-12)


def test_the_covariance_is_that_of_differences():
    """Attitude, rate, com, drift and the terms of the sag, each changed a little."""
    rng, lead = np.random.default_rng(5), 0.7
    root = rng.normal(size=(12, 12)) * np.repeat([1e-3, 1e-3, 1e-6, 1e-8], 3)[:, None]
    now = moving(q=from_euler321(0.3, -0.2, 0.5), covariance=root @ root.T)

    def at(state, sag):
        changed = replace(now, q=multiply(now.q, exponential(state[:3])),
                          rate=now.rate + state[3:6], com=now.com + state[6:9],
                          drift=now.drift + state[9:])  # fmt: skip
        found = gravity_ahead(changed, replace(SOFT, sag=SOFT.sag + sag), lead)
        return np.concatenate([found.torque, found.first_moment])

    scale = np.concatenate([np.full(6, 1e-4), np.full(6, 1e-6), np.full(5, 1e-6)])
    J = np.column_stack([
        (at(step[:12], step[12:]) - at(-step[:12], -step[12:])) / (2 * size)
        for step, size in zip(np.diag(scale), scale, strict=True)
    ])  # fmt: skip
    whole = np.zeros((17, 17))
    whole[:12, :12], whole[12:, 12:] = now.covariance, SOFT.sag_covariance
    expected, found = J @ whole @ J.T, gravity_ahead(now, SOFT, lead)
    for block, covariance in ((slice(0, 3), found.torque_covariance),
                              (slice(3, 6), found.moment_covariance)):  # fmt: skip
        size = np.trace(covariance)
        assert covariance == pytest.approx(expected[block, block], rel=1e-5, abs=1e-5 * size)


def test_columns_of_the_sag_are_its_matrix_times_gravitys_direction():
    """C of xx = 1 alone is diag(1, 0, -1); of yz it swaps y and z."""
    n = np.array([1.0, 2.0, 3.0])
    assert sag_columns(n)[:, 0] == pytest.approx([1.0, 0.0, -3.0])
    assert sag_columns(n)[:, 4] == pytest.approx([0.0, 3.0, 2.0])


@pytest.mark.parametrize(
    ("torque", "sd", "usable"),
    [
        (0.0, 3.0, True),  # as well known as a balanced platform
        (0.0, 3.1, False),
        (20.0, 9.9, True),  # an error of less than half
        (20.0, 10.1, False),
        (5.0, 2.9, True),
    ],
)
def test_a_torque_is_usable_where_it_is_known_much_better_than_nothing(torque, sd, usable):
    """Both as a centre of mass sideways, um."""
    weight = STIFF.weight
    covariance = np.diag([0.5, 0.5, 0.0]) * (sd * UM * weight) ** 2
    torque_N_m = np.array([torque * UM * weight, 0, 0])
    ahead = Ahead(np.zeros(3), np.zeros(3), torque_N_m, np.zeros((3, 3)), covariance)
    assert is_usable(ahead, STIFF) is usable
