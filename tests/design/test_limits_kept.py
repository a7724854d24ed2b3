"""A plan's limits: with what margin they are kept, what is in time, and where a search begins."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.design.choices import Space, calm_choice, chosen, range_of
from equipoise.design.plan import excess, first_tries
from equipoise.design.rehearsal import Peaks
from equipoise.io.presets import read_preset

TILT, RATE = np.radians(30.0), np.radians(5.0)


def space(name="reference-table", duration=60.0, moves=3, standing=None):
    return Space(read_preset(name), duration, moves, TILT, RATE, standing or {})


def test_an_excess_is_of_the_mean_and_three_sd():
    """Tilts 20, 22, 24 deg: 22 + 3 x 2 = 28. Then 24, 26, 28: 32 is 1/15 beyond 30."""
    slow = np.radians(1.0)
    kept = [Peaks(np.radians(t), slow) for t in (20.0, 22.0, 24.0)]
    passed = [Peaks(np.radians(t), slow) for t in (24.0, 26.0, 28.0)]
    assert excess(space(), kept) == 0.0
    assert excess(space(), passed) == pytest.approx(1 / 15)


def test_an_excess_counts_tilt_and_rate():
    """Rates 4, 5, 6 deg/s: 5 + 3 x 1 = 8 is 0.6 beyond 5; with the tilt above 2/3."""
    peaks = [Peaks(np.radians(t), np.radians(r)) for t, r in ((24, 4), (26, 5), (28, 6))]
    assert excess(space(), peaks) == pytest.approx(1 / 15 + 0.6)


def test_slow_masses_go_as_far_as_there_is_time():
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


def test_a_calm_choice_is_let_go_level_without_a_push_and_drives_nothing():
    calm = chosen(space(), calm_choice(space()))
    assert (calm.tilt, calm.waves) == (0.0, ())
    np.testing.assert_array_equal(calm.rate, 0.0)


def test_some_first_tries_are_calm():
    """Of 40 near the plain choice the tenth with the least tilt has less than a third of it."""
    where = replace(space("sputnix"), duration=120.0)
    tries = first_tries(where, 80, np.random.default_rng(1))[1:40]
    tilts = sorted(chosen(where, numbers).tilt for numbers in tries)
    assert tilts[3] < chosen(where, first_tries(where, 80, np.random.default_rng(1))[0]).tilt / 3
