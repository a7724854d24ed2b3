"""Pulses by hand; a pulse too short to be made is reported, not made."""

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.actuators.jets import on_platform, pulses_for
from equipoise.model.devices import JetPair

impulses = arrays(np.float64, 3, elements=st.floats(-0.05, 0.05))


def jets(axes=((1, 0, 0), (0, 1, 0), (0, 0, 1)), shortest=0.02):
    plain = JetPair("j", np.zeros(3), 0.1, shortest)
    return tuple(
        replace(plain, name=f"j{i}", axis=np.asarray(a, float)) for i, a in enumerate(axes)
    )


def test_impulse_by_hand():
    """0.1 N m for 0.2 s about x, 0.05 s the other way about z."""
    found = on_platform(jets(), np.array([0.02, 0.0, -0.005]))
    np.testing.assert_allclose(found, [0.02, 0, -0.005])


def test_short_pulses_are_left_over():
    """0.1 N m for 20 ms at least: 2e-3 N m s is made, 1.9e-3 is not."""
    found = pulses_for(jets(), np.array([2.0e-3, -1.9e-3, 0.01]))
    np.testing.assert_allclose(found.impulses, [2e-3, 0.0, 0.01])
    np.testing.assert_allclose(found.left, [0.0, -1.9e-3, 0.0], atol=1e-18)


@given(impulses)
def test_made_and_left_are_what_was_wanted(wanted):
    """Of skew jets too; no pulse is shorter than it may be; little is left."""
    for axes in (np.eye(3), [[1, 0, 0], [0.6, 0.8, 0], [0, 0.6, 0.8], [0, 0, -1.0]]):
        some = jets(axes)
        made, left = pulses_for(some, wanted)
        np.testing.assert_allclose(on_platform(some, made) + left, wanted, atol=1e-16)
        assert np.all((made == 0) | (np.abs(made) >= 2e-3))
        assert np.linalg.norm(left) <= len(axes) * 2e-3 + 1e-15


def test_what_is_left_adds_up_to_a_pulse():
    """Asked for 0.8e-3 N m s again and again: made in the third step and the fifth ..."""
    left, total = np.zeros(3), np.zeros(3)
    for _ in range(10):
        made, left = pulses_for(jets(), left + np.array([0.8e-3, 0, 0]))
        total += on_platform(jets(), made)
    np.testing.assert_allclose(total + left, [8e-3, 0, 0])
    assert np.linalg.norm(left) < 2e-3


def test_jets_about_two_axes_leave_the_third():
    found = pulses_for(jets(np.eye(3)[:2]), np.array([0.01, 0.02, 0.03]))
    np.testing.assert_allclose(found.left, [0, 0, 0.03], atol=1e-17)
