"""A plan's limits: with what margin they are kept, what is in time, and where a search begins."""

from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.output_error.trajectory import Params
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import InputError
from equipoise.planning.manoeuvre.initial_population import (
    first_choices,
    home_share,
    mildest,
)
from equipoise.planning.manoeuvre.limit_check import (
    course_of,
    covariances_of,
    peaks,
    rehearsal,
)
from equipoise.planning.manoeuvre.manoeuvre_space import Space, chosen, range_of
from equipoise.planning.manoeuvre.out_of_reach import out_of_reach
from equipoise.planning.manoeuvre.plan import (
    REACHED,
    Trials,
    Wish,
    check_reach,
    excess,
    planned,
    search_for,
)
from equipoise.planning.manoeuvre.reference_manoeuvre import usual
from equipoise.planning.manoeuvre.scenario import stated_prior

TILT, RATE = np.radians(30.0), np.radians(5.0)


def space(name="reference-table", duration=60.0, moves=3, standing=None):
    return Space(read_preset(name), duration, moves, TILT, RATE, standing or {})


def test_an_excess_is_of_the_mean_and_four_sd_of_the_logarithm():
    """Tilts 10 a, 10, 10 / a have the mean ln 10 and the sd ln a of their logarithm: with a = 1.3
    10 x 1.3^4 = 28.56 deg, within 30. 11 x 1.3^4 = 31.42 is 0.0472 of itself beyond.
    """
    slow = np.radians(1.0)
    kept = np.array([(np.radians(t), slow) for t in (13.0, 10.0, 10.0 / 1.3)])
    passed = np.array([(np.radians(1.1 * t), slow) for t in (13.0, 10.0, 10.0 / 1.3)])
    assert excess(space(), kept) == 0.0
    assert excess(space(), passed) == pytest.approx(0.0472, abs=1e-4)


def test_an_excess_counts_tilt_and_rate():
    """Rates: 4 x 1.2^4 = 8.294 is 0.6589 beyond 5. Tilts: 11 x 1.3^4 is 0.0472 beyond 30."""
    found = ((14.3, 4.8), (11, 4), (11 / 1.3, 4 / 1.2))
    assert excess(space(), np.radians(found)) == pytest.approx(0.6589 + 0.0472, abs=2e-4)


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


# --- Limits out of reach -----------------------------------------------------------------------


def wish_for(testbed):
    return Wish("both", "A", Params(), stated_prior(testbed))


def test_limits_that_no_manoeuvre_keeps_end_a_search_after_few():
    """Sputnix as it is stated, 40 um off to any side: let go for two minutes it turns over."""
    where, tried = space("sputnix", 120.0), []

    def spread(work, pieces):
        tried.extend(pieces)
        return map(work, pieces)

    with pytest.raises(InputError) as caught:
        planned(where, wish_for(where.testbed), 1, Trials(400, spread))
    assert not tried
    text = str(caught.value)
    assert text.startswith(where.testbed.name)
    assert (
        f"none of {len(mildest(where, where.testbed.body)) + REACHED} manoeuvres of 120 s" in text
    )
    assert "times the tilt limit of 30 deg" in text
    assert "times the rate limit of 5 deg/s" in text


def test_it_is_said_which_limit_is_passed_by_how_much_and_what_may_help():
    """70.8 deg of 30 are 2.36 times; 4 deg/s are within 5. Known to 40 um, without a record."""
    where = space("sputnix", 120.0)
    text = str(out_of_reach(where, np.radians([[70.8, 4.0], [20.0, 3.0]]), 28, alone=True))
    assert "does with 1 of 2 possible platforms" in text
    assert "others reach 2.4 times the tilt limit of 30 deg; wanted" in text
    assert "prior record (the centre of mass is known to 40 um only)" in text
    assert "rate" not in text
    text = str(out_of_reach(where, np.radians([[29.0, 11.0], [2.0, 8.0]]), 28, alone=False))
    assert "does with 0 of 2 possible platforms" in text
    assert "reach 2.2 times the rate limit of 5 deg/s" in text
    assert "tilt" not in text
    assert "prior record" not in text
    assert text.endswith("a higher rate limit")


def low(com, sd=5e-6):
    """Two minutes of sputnix with its centre of mass known to 5 um."""
    testbed = read_preset("sputnix")
    body = replace(testbed.body, com=np.array(com))
    return replace(
        space("sputnix", 120.0), testbed=replace(testbed, body=body, com_sd=np.full(3, sd))
    )


def test_limits_within_reach_end_no_search():
    """80 um low it stays within 30 deg and 5 deg/s; known to 60 um, it does not."""
    for sd, is_reached in ((5e-6, True), (60e-6, False)):
        where = low([0.0, 0.0, -80e-6], sd)
        search = search_for(where, wish_for(where.testbed), 1)
        with nullcontext() if is_reached else pytest.raises(InputError):
            check_reach(search, mildest(where, where.testbed.body))


def test_a_platform_that_hangs_aside_is_let_go_where_it_hangs():
    """40 um to x and 30 to y, 100 um low: it hangs 26.6 deg aside, 36.9 deg from x towards y."""
    where = low([40e-6, 30e-6, -100e-6])
    hangs = chosen(where, mildest(where, where.testbed.body)[4])
    assert hangs.tilt == pytest.approx(np.arctan(0.5), abs=np.radians(0.25))
    np.testing.assert_allclose(hangs.low_side, [0.8, 0.6, 0.0], atol=0.05)
    search = search_for(where, wish_for(where.testbed), 1)
    upright, resting = (
        peaks(search.testbed, course_of(search.testbed, m, 1.0), search.guarded)
        for m in (chosen(where, mildest(where, where.testbed.body)[0]), hangs)
    )
    assert np.median(upright[:, 0]) > 1.5 * np.median(resting[:, 0])


def test_the_mildest_manoeuvres_move_least():
    """Upright, at rest; masses stay, go half the way to the lowest end of their rail, or all."""
    where = space("sputnix", 120.0)
    stay, half, low, later, *_ = (
        chosen(where, numbers) for numbers in mildest(where, where.testbed.body)
    )
    for manoeuvre in (stay, half, low, later):
        assert manoeuvre.tilt == 0.0
        np.testing.assert_array_equal(manoeuvre.rate, np.zeros(3))
    assert all(d == 0.0 for _, targets in stay.moves for d in targets.values())
    assert half.moves[0][1]["z1"] == pytest.approx(-0.025, abs=1e-3)
    assert low.moves[0][1]["z1"] == pytest.approx(-0.050)
    assert low.moves[0][1]["x1"] == 0.0
    assert later.moves[0][0] > low.moves[0][0]


def test_masses_that_stand_somewhere_stay_there_in_the_mildest():
    where = space("sputnix", 120.0, standing={"x1": 0.020})
    targets = chosen(where, mildest(where, where.testbed.body)[0]).moves[0][1]
    assert targets["x1"] == pytest.approx(0.020)
    assert targets["y1"] == 0.0


def test_several_platforms_at_once_are_as_each_by_itself():
    where = space("sputnix", 60.0, standing={})
    search = search_for(where, wish_for(where.testbed), 1)
    m = usual(where.testbed, 60.0, {})
    course = course_of(search.testbed, m, 1.0)
    tried = rehearsal(search.testbed, where.testbed.body, course, search.wish.params)
    three, names = search.platforms.part(0, 3), search.names
    together = covariances_of(tried, three, None, names)
    for k in range(3):
        one = search.platforms.part(k, k + 1)
        alone, bed = peaks(search.testbed, course, one), search.testbed
        np.testing.assert_array_equal(peaks(bed, course, three)[k], alone[0])
        np.testing.assert_allclose(together[k], covariances_of(tried, one, None, names)[0], 1e-9)
