"""Contacts and slips of a bench whose motion is known by hand."""

import numpy as np
import pytest

from equipoise.maths.attitude import to_matrix
from equipoise.model.defects import ComStep, Contact
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.events import struck

INERTIA = np.diag([1.0, 2.0, 2.5])
IMPULSE = np.array([2e-3, -3e-3, 5e-3])


def momentum_N(recording):
    """Return the angular momentum in laboratory axes where camera and gyro have rows."""
    rows = np.searchsorted(recording.rate.t, recording.attitude.t)
    turned = to_matrix(recording.attitude.values)
    return np.einsum("nij,nj->ni", turned @ INERTIA, recording.rate.values[rows])


def test_a_contact_changes_the_momentum_in_the_laboratory_by_its_impulse(testbed):
    """Balanced, so that nothing else can; the row at the moment itself is that before."""
    start = {"attitude": np.array([0.3, -0.4, 2.0]), "rate": np.array([0.1, 0.2, -0.3])}
    bench = SimulatedBench(testbed(truth={**start, "contacts": (Contact(4.0, IMPULSE),)}), 0)
    H = momentum_N(bench.read(10.0))
    np.testing.assert_allclose(H[:21], np.tile(H[0], (21, 1)), atol=1e-10)
    np.testing.assert_allclose(H[21:] - H[0], np.tile(IMPULSE, (30, 1)), atol=1e-10)


def test_two_contacts_at_once_are_one_of_both(testbed):
    both = (Contact(1.0, IMPULSE), Contact(1.0, -0.25 * IMPULSE))
    bench = SimulatedBench(testbed(truth={"contacts": both}), 0)
    H = momentum_N(bench.read(2.0))
    np.testing.assert_allclose(H[-1], 0.75 * IMPULSE, atol=1e-12)


def test_a_slip_makes_a_torque_from_its_moment_on(testbed):
    """By hand: 10 kg 9.81 m/s^2 20 um / 2 kg m^2 = 9.81e-4 rad/s^2 about +y, from rest."""
    step = ComStep(3.0, np.array([20e-6, 0.0, 0.0]))
    bench = SimulatedBench(testbed(truth={"com_steps": (step,)}), 0)
    rate = bench.read(5.0).rate
    before = rate.t <= 3.0
    np.testing.assert_allclose(rate.values[before], 0, atol=1e-15)
    by_hand = 9.81e-4 * (rate.t[~before] - 3.0)
    np.testing.assert_allclose(rate.values[~before, 1], by_hand, rtol=1e-5)


def test_a_slip_is_in_the_truth(testbed):
    steps = (ComStep(3.0, np.array([2e-5, 0, 0])), ComStep(5.0, np.array([0, 1e-5, -1e-5])))
    bench = SimulatedBench(testbed((0, 0, -1e-4), truth={"com_steps": steps}), 0)
    observed = []
    for _ in range(3):
        bench.read(2.0)
        observed.append(bench.truth().com)
    by_hand = [[0, 0, -1e-4], [2e-5, 0, -1e-4], [2e-5, 1e-5, -1.1e-4]]
    np.testing.assert_allclose(observed, by_hand, atol=1e-15)
    assert bench.platform.truth.com_steps == steps


def test_reads_that_end_at_a_contact_apply_it_once(testbed):
    setup = testbed(truth={"contacts": (Contact(1.0, IMPULSE),)})
    bench, twin = SimulatedBench(setup, 0), SimulatedBench(setup, 0)
    for duration in (1.0, 0.0, 0.0, 1e-4, 1.0):
        parts = bench.read(duration)
    whole = twin.read(2.0001)
    np.testing.assert_allclose(parts.rate.values[-1], whole.rate.values[-1], atol=1e-14)
    np.testing.assert_allclose(momentum_N(whole)[-1], IMPULSE, atol=1e-12)


def test_an_event_between_nodes_becomes_a_node(testbed):
    """An event that is no node would be lost: the bench makes every one a node."""
    bench = SimulatedBench(testbed(truth={"contacts": (Contact(1.23456, IMPULSE),)}), 0)
    np.testing.assert_allclose(momentum_N(bench.read(2.0))[-1], IMPULSE, atol=1e-12)


@pytest.mark.parametrize("t", [0.5, 1.0])
def test_an_impulse_is_turned_into_body_axes(t):
    """A quarter turn about z: laboratory x is body -y."""
    y = np.array([np.sqrt(0.5), 0, 0, np.sqrt(0.5), 0, 0, 0])
    after = struck(y, (Contact(1.0, np.array([1e-3, 0, 0])),), t)
    np.testing.assert_allclose(after[4:], [0, -1e-3 * (t == 1.0), 0], atol=1e-18)
