"""The stop at the tilt limit: nothing passes it, it takes energy and gives none, and it is said."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.propagation import body_of
from equipoise.maths.attitude import level, tilt, to_matrix
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.defects import Contact
from equipoise.model.devices import MagneticField, Magnetorquer
from equipoise.model.errors import InputError
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.motion import run
from equipoise.simulation.stop import stop_at

LIMIT = np.radians(20.0)
MASS, GRAVITY = 14.0, 9.81
INERTIA = np.array([[0.4, 0.005, -0.006], [0.005, 0.38, 0.005], [-0.006, 0.005, 0.5]])
T = np.arange(0.0, 120.0, 0.02)
UP, ASLANT = np.array([0.0, 0.0, 1.0]), np.array([0.6, 0.0, 0.8])
CASES = {
    "swings to it": ((60e-6, 20e-6, -100e-6), (0.05, 0.02, 0.3), UP),
    "stands above": ((20e-6, 0.0, 150e-6), (0.0, 0.02, 0.6), UP),
    "aside and fast": ((200e-6, -10e-6, 10e-6), (0.3, 0.02, 0.6), ASLANT),
}


class Followed:
    """A free platform with a stop, and what of it should be kept."""

    def __init__(self, com, rate, up):
        com, start = np.array(com), np.append(level(up), INERTIA @ np.array(rate))
        body = body_of(MASS, GRAVITY, pack_symmetric(INERTIA), MASS * com)
        known, none = np.zeros((len(T), 6)), np.zeros((0, 18))
        path = run(body, none, start, T, known, stop_at(up, LIMIT))
        q, H, R = path.y[:, :4], path.y[:, 4:], to_matrix(path.y[:, :4])
        self.rate, self.touch, self.up, self.tilt = path.rate, path.touch, up, tilt(q, up)
        self.momentum = np.einsum("nij,nj->ni", R, H)
        turning = 0.5 * np.einsum("ni,ij,nj->n", path.rate, INERTIA, path.rate)
        self.energy = turning + MASS * GRAVITY * (R @ com)[:, 2]
        self.vertical, self.rows = R[:, 2], np.flatnonzero(path.touch[:, 2:].any(axis=1))


@pytest.fixture(scope="module", params=CASES)
def followed(request):
    return Followed(*CASES[request.param])


def test_no_node_is_beyond_the_limit(followed):
    assert followed.tilt.max() == pytest.approx(LIMIT, abs=1e-12)


def test_energy_is_taken_and_never_given(followed):
    """Between touches it is kept; under pressure it errs by the square of a step, to and fro."""
    grown = followed.energy - np.minimum.accumulate(followed.energy)
    assert grown.max() < 1e-4 * (followed.energy[0] - followed.energy[-1])


def test_momentum_about_the_vertical_is_kept(followed):
    """A level ring pushes upwards: no torque about the vertical, nor has gravity any."""
    H = followed.momentum
    np.testing.assert_allclose(H[:, 2], H[0, 2], atol=1e-11)


def test_a_first_touch_takes_the_rate_of_tilt_and_its_energy(followed):
    """tilt'^2 / (2 a . J^-1 a), with the rate of tilt extrapolated from the nodes before."""
    k = followed.rows[0]
    assert 0 < k < len(T) - 1
    Z = followed.vertical[k - 1]
    a = np.cross(Z, followed.up) / np.linalg.norm(np.cross(Z, followed.up))
    outwards = float(followed.rate[k - 1] @ a)
    lost = outwards**2 / (2 * a @ np.linalg.solve(INERTIA, a))
    assert followed.energy[k - 1] - followed.energy[k] == pytest.approx(lost, rel=0.05)


def test_a_balanced_platform_stops_dead(testbed):
    """0.25 rad/s about x of 1 kg m^2: at 0.5 rad after 2 s, 0.25 N m s are taken, and it stays."""
    setup = testbed(truth={"rate": np.array([0.25, 0.0, 0.0])}, tilt_limit=0.5)
    bench = SimulatedBench(setup, 0)
    rows = bench.read(10.0)
    (touch,) = bench.touches
    assert (touch.start, touch.end) == pytest.approx((2.0, 2.0), abs=1e-6)
    np.testing.assert_allclose(touch.impulse, [-0.25, 0.0, 0.0], atol=1e-9)
    late = rows.attitude.t > 2.0
    np.testing.assert_allclose(tilt(rows.attitude.values[late], setup.up), 0.5, atol=1e-7)
    assert np.abs(rows.rate.values[rows.rate.t > 2.0]).max() < 1e-9


def test_a_touch_pushes_by_what_the_momentum_changes(testbed):
    """Without gravity's lever the stop alone changes the momentum in the laboratory."""
    spun = {"rate": np.array([0.25, 0.1, -0.2])}
    bench = SimulatedBench(testbed(truth=spun, tilt_limit=0.5), 0)
    rows = bench.read(30.0)
    R = to_matrix(rows.attitude.values)
    at = np.searchsorted(rows.rate.t, rows.attitude.t)
    H = np.einsum("nij,nj->ni", R, rows.rate.values[at] * np.array([1.0, 2.0, 2.5]))
    given = np.sum([touch.impulse for touch in bench.touches], axis=0)
    np.testing.assert_allclose(H[-1] - H[0], given, atol=1e-8)
    assert np.linalg.norm(given) > 0.1


COILS = {
    "magnetorquers": (Magnetorquer("x", np.array([1.0, 0.0, 0.0]), 5.0),),
    "magnetic_field": MagneticField(np.array([0.0, 2e-5, -4e-5]), None),
}
KNOCK = Contact(3.0, np.array([0.05, -0.02, 0.01]))


@pytest.mark.parametrize(("coils", "knocks"), [({}, {}), ({}, {"contacts": (KNOCK,)}), (COILS, {})])
def test_every_way_of_following_knows_the_stop_however_it_is_read(testbed, coils, knocks):
    """Free, knocked, and with coils on: the same touches in one read and in many."""
    start = {"rate": np.array([0.05, 0.02, 0.1])} | knocks
    setup = testbed((1e-4, 0.0, -5e-5), truth=start, tilt_limit=LIMIT, **coils)
    benches = [SimulatedBench(setup, 0) for _ in range(2)]
    for bench in benches:
        if coils:
            bench.drive({"x": 2.0})
    whole, found = benches[0].read(60.0), []
    for _ in range(400):
        benches[1].read(0.15)
        found.append(benches[1].tilt_now())
    assert tilt(whole.attitude.values, setup.up).max() <= LIMIT + 1e-7
    assert max(found) <= LIMIT + 1e-9
    once, often = (bench.touches for bench in benches)
    assert len(once) == len(often) > 0
    for one, other in zip(once, often, strict=True):
        assert (one.start, one.end) == pytest.approx((other.start, other.end), abs=1e-9)
        np.testing.assert_allclose(one.impulse, other.impulse, atol=1e-12)


def test_what_is_to_come_is_no_touch_yet(testbed):
    """It is there at 2 s; a read that ends before, between two samples, knows nothing of it."""
    setup = testbed(truth={"rate": np.array([0.25, 0.0, 0.0])}, tilt_limit=0.5)
    bench = SimulatedBench(setup, 0)
    bench.read(1.99999)
    assert bench.touches == ()
    bench.read(0.00002)
    assert len(bench.touches) == 1


def test_a_platform_that_may_turn_over_has_no_stop(testbed):
    over = testbed(truth={"rate": np.array([0.5, 0.0, 0.0])}, tilt_limit=np.pi)
    bench = SimulatedBench(over, 0)
    assert tilt(bench.read(12.0).attitude.values, over.up).max() > 3.0
    assert bench.touches == ()


def test_a_start_beyond_the_stop_is_refused(testbed):
    beyond = testbed(truth={"attitude": np.array([0.6, 0.0, 0.0])}, tilt_limit=0.5)
    with pytest.raises(InputError, match=r"a tilt of 34\.38 deg; wanted at most.* 28\.65, its"):
        SimulatedBench(beyond, 0)
    at_it = replace(beyond, tilt_limit=0.6)
    assert SimulatedBench(at_it, 0).tilt_now() == pytest.approx(0.6)


@pytest.mark.parametrize("seed", range(8))
def test_a_drawn_start_is_within_a_narrow_stop(testbed, seed):
    narrow = testbed(truth={"attitude": None, "tilt": 0.3}, tilt_limit=0.02)
    assert SimulatedBench(narrow, seed).tilt_now() <= 0.02 + 1e-9
