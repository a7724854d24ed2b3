"""A plan's limits: with what margin they are kept, what is in time, and where a search begins."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.planning.manoeuvre.initial_population import first_choices, home_share
from equipoise.planning.manoeuvre.limit_check import Peaks
from equipoise.planning.manoeuvre.manoeuvre_space import Space, chosen, range_of
from equipoise.planning.manoeuvre.plan import excess

TILT, RATE = np.radians(30.0), np.radians(5.0)


def space(name="reference-table", duration=60.0, moves=3, standing=None):
    return Space(read_preset(name), duration, moves, TILT, RATE, standing or {})


def test_an_excess_is_of_the_mean_and_four_sd_of_the_logarithm():
    """Tilts 10 a, 10, 10 / a have the mean ln 10 and the sd ln a of their logarithm: with a = 1.3
    10 x 1.3^4 = 28.56 deg, within 30. 11 x 1.3^4 = 31.42 is 0.0472 of itself beyond.
    """
    slow = np.radians(1.0)
    kept = [Peaks(np.radians(t), slow) for t in (13.0, 10.0, 10.0 / 1.3)]
    passed = [Peaks(np.radians(1.1 * t), slow) for t in (13.0, 10.0, 10.0 / 1.3)]
    assert excess(space(), kept) == 0.0
    assert excess(space(), passed) == pytest.approx(0.0472, abs=1e-4)


def test_an_excess_counts_tilt_and_rate():
    """Rates: 4 x 1.2^4 = 8.294 is 0.6589 beyond 5. Tilts: 11 x 1.3^4 is 0.0472 beyond 30."""
    found = ((14.3, 4.8), (11, 4), (11 / 1.3, 4 / 1.2))
    peaks = [Peaks(np.radians(tilt), np.radians(rate)) for tilt, rate in found]
    assert excess(space(), peaks) == pytest.approx(0.6589 + 0.0472, abs=2e-4)


def test_the_range_of_slow_masses_is_limited_by_time():
    """1 mm/s, 60 s, 3 moves: 0.9 x 60 / 6 = 9 s for each, so 4.5 mm to either side of now."""
    mass = space().testbed.mass_named("coarse_x")
    np.testing.assert_allclose(range_of(space(), mass), [-4.5e-3, 4.5e-3])
    stood = space(standing={"coarse_x": 48e-3})
    np.testing.assert_allclose(range_of(stood, mass), [43.5e-3, 50e-3])
    fast = space("sputnix", 120.0)
    np.testing.assert_allclose(range_of(fast, fast.testbed.masses[0]), [-0.05, 0.05])


def test_every_move_of_slow_masses_has_ended_when_the_next_begins():
    where, rng = space(), np.random.default_rng(2)
    for numbers in rng.random((5, where.size)):
        m = chosen(where, numbers)
        stands = dict.fromkeys(where.testbed.mass_names, 0.0)
        ends = 0.0
        for t, targets in m.moves:
            assert t >= ends - 1.0  # times are whole seconds
            ends = t + max(abs(d - stands[name]) / 1e-3 for name, d in targets.items())
            stands.update(targets)
        assert ends <= 0.9 * m.duration + 1.0


def test_a_search_begins_low_and_near_home():
    """Of three quarters of the first choices z rails are within 9 % of their lowest end (0.04 of
    half a rail and 2 sd of 0.03), x and y rails within 0.36 of their middle, and the tilt within
    0.6 of the limit.
    """
    where, rng = replace(space("sputnix"), duration=120.0), np.random.default_rng(1)
    likely = [chosen(where, n) for k, n in enumerate(first_choices(where, 80, rng)) if k % 4]
    assert len(likely) == 60
    goals = {name: np.array([[move[1][name] for move in m.moves] for m in likely])
             for name in ("x1", "y1", "z1")}  # fmt: skip
    assert np.mean(goals["z1"] < -0.041) > 0.9
    at_the_end = np.mean(goals["z1"] < -0.0485)  # drawn below 0.01 of the rail: 0.37 of them
    assert 0.2 < at_the_end < 0.6
    for level in (goals["x1"], goals["y1"]):
        assert np.mean(np.abs(level) < 0.036) > 0.95
        assert level.std() > 0.006
    assert max(m.tilt for m in likely) <= 0.6 * TILT + np.radians(0.25)
    spins = np.array([m.rate[2] for m in likely])
    assert spins.min() < -0.4 * RATE
    assert spins.max() > 0.4 * RATE


def test_a_search_begins_with_waves_of_any_size():
    drawn = [chosen(space(), n) for n in first_choices(space(), 20, np.random.default_rng(1))]
    sizes = [abs(wave.amplitude) for m in drawn for wave in m.waves]
    assert len(sizes) > 40
    assert min(sizes) < max(sizes) / 10


def test_masses_that_stand_elsewhere_begin_from_where_they_are():
    """At 48 mm on a rail of 50 mm, with 4.5 mm in time: home is beyond reach, its end 0."""
    stood = space(standing={"coarse_x": 48e-3})
    mass = stood.testbed.mass_named("coarse_x")
    assert home_share(stood, mass) == 0.0
    assert home_share(space(), mass) == pytest.approx(0.5)
