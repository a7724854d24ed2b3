"""Balancing with wheels that hold a momentum trajectory and masses that learn from it."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.elements.cone_plan import NEAR
from equipoise.control.elements.sweep import cone, wanted
from equipoise.control.laws.fully_actuated import LAW, State, step
from equipoise.maths.attitude import exponential
from equipoise.maths.linalg import cross
from equipoise.model.errors import InputError
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import one_reason
from equipoise.model.testbed import Gyro
from tests.support import thorough
from tests.support.ideal_bench import (
    GRAVITY,
    INERTIA,
    LEVEL,
    MASS,
    Bench,
    closed_loop,
    gravity_at,
    platform,
    rails,
    sample,
    started,
    tilts,
    total,
    wheels,
    with_params,
)

COM = np.array([2e-4, -1.5e-4, -4e-4])
TARGET = np.zeros(3)
TILTED = (exponential(np.array([0.05, 0.02, 0.0])), np.array([0.01, -0.02, 0.005]))
ROUND = np.diag([0.3, 0.3, 0.3])


def bed(**changes):
    """The platform, with wheels, and a gyro of a row a period: rates as old as attitudes."""
    given = {"com_sd": 1e-4, "wheels": wheels(), "gyro": Gyro(10.0, 1e-5, 0.0)}
    return platform(**(given | changes))


def still(begun, **changes):
    """H_d = 0."""
    sweep = begun[1].sweep._replace(angle=0.0, hold=0.0)
    return with_params(begun, sweep=sweep, **changes)


def error_of(row, params, inertia, start=0.0):
    """E = J w - H_d."""
    down = row.gravity / GRAVITY
    return inertia @ (row.rate - wanted(params.sweep, row.t - start, down, row.rate).rate)


def with_momentum(bench):
    """Wheels that already turn: [w x] h matters."""
    return replace(bench, momentum=np.array([0.3, -0.5, 0.4]))


def test_the_error_obeys_the_printed_equation():
    """e' = -K e - m [g_b x] (r + s), over one short step from any motion, wheels turning.

    H_s of all momentum would not do: wheels cannot change it.
    """
    bench, rng = with_momentum(Bench(bed(), COM, period=1e-4)), np.random.default_rng(5)
    state, params = with_params(LAW.begin(bench.testbed, TARGET), period=1e-4)
    for _ in range(5):
        first = (exponential(0.1 * rng.normal(size=3)), 0.1 * rng.normal(size=3))
        # In the first step the masses jump, which changes J a little.
        a, b = closed_loop(bench, LAW.step, (state, params), 1.5e-4, first)[1:]
        rise = (error_of(b, params, INERTIA) - error_of(a, params, INERTIA)) / 1e-4
        middle = (error_of(b, params, INERTIA) + error_of(a, params, INERTIA)) / 2
        off = b.shift + COM
        fall = -params.gain * middle - MASS * np.cross((a.gravity + b.gravity) / 2, off)
        np.testing.assert_allclose(rise, fall, rtol=2e-3, atol=3e-5)
        assert np.linalg.norm(MASS * np.cross(a.gravity, off)) > 0.02


def test_masses_move_as_printed():
    """s' = Gamma m [g_b x]^T e, over short steps."""
    bench = with_momentum(Bench(bed(), COM, period=1e-3))
    begun = with_params(LAW.begin(bench.testbed, TARGET), period=1e-3)
    params = begun[1]
    rows = closed_loop(bench, LAW.step, begun, 3e-3, (LEVEL, np.array([0.1, -0.2, 0.3])))
    a, b = rows[0], rows[1]
    middle = (error_of(a, params, INERTIA) + error_of(b, params, INERTIA)) / 2
    skew = np.cross((a.gravity + b.gravity) / 2, np.eye(3)).T  # skew v = g x v
    slope = (b.state.shift - a.state.shift) / 1e-3
    expected = params.adaption * MASS * skew.T @ middle
    np.testing.assert_allclose(slope, expected, rtol=1e-3, atol=1e-9)


def test_energy_falls_as_printed():
    """V' = -e^T K e with a momentum trajectory, wheels turning, and masses at once."""
    bench = with_momentum(Bench(bed(), COM, period=2e-3))
    begun = with_params(LAW.begin(bench.testbed, TARGET), period=2e-3)
    params = begun[1]
    rows = closed_loop(bench, LAW.step, begun, 16.0, TILTED)[:-1]
    e = np.array([error_of(r, params, INERTIA) for r in rows])
    off = np.array([r.state.shift for r in rows]) + COM
    V = 0.5 * np.sum(e**2, axis=1) + np.sum(off**2, axis=1) / (2 * params.adaption)
    taken = params.gain * np.sum(e**2, axis=1)
    spent = np.concatenate([[0.0], np.cumsum((taken[1:] + taken[:-1]) / 2 * 2e-3)])
    np.testing.assert_allclose(V + spent, V[0], rtol=5e-3)
    assert spent[-1] > 0.2 * V[0]
    assert np.all(np.diff(V) < 1e-9 * V[0])


def test_without_a_trajectory_a_round_platform_moves_masses_by_its_tilt_alone():
    """J = jE, H_d = 0: s = s(0) - Gamma m j (g_b - g_b(0)), at every sample: no convergence."""
    bench = Bench(bed(inertia=ROUND), COM)
    begun = still(LAW.begin(bench.testbed, TARGET))
    rows = closed_loop(bench, LAW.step, begun, 50.0, TILTED)
    turned = np.array([r.gravity - rows[0].gravity for r in rows[:-1]])
    moved = np.array([r.state.shift - rows[0].state.shift for r in rows[:-1]])
    expected = -begun[1].adaption * MASS * 0.3 * turned
    np.testing.assert_allclose(moved, expected, atol=1e-15)
    assert np.abs(moved).max() > 1e-4
    settled = total(rows, bench)[-1]
    np.testing.assert_allclose(np.cross(settled, rows[-1].gravity), 0, atol=1e-8)
    assert np.linalg.norm(settled) > 2e-4


def test_the_null_vector_is_not_balanced_and_the_law_says_so():
    """H_d = 0 from r along g_b: nothing moves, for ever, with 0.4 mm left."""
    q = exponential(np.array([0.1, -0.05, 0.0]))
    bench = Bench(bed(), np.zeros(3))
    down = gravity_at(q, bench) / GRAVITY
    bench = replace(bench, com=4e-4 * down)
    begun = still(LAW.begin(bench.testbed, TARGET))
    rows = closed_loop(bench, LAW.step, begun, 100.0, (q, np.zeros(3)))
    assert np.linalg.norm(total(rows, bench)[-1]) == pytest.approx(4e-4, rel=1e-6)
    assert np.abs([r.rate for r in rows]).max() < 1e-9
    (said,) = rows[-1].command.finished
    assert said.code == "direction_not_swept"
    worst = np.linalg.eigh(rows[-1].state.turns.observed)[1][:, 0]
    assert abs(worst @ down) == pytest.approx(1.0)
    assert [said.numbers[f"axis_{axis}"] for axis in "xyz"] == pytest.approx(worst)


def test_a_moving_trajectory_balances_from_the_null_vector_too():
    q = exponential(np.array([0.1, -0.05, 0.0]))
    bench = Bench(bed(), np.zeros(3))
    bench = replace(bench, com=4e-4 * gravity_at(q, bench) / GRAVITY)
    rows = closed_loop(bench, LAW.step, LAW.begin(bench.testbed, TARGET), 150.0, (q, np.zeros(3)))
    assert np.linalg.norm(total(rows, bench)[-1]) < 1.5e-4


@thorough.whole
def test_it_balances_to_the_target():
    """450 um off, anywhere: at the end masses shift by the target, and NEAR is left at most."""
    bench, target = Bench(bed(), COM), np.array([2e-5, -1e-5, -1e-4])
    rows = closed_loop(bench, LAW.step, LAW.begin(bench.testbed, target), 900.0, TILTED)
    assert rows[-1].command.finished
    np.testing.assert_allclose(rows[-1].command.shift + COM, target, atol=1e-6)
    assert tilts(rows).max() < np.radians(30)


def test_it_balances_to_a_few_motor_steps_with_slow_masses_and_noise():
    """Motor steps of 3.6 um, masses of 5 mm/s, noise of a good attitude filter; 250 s."""
    bench = Bench(bed(masses=rails(speed=0.005, resolution=1e-5)), COM / 4, instant=False,
                  noise=(1e-4, 1e-5), seed=2)  # fmt: skip
    rows = closed_loop(bench, LAW.step, LAW.begin(bench.testbed, TARGET), 250.0, TILTED)
    np.testing.assert_allclose(total(rows, bench)[-1], 0, atol=9e-6)


def test_a_wrong_inertia_is_left_along_up_as_foretold():
    """-dJ W^2 / (m g) of a tenth; W is chosen so that one inertia_sd leaves 4 um."""
    rough = replace(bed(com_sd=1e-5), inertia_sd=0.1)
    bench = Bench(rough, np.array([2e-6, 0, -2e-6]), inertia=1.1 * INERTIA)
    begun = LAW.begin(rough, TARGET)
    assert 0.1 * 0.29 * begun[1].sweep.speed ** 2 / (MASS * GRAVITY) == pytest.approx(4e-6)
    assert begun[1].height == pytest.approx(4e-6)
    faster = begun[1].sweep._replace(speed=2 * begun[1].sweep.speed)
    quick = with_params(begun, sweep=faster, cone=begun[1].cone._replace(expected=1e4))
    rows = closed_loop(bench, LAW.step, quick, 300.0)
    middle = total(rows, bench)[-300:].mean(axis=0)
    np.testing.assert_allclose(middle, [0, 0, -1.6e-5], atol=1.5e-6)


def test_an_offset_along_up_fades_as_fast_as_foretold():
    """The slowest mode's rate: the height after 60 and 120 s, the cone open."""
    bench = Bench(bed(), np.array([0, 0, -5e-5]))
    begun = LAW.begin(bench.testbed, TARGET)
    rows = closed_loop(bench, LAW.step, begun, 121.0)
    height = total(rows, bench)[:, 2]
    foretold = np.exp(-60 * begun[1].cone.decay)
    assert foretold < 0.5
    assert height[1200] / height[600] == pytest.approx(foretold, rel=0.15)


def test_what_the_masses_cannot_follow_does_not_wind_up():
    """s comes to lead what is reported by ``lead`` at most; what it leads by at first is kept."""
    slow = bed(com=(0.0, 0.0, -1e-2), masses=rails(speed=1e-3))
    begun, params = LAW.begin(slow, TARGET)
    bench = Bench(bed(), COM)
    observed = sample(started(bench, LEVEL, np.zeros(3)), bench, np.random.default_rng(0))
    first, command = step(begun, observed, params)
    np.testing.assert_allclose(first.shift, [0, 0, 1e-2])
    np.testing.assert_array_equal(command.shift, first.shift)
    tilted = np.array([4.0, 0, -8.96])
    there = replace(observed, t=0.1, shift=first.shift, gravity=tilted, torque=first.torque)
    led = step(first, there, params)[0].shift - there.shift
    assert np.linalg.norm(led) == pytest.approx(params.lead)


def test_it_does_not_learn_from_torque_that_was_not_given():
    """Saturated wheels: e is then theirs, not gravity's; nor does gravity sweep anything."""
    bench = Bench(bed(), COM)
    begun, params = LAW.begin(bench.testbed, TARGET)
    observed = sample(
        started(bench, LEVEL, np.array([0.0, 0.05, 0.0])), bench, np.random.default_rng(0)
    )
    requested, before = np.array([0.0, -0.1, 0.0]), np.array([0.5, 0.0, -9.7])
    state = State(np.zeros(3), begun.turns, 0.0, before, np.zeros(3), requested)
    starved = step(state, replace(observed, t=0.1), params)[0]
    np.testing.assert_array_equal(starved.shift, np.zeros(3))
    np.testing.assert_array_equal(starved.turns.observed, np.zeros((3, 3)))
    given = step(state, replace(observed, t=0.1, torque=requested), params)[0]
    assert np.linalg.norm(given.shift) > 1e-5
    np.testing.assert_allclose(given.turns.observed, np.diag([0.1, 0.1, 0.0]), atol=1e-12)


def test_an_older_rate_is_brought_up_to_date():
    """On the cone, late by 45 ms of a gyro with ten rows a period: the same torque."""
    at_once = LAW.begin(bed(), TARGET)
    late = LAW.begin(bed(gyro=Gyro(100.0, 1e-5, 0.0)), TARGET)
    assert (at_once[1].late, late[1].late) == pytest.approx((0.0, 0.045))
    sweep, t = late[1].sweep, 40.0
    down = cone(sweep, t)[0]
    want = wanted(sweep, t, down, cross(*cone(sweep, t)[1::-1]))
    bench = Bench(bed(), COM)
    still_there = sample(started(bench, LEVEL, np.zeros(3)), bench, np.random.default_rng(0))
    now = replace(still_there, t=t, gravity=GRAVITY * down, rate=want.rate)
    older = replace(now, rate=want.rate - 0.045 * want.slope)
    torques = []
    for (state, params), observed in ((at_once, now), (late, older)):
        begun = replace(state, start=0.0)
        torques.append(step(begun, observed, params)[1].torque)
    np.testing.assert_allclose(torques[1], torques[0], atol=3e-5)
    taken_as_new = step(replace(late[0], start=0.0), now, late[1])[1].torque
    assert np.linalg.norm(torques[0] - taken_as_new) > 3e-4


def test_it_ends_level_with_masses_at_their_mean_of_a_turn():
    """And says how far it is off: less than NEAR by what it sees, here of no noise."""
    bench = Bench(bed(com_sd=1e-5), np.array([1e-5, 0, -1e-5]))
    rows = closed_loop(bench, LAW.step, LAW.begin(bench.testbed, TARGET), 600.0, TILTED)
    (said,) = rows[-1].command.finished
    assert said.code == "masses_at_rest"
    assert 0 < said.numbers["left"] < NEAR
    assert np.linalg.norm(total(rows, bench)[-1]) < NEAR
    assert tilts(rows)[-1] < np.radians(0.5)
    assert np.linalg.norm(rows[-1].rate) < np.radians(0.2)
    resting = np.array([row.shift for row in rows[-100:]])
    assert np.ptp(resting, axis=0).max() < 1e-9


def test_the_target_is_a_shift_at_the_end():
    """Level again: masses go from where they balance to where the centre of mass is wanted."""
    target = np.array([2e-5, -1e-5, -1e-4])
    state, params = LAW.begin(bed(), target)
    bench = Bench(bed(), COM)
    observed = sample(started(bench, LEVEL, np.zeros(3)), bench, np.random.default_rng(0))
    over = replace(state, start=0.0, shift=-COM, over=one_reason(LawReason.MASSES_AT_REST,
                   turns=8, left=1e-7, height=4e-6))  # fmt: skip
    command = step(over, observed, params)[1]
    assert command.finished
    np.testing.assert_allclose(command.shift, target - COM)
    tilted = replace(observed, gravity=GRAVITY * np.array([0.1, 0.0, -(0.99**0.5)]))
    waiting = step(over, tilted, params)[1]
    assert not waiting.finished
    np.testing.assert_allclose(waiting.shift, -COM)


def test_it_gives_up_when_masses_do_not_come_to_rest():
    """Three times as long as it should take, with a torque that is never the requested one."""
    state, params = LAW.begin(bed(), TARGET)
    bench = Bench(bed(), COM)
    observed = sample(started(bench, LEVEL, np.zeros(3)), bench, np.random.default_rng(0))
    begun = replace(state, start=0.0, torque=np.array([1.0, 0, 0]), gravity=observed.gravity,
                    rest=np.zeros(3))  # fmt: skip
    before = step(begun, replace(observed, t=2.9 * params.cone.expected), params)[0]
    assert not before.over
    (said,) = step(begun, replace(observed, t=3.1 * params.cone.expected), params)[0].over
    assert said.code == "masses_not_at_rest"
    assert said.numbers["past"] == pytest.approx(3.1 * params.cone.expected)
    nothing = replace(begun, turns=begun.turns._replace(rests=(np.inf, 1e-6)))
    late = replace(observed, t=3.1 * params.cone.expected)
    (said,) = step(nothing, late, params)[0].over
    assert said.code == "torque_not_given"


def test_it_says_at_its_start_how_long_it_should_take():
    bench = Bench(bed(), COM)
    begun = LAW.begin(bench.testbed, TARGET)
    rows = closed_loop(bench, LAW.step, begun, 0.3)
    (said,) = rows[0].command.note
    assert said.code == "cone_begins"
    assert said.numbers["expected"] == LAW.expected(begun[1])
    assert not any(row.command.note for row in rows[1:-1])


@pytest.mark.parametrize(
    "bedding",
    [
        {"com_sd": 2e-5},
        {"com_sd": 2e-5, "inertia_sd": 0.05},
        {"com_sd": 1e-5, "wheels": wheels(momentum=0.04, torque=0.005)},
        {"com_sd": 3e-5, "inertia": 20 * INERTIA, "mass": 140.0},
        {"com_sd": 3e-5, "tilt": 15.0},
    ],
    ids=["strong", "inertia open", "weak wheels", "heavy", "narrow"],
)
def test_the_time_that_it_expects_is_the_time_that_it_takes(bedding):
    """One sd off along each axis: within a factor of 1.4, from three minutes to ten."""
    tilt = np.radians(bedding.get("tilt", 30.0))
    own = {key: value for key, value in bedding.items() if key not in ("tilt", "inertia_sd")}
    testbed = replace(bed(**own), tilt_limit=tilt, inertia_sd=bedding.get("inertia_sd", 0.0))
    bench = Bench(testbed, bedding["com_sd"] * np.array([1.0, -1.0, -1.0]))
    begun = LAW.begin(testbed, TARGET)
    rows = closed_loop(bench, LAW.step, begun, 2 * LAW.expected(begun[1]))
    assert rows[-1].command.finished
    assert rows[-1].t / LAW.expected(begun[1]) == pytest.approx(1.0, abs=0.4)


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"wheels": wheels()[:2]}, "wheels or gyros"),
        ({"wheels": wheels(torque=0.04)}, "cone"),
        ({"masses": rails(speed=2e-5)}, "um/s"),
        ({"masses": rails(travel=1e-4)}, "reach"),
        ({"com_sd": 1e-3}, "tilt limit"),
    ],
)
def test_what_cannot_be_stable_is_refused(changes, named):
    with pytest.raises(InputError, match=named):
        LAW.begin(bed(**changes), TARGET)


def test_masses_begin_at_the_prior_centre_of_mass():
    begun = LAW.begin(bed(com=(1e-5, 2e-5, -3e-5)), np.array([0.0, 0.0, -1e-4]))
    np.testing.assert_allclose(begun[0].shift, [-1e-5, -2e-5, 3e-5], atol=1e-18)


def test_it_stops_beyond_the_tilt_limit():
    bench = Bench(bed(), COM)
    first = (exponential(np.array([0.6, 0, 0])), np.zeros(3))
    rows = closed_loop(bench, LAW.step, LAW.begin(bench.testbed, TARGET), 5.0, first)
    assert rows[0].command.finished[0].code == "law_tilted"
