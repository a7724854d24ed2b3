"""Balancing with masses alone: rounds of levelling and measuring, with and without an integral."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.elements.tilt_feedback import (
    INTEGRAL,
    frequency_of,
    polynomial,
    routh_margin,
    settling,
    swing_of,
)
from equipoise.control.laws import two_steps, underactuated, underactuated_integral
from equipoise.maths.attitude import exponential
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate, Parameter
from tests.support.ideal_bench import (
    GRAVITY,
    MASS,
    UP,
    Bench,
    closed_loop,
    platform,
    rails,
    spring,
    tilts,
    total,
    with_params,
)
from tests.support.outcomes import of_use

COM = np.array([2e-4, -1.5e-4, -4e-4])
TARGET = np.array([0.0, 0.0, -1e-4])
TILTED = (exponential(np.array([0.05, 0.02, 0.4])), np.array([0.01, -0.02, 0.005]))
BOTH = pytest.mark.parametrize("law", [underactuated.LAW, underactuated_integral.LAW])


def run(law, end=400.0, first=TILTED, com_sd=2e-4, **bench):
    """Rows of a whole law, the bench, and its parameters."""
    masses = bench.pop("masses", rails())
    bench = Bench(platform(com_sd, masses=masses), **({"com": COM} | bench))
    begun = law.begin(bench.testbed, TARGET)
    return closed_loop(bench, law.step, begun, end, first), bench, begun[1]


def ends(rows):
    """Rows with which a levelling ends."""
    return [r for r in rows if r.command is not None and "push_begins" in codes(r)]


def codes(row):
    """Return what a law reports at a row."""
    return [reason.code for reason in (*row.command.note, *row.command.finished)]


def measurements(rows):
    """Rows at which a measurement was judged."""
    return [r for r in rows if r.command is not None and "height_missing" in codes(r)]


@BOTH
def test_it_balances_to_the_target(law):
    """From 250 um aside, 400 um low and 3 deg tilted; sensors and masses are perfect."""
    rows, bench, _ = run(law)
    assert rows[-1].command.finished
    np.testing.assert_allclose(total(rows, bench)[-1], TARGET, atol=5e-8)
    assert tilts(rows).max() < np.radians(6)


@BOTH
def test_it_balances_to_a_motor_step(law):
    """Motor steps of 3.6 um, 5 mm/s, estimates 10 % and 1 um off, noise of a good filter."""
    masses = rails(speed=0.005, resolution=1e-5)
    rows, bench, params = run(
        law, masses=masses, instant=False, reported=(0.1, 1e-6), noise=(1e-4, 1e-5), seed=4
    )
    assert "motor_step_or_less" in codes(rows[-1])
    off = total(rows, bench)[-1] - TARGET
    assert np.hypot(*off[:2]) < params.tolerance
    # A scale 10 % off is 10 % of what hangs, 100 um here, and of the trim before.
    assert abs(off[2]) < 10e-6 + 2 * params.tolerance


def test_each_round_leaves_the_printed_share_and_the_integral_nothing():
    """|r_up| / (|r_up| + X) of what was aside, at the height of that round."""
    rows, bench, params = run(underactuated.LAW)
    aside = float(np.hypot(*COM[:2]))  # rh(0) is nought across
    for row in ends(rows)[:2]:
        com = row.shift + bench.com
        aside *= abs(com[2]) / (abs(com[2]) + spring(params.gains))
        # To first order in the tilt; the first round's is 0.083 rad.
        assert np.hypot(*com[:2]) == pytest.approx(aside, rel=0.01)
    assert aside > 3e-6
    rows, bench, params = run(underactuated_integral.LAW)
    for row in ends(rows):
        assert np.hypot(*(row.shift + bench.com)[:2]) < 1e-8


def test_the_integral_leaves_a_motor_step_where_the_printed_law_leaves_fifty():
    """Motor steps of 1.1 um: one levelling, 900 um low."""
    masses, left = rails(resolution=3e-6), []
    for law in (underactuated.LAW, underactuated_integral.LAW):
        rows, bench, params = run(law, 60.0, masses=masses)
        left.append(np.hypot(*(ends(rows)[0].shift + bench.com)[:2]))
    quantum = 5.0 * 3e-6 / MASS
    assert params.tolerance == pytest.approx(quantum)
    assert left[1] < quantum < 50 * quantum < left[0]


def test_routh_says_what_the_roots_say():
    rng, observed = np.random.default_rng(3), set()
    for _ in range(300):
        w, integral, swing = rng.uniform(0.1, 2), rng.uniform(0.01, 6), rng.uniform(-2, 2)
        stable = bool(np.all(np.roots(polynomial(w, integral, swing)).real < 0))
        assert (routh_margin(w, integral, swing) > 0) == stable
        observed.add(stable)
    assert observed == {True, False}


@pytest.mark.parametrize(("share", "holds"), [(0.8, True), (1.2, False)])
def test_the_loop_is_stable_up_to_the_routh_limit(share, holds):
    """w_i at a share of 2 zeta (w_a^2 + w_z^2) / w_a, hanging 1 mm low, samples of 20 ms."""
    com, period = np.array([1e-5, 0, -1e-3]), 0.02
    bench = Bench(platform(inertia=np.diag([0.29, 0.29, 0.45])), com, period=period)
    state, params = underactuated_integral.LAW.begin(bench.testbed, TARGET)
    swing = MASS * GRAVITY * 1e-3 / 0.29
    w = frequency_of(params.gains, bench.testbed)
    limit = 2 * (w**2 + swing) / w
    assert routh_margin(w, limit, swing) == pytest.approx(0, abs=1e-12)
    gains = params.gains._replace(integral=share * limit, period=period)
    begun = with_params((replace(state, height=0.0), params), gains=gains, follow=10**6)
    rows = closed_loop(bench, underactuated_integral.LAW.step, begun, 50.0)
    rate = np.abs([r.rate[1] for r in rows])
    assert (rate[-500:].max() < 0.3 * rate[:500].max()) == holds
    assert (rate[-500:].max() > 2 * rate[:500].max()) != holds


def test_the_loop_settles_as_its_slowest_root():
    """The slowest mode turns once in 2 pi / Im; tilts that far apart are as exp(-that / time)."""
    com, period = np.array([1e-6, 0, -1e-5]), 0.01
    bench = Bench(platform(inertia=np.diag([0.29, 0.29, 0.45])), com, period=period)
    state, params = underactuated_integral.LAW.begin(bench.testbed, TARGET)
    gains = params.gains._replace(period=period)
    begun = with_params((replace(state, height=0.0), params), gains=gains, follow=10**6)
    rows = closed_loop(bench, underactuated_integral.LAW.step, begun, 31.0)
    time = settling(1.0, INTEGRAL, swing_of(bench.testbed, -1e-5))
    roots = np.roots(polynomial(1.0, INTEGRAL, swing_of(bench.testbed, -1e-5)))
    turn = 2 * np.pi / np.abs(roots.imag).max()
    t, a = np.array([r.t for r in rows]), np.array([r.gravity[0] for r in rows])
    later = np.interp(np.array([10.0, 10.0 + turn]), t, a)
    assert later[1] / later[0] == pytest.approx(np.exp(-turn / time), rel=0.03)


def test_the_integral_waits_for_late_masses():
    """Anti-windup: masses half a millimetre behind; rh then has the increment of g_b alone."""
    _, params = underactuated_integral.LAW.begin(platform(2e-4), TARGET)
    before = np.array([0.5, 0, -9.7])
    state = two_steps.State(np.zeros(3), 0.0, gravity=before, owed=np.zeros(3),
                             requested=np.array([5e-4, 0, 0]))  # fmt: skip
    rows, *_ = run(underactuated_integral.LAW, 0.1)
    bench = Bench(platform(), COM)
    observed = closed_loop(bench, lambda s, x, p: (x, rows[0].command), (None, None), 0.1)[0].state
    late, _ = two_steps.step(state, observed, params)
    rise = params.gains.gamma * MASS * (observed.gravity - before)
    np.testing.assert_allclose(late.held, rise, atol=1e-15)
    there, _ = two_steps.step(replace(state, requested=observed.shift), observed, params)
    assert np.linalg.norm(there.held - rise) > 1e-6


def test_an_inverted_platform_is_levelled_within_the_routh_limit():
    """300 um above P, which falls in 2.6 s by itself; the masses first lower it."""
    bench = Bench(platform(1e-4), np.array([1e-4, 0, 1.5e-4]))
    begun = underactuated_integral.LAW.begin(bench.testbed, TARGET)
    rows = closed_loop(bench, underactuated_integral.LAW.step, begun, 400.0)
    np.testing.assert_allclose(total(rows, bench)[-1], TARGET, atol=5e-8)


def test_routh_guards_the_beginning(monkeypatch):
    """By hand, 1.02 mm above P: w_z^2 = -0.483 s^-2, and 1 - 0.25 / (2 * 0.517) = 0.758."""
    high = platform(1e-5, com=(0.0, 0.0, 1e-3))
    swing = swing_of(high, 1.02e-3)
    assert swing == pytest.approx(-MASS * GRAVITY * 1.02e-3 / 0.29)
    assert routh_margin(1.0, 0.25, swing) == pytest.approx(0.758, abs=1e-3)
    assert routh_margin(1.0, 0.25, -1.1) == -np.inf
    underactuated_integral.LAW.begin(high, TARGET)
    monkeypatch.setattr(underactuated_integral, "INTEGRAL", 0.8)
    with pytest.raises(InputError, match="Routh"):
        underactuated_integral.LAW.begin(high, TARGET)


def test_the_published_filter_is_the_method_only_where_its_prior_is_valid():
    """ukf_4 takes com across up from the testbed, and knows of no balancing since."""
    assert two_steps.method_for(platform(1e-4)).method == "trajectory"
    assert two_steps.method_for(platform(1e-6)).method == "ukf_4"
    with pytest.raises(InputError, match="gyro"):
        two_steps.method_for(replace(platform(), gyro=None))


def test_it_begins_at_the_prior_centre_of_mass_lowered_by_two_sd():
    """Level: masses at once across, and lower by two sd than the target."""
    bench = Bench(platform(1e-5, com=(1e-5, 2e-5, -3e-5)), np.zeros(3))
    begun = underactuated.LAW.begin(bench.testbed, TARGET)
    first = closed_loop(bench, underactuated.LAW.step, begun, 0.1)[0].command.shift
    np.testing.assert_allclose(first, [-1e-5, -2e-5, -9e-5], atol=1e-12)


def test_a_target_aside_of_up_is_refused():
    with pytest.raises(InputError, match="on the up axis"):
        underactuated.LAW.begin(platform(), np.array([1e-5, 0, -1e-4]))


def reported(usable=True, **values):
    """An estimate with these parameters."""
    parameters = tuple(Parameter(name, "m", x, 1e-6) for name, x in values.items())
    return Estimate("scripted", of_use(usable), parameters, np.eye(len(values)))


def test_heights_are_read_from_the_estimate_of_a_method():
    x, z = np.array([-1.0, 0, 0]), UP
    assert two_steps.height_in(reported(com_x=1e-6, com_y=2e-6, com_z=3e-6), x) == -1e-6
    assert two_steps.height_in(reported(com_z=3e-6), z) == 3e-6
    assert two_steps.height_in(reported(com_x=3e-6), x) == -3e-6
    assert two_steps.height_in(reported(com_up=3e-6), np.array([0.6, 0, 0.8])) == 3e-6


def measured():
    """A state that waits for a measurement, level but for 0.01 rad, masses 0.5 mm up."""
    _, params = underactuated.LAW.begin(platform(1e-4), TARGET)
    state = two_steps.State(
        np.zeros(3), 0.0, phase="measurement", rest=np.array([1e-5, 0, 5e-4]),
        level=np.array([0.0, 0.01, 0.0]),
    )  # fmt: skip
    return state, params


def test_a_measurement_trims_the_height_alone():
    """Found 1 mm low, masses 0.5 mm up: 0.4 mm more is wanted."""
    state, params = measured()
    after, command = two_steps.step(state, reported(com_x=7e-5, com_y=0.0, com_z=-1e-3), params)
    np.testing.assert_allclose(command.shift, [1e-5, 0, 9e-4], atol=1e-15)
    assert (after.phase, after.gravity, after.rounds) == ("follow", None, 1)
    np.testing.assert_allclose(after.held, [-1e-5, 0, 0], atol=1e-15)
    assert after.left == pytest.approx(np.hypot(4e-4, 5e-4 * 0.01))


def test_rounds_end_when_nothing_is_gained_or_they_are_used_up():
    state, params = measured()
    low = reported(com_x=0.0, com_y=0.0, com_z=-1e-3)
    gained = two_steps.step(replace(state, left=6e-4), low, params)[0]
    assert not gained.ending
    stuck = two_steps.step(replace(state, left=4.1e-4), low, params)[0]
    assert "nothing_gained" in [reason.code for reason in stuck.ending]
    spent = two_steps.step(replace(state, rounds=params.rounds - 1), low, params)[0]
    assert "rounds_used_up" in [reason.code for reason in spent.ending]


def test_after_the_last_measurement_it_levels_once_more_and_rests():
    """The push of the measurement is gone when the law ends: no tilt, no rate."""
    rows, *_ = run(underactuated.LAW)
    assert "level_again" in codes(rows[-1])
    pushed = max(i for i, row in enumerate(rows) if row.state.phase == "push" and row.state.step)
    assert np.degrees(tilts(rows)[pushed:].max()) > 0.5
    assert np.degrees(tilts(rows)[-1]) < 0.01
    assert np.degrees(np.linalg.norm(rows[-1].rate[:2])) < 0.01


def test_an_unusable_measurement_is_repeated_and_reported():
    state, params = measured()
    after, command = two_steps.step(state, reported(usable=False), params)
    assert (after.phase, command.finished) == ("push", ())
    why = ["swing_unusable", "hardly_moved"]
    assert [reason.code for reason in command.note] == why
    spent = two_steps.step(replace(state, rounds=params.rounds - 1), reported(usable=False), params)
    assert [reason.code for reason in spent[1].finished] == why


def test_it_stops_beyond_the_tilt_limit():
    rows, *_ = run(underactuated.LAW, first=(exponential(np.array([0.6, 0, 0])), np.zeros(3)))
    assert len(rows) == 1
    assert codes(rows[0]) == ["law_tilted"]


def test_the_push_swings_the_platform_by_the_intended_amplitude():
    """SWING of the tilt limit in the 20 s of a measurement, when hardly any torque restores."""
    bench = Bench(platform(1e-4), np.array([0, 0, -1.05e-4]))
    begun = underactuated_integral.LAW.begin(bench.testbed, TARGET)
    begun = (replace(begun[0], height=0.0), begun[1])
    rows = closed_loop(bench, underactuated_integral.LAW.step, begun, 200.0)
    first = measurements(rows)[0]
    before = rows[rows.index(first) - 1]
    rate = np.linalg.norm(before.rate)
    assert rate == pytest.approx(0.4 * np.radians(30) / 20, rel=0.1)
    assert before.command.measurement.since == pytest.approx(ends(rows)[0].t)  # a known change
    np.testing.assert_allclose(before.shift, first.shift, atol=1e-9)  # the masses are back


def test_spin_about_up_is_left_and_borne():
    """At 0.2 rad/s about up, which masses cannot brake, both still balance."""
    for law in (underactuated.LAW, underactuated_integral.LAW):
        rows, bench, _ = run(law, 600.0, first=(TILTED[0], np.array([0.01, -0.02, 0.2])))
        np.testing.assert_allclose(total(rows, bench)[-1], TARGET, atol=3e-7)
        assert abs(rows[-1].rate[2]) > 0.15


def test_the_tilt_at_the_start_is_paid_out_no_faster_than_masses_follow():
    """10 deg tilted with masses of 18 um/s: 42 um/deg at once would fall over; this settles."""
    masses = rails(speed=5e-5)
    rows, _, params = run(
        underactuated.LAW, 150.0, (exponential(np.array([0.17, 0, 0])), np.zeros(3)),
        com_sd=5e-6, masses=masses, instant=False, com=np.array([5e-6, 0, -1e-4]),
    )  # fmt: skip
    first = ends(rows)[0]
    assert tilts(rows).max() < np.radians(12)
    assert tilts([first])[0] < np.radians(0.5)
    paid = np.diff([r.state.owed for r in rows[:20]], axis=0)
    assert np.linalg.norm(paid, axis=1).max() <= params.pay * (1 + 1e-9)
