"""PID by masses: recovery, tuning, what it refuses, and what its parts are for."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.elements import height_adjustment, height_step, tilt_pid
from equipoise.control.elements.ziegler_nichols import measured, ultimate
from equipoise.control.laws import pid
from equipoise.control.plant import pendulum
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.units import UM
from tests.support import thorough
from tests.support.outcomes import of_use
from tests.support.simple_loop import (
    CALM,
    INERTIA,
    NOISE,
    Loop,
    Plant,
    fly,
    guess,
    masses,
    table,
)

TURN, RATE = [0.03, -0.02, 0.4], [0.004, -0.003, 0.005]  # 2 deg of tilt, 0.4 deg/s


def flown(seed=0, target=(0.0, 0.0, 0.0), noise=NOISE, truth=None, tilt=TURN, **kwargs):
    begun = pid.begin(guess(), np.array(target))
    plant = Plant(table() if truth is None else truth, tilt, RATE)
    return fly(pid.LAW, begun, Loop(plant, noise, seed), kwargs.pop("duration", 1500), **kwargs)


@pytest.mark.parametrize("seed", thorough.some([1, 2, 3], 1))
def test_a_known_offset_is_removed(seed):
    """From (60, -40, -150) um to 0.1 um sideways; upward to 5 % of the last depth, 10 um."""
    run = flown(seed)
    assert run.finished[0].code == "level_at_target"
    np.testing.assert_allclose(run.left[:2], 0.0, atol=0.1 * UM)
    assert abs(run.left[2]) < 0.6 * UM
    assert np.degrees(run.tilt.max()) < 30


def test_a_target_that_is_not_the_centre_is_reached():
    """Upward to the error of a measurement at 50 um, whose scale is open by 5 %."""
    target = np.array([5.0, -3.0, -40.0]) * UM
    assert np.all(np.abs(flown(4, target).left - target) < [0.1e-6, 0.1e-6, 2.6e-6])


def test_the_tilt_goes_to_zero_at_every_height():
    """Only the sideways part is levelled: the height stays, until a measurement."""
    run = flown()
    measurements = [i for i, c in enumerate(run.commands) if c.measurement is not None]
    first, *later = (i - 24 for i in measurements)  # 6 s before the kick
    np.testing.assert_allclose(run.com[first, :2], 0.0, atol=pid.ROUGH * 436 * UM)
    assert run.com[first, 2] == pytest.approx(-436e-6, abs=1e-6)
    for quiet in later:
        np.testing.assert_allclose(run.com[quiet, :2], 0.0, atol=0.6 * UM)
        assert run.tilt[quiet] < 1e-3


def test_the_relay_finds_what_is_calculated_for_the_true_platform():
    """Guess and truth differ by 7 % in J and 50 um in height; the experiment sees the truth."""
    run = flown(noise=CALM)
    last = next(s for s in run.states if s.phase == "level")
    _, params = pid.begin(guess(), np.zeros(3))
    for i, J in enumerate(np.diag(INERTIA)[:2]):
        a = 14.0 * 9.81 / J
        true = params.loops[i]._replace(gain=a, frequency=float(np.sqrt(a * 435.8e-6)))
        found, expected = measured(last.relays[i], params.loops[i].relay), ultimate(true)
        assert found.gain == pytest.approx(expected.gain, rel=0.12)
        assert found.period == pytest.approx(expected.period, rel=0.08)


SLOW = {"masses": masses(0.1e-3, 1e-5, 1e-6)}  # 1.4 um/s


def swung(seed=0):
    com = np.array([8e-6, -5e-6, -400e-6])
    begun, plant = pid.begin(table(com, **SLOW), np.zeros(3)), Plant(table(com, **SLOW), TURN, RATE)
    return fly(pid.LAW, begun, Loop(plant, NOISE, seed), 170)


def at_last(run):
    """The tilt over the last 5 s before it is swung for a measurement, or of all."""
    swung_at = next(
        (i for i, s in enumerate(run.states) if s.search.way is not None), len(run.tilt)
    )
    return run.tilt[swung_at - 20 : swung_at].max()


def test_masses_ten_times_slower_are_stable_and_slow():
    """0.1 mm/s: a swing of 2 degrees dies out, and the tilt goes down after it."""
    run = swung()
    assert run.tilt[:80].max() > 0.03
    assert at_last(run) < 0.003


def test_without_sparing_slow_masses_do_not_damp(monkeypatch):
    """The same platform with its demand cut off by the masses: late, and the swing stays."""
    monkeypatch.setattr(tilt_pid, "followed_share", lambda *_: 1.0)
    assert at_last(swung()) > 0.01


def test_fine_masses_that_take_long_over_a_coarse_step_are_refused():
    """0.1 mm/s with coarse steps of 0.1 mm: five seconds for half of one."""
    slow = replace(guess(), masses=masses(0.1e-3))
    with pytest.raises(InputError, match="5 s of delay"):
        pid.begin(slow, np.zeros(3))


def test_an_integral_whose_command_was_not_delivered_unwinds():
    """Masses that report no shift while 20 um were asked: I' has minus their difference."""
    state, params = pid.begin(guess(), np.zeros(3))
    loop = Loop(Plant(table(), [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]))
    requested = pendulum.shift_for(params.plant, np.array([20e-6, 0.0]))
    state = replace(state, phase="level", requested=requested, integral=np.zeros(2))
    after, _ = pid.step(state, loop.sample(np.zeros(3), np.zeros(3)), params)
    p, i, _ = params.gains[0]
    np.testing.assert_allclose(after.integral, [pid.PERIOD * 20e-6 * i / p, 0.0], atol=1e-12)


def test_an_uninformative_measurement_ends_the_run_level():
    """The masses go back to where they levelled it, and the sentence says why it hangs."""
    state, params = pid.begin(guess(), np.zeros(3))
    loop, zero = Loop(Plant(table(), TURN, RATE)), np.zeros(3)
    level, observed = np.array([1e-6, 2e-6, 3e-6]), loop.sample(zero, zero)
    way = height_adjustment.once_level(state.search, observed, level)
    state = replace(state, phase="level", search=replace(state.search, level=level, way=way))
    blind = Estimate("trajectory", of_use(False), (), np.zeros((0, 0)))
    state, command = pid.step(state, blind, params)
    np.testing.assert_array_equal(command.shift, level)
    assert not command.finished
    _, command = pid.step(state, replace(observed, shift=level), params)
    assert [reason.code for reason in command.finished] == ["height_not_shown", "hardly_moved"]


def test_measurements_repeat_at_smaller_depth_until_the_height_is_known():
    """An open scale of 5 %: from 436 um it is known to 22, from 65 to 3, from 10 to 0.5."""
    run = flown(5)
    assert run.measurements == 3
    depths = [s.search.height.depth for s in run.states if s.search.level is not None]
    assert min(depths) == height_step.SHALLOW


def late(testbed, delay):
    return replace(testbed, gyro=replace(testbed.gyro, delay=delay))


def test_sensors_that_are_too_late_are_refused():
    pid.begin(late(guess(), 0.1), np.zeros(3))
    with pytest.raises(InputError, match="law pid"):
        pid.begin(late(guess(), 1.2), np.zeros(3))


def test_masses_too_coarse_for_the_relay_are_refused():
    """200 g in steps of 1 mm: 14 um a step, with 17 um of relay."""
    coarse = masses(coarse=1e-3)[:3]
    with pytest.raises(InputError, match="4 steps in"):
        pid.begin(replace(guess(), masses=coarse), np.zeros(3))


def test_an_unstable_loop_is_refused():
    """Gains that are stable half a second late, made six times larger."""
    _, params = pid.begin(guess(), np.zeros(3))
    loop, gains = params.loops[0], params.gains[0]
    pid.check(loop, gains, 0.5)
    with pytest.raises(InputError, match="unstable at"):
        pid.check(loop, type(gains)(*(6 * g for g in gains)), 0.5)


def test_steps_are_pure():
    state, params = pid.begin(guess(), np.zeros(3))
    observed = Loop(Plant(table(), TURN, RATE)).sample(np.zeros(3), np.zeros(3))
    first, second = (pid.step(state, observed, params)[1].shift for _ in range(2))
    np.testing.assert_array_equal(first, second)
