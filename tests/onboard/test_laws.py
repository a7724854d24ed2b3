"""What a board requests is what the library's own laws request of the same samples."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.law import Sample
from equipoise.control.laws import ivanov_25s, pid
from equipoise.control.plant.settling import PERIOD, Rest
from equipoise.dynamics.rigid_body import gravity_of
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential
from equipoise.model.errors import InputError
from equipoise.onboard.plain_python import plain_python
from equipoise.onboard.program import level_by_pid, moves_every_25s
from equipoise.onboard.program.displacements import put_displacements, rails_on, shift_of
from equipoise.onboard.program.request import Request

BED, TARGET = read_preset("nanosat"), np.array([2e-6, -3e-6, -1e-4])


def request(masses=3):
    return Request(np.array([1.0, 0, 0, 0]), *(np.zeros(3) for _ in range(3)), np.zeros(masses),
                   np.zeros(1, np.bool_))  # fmt: skip


def swinging(t, size):
    """Attitude and rate of a platform that swings about two axes."""
    x, y = size * np.sin(0.8 * t), 0.6 * size * np.cos(0.7 * t)
    rate = np.array([0.8 * size * np.cos(0.8 * t), -0.42 * size * np.sin(0.7 * t), 1e-3])
    return exponential(np.array([x, y, 0.3])), rate


def sample(t, size, shift):
    q, rate = swinging(t, size)
    zero = np.zeros(3)
    g = np.array(plain_python(gravity_of)(q, BED.gravity))
    return Sample(t, q, rate, g, np.array(shift), zero, zero, zero, None)


def stepped(own, memory, out, observed):
    """Let a board's PID take a sample."""
    out.attitude[:] = observed.q
    step = plain_python(level_by_pid.step)
    step(own, memory, observed.t, observed.q, observed.rate, tuple(map(float, observed.shift)), out)
    return out.shift.copy()


def test_settling_is_that_of_pid():
    """The same demand and the same end, where the library goes on to its relay."""
    state, params = pid.begin(BED, TARGET)
    own, memory = level_by_pid.pid_on(BED, TARGET)
    out, shift, ended = request(), np.zeros(3), None
    for k in range(400):
        now = sample(PERIOD * k, 0.1 * np.exp(-k / 40), shift)
        state, command = pid.step(state, now, params)
        found = stepped(own, memory, out, now)
        np.testing.assert_allclose(found, command.shift, rtol=1e-12, atol=1e-16)
        shift, ended = command.shift, k
        if state.phase == "relay":
            break
    assert 20 < ended < 399
    assert memory.phase[0] == level_by_pid.LEVEL


def test_levelling_is_that_of_pid():
    """Tilt, rate, integral and anti-windup, with masses that deliver nine tenths."""
    state, params = pid.begin(BED, TARGET)
    own, memory = level_by_pid.pid_on(BED, TARGET)
    out, shift = request(), np.zeros(3)
    start = sample(0.0, 0.05, shift)
    stepped(own, memory, out, start)
    memory.phase[0], memory.fresh[0] = level_by_pid.LEVEL, True
    state = pid.State(
        "level", params.gains, Rest(), state.search, out.shift.copy(), np.zeros(2)
    )  # fmt: skip
    for k in range(1, 200):
        now = sample(PERIOD * k, 0.05, shift)
        state, command = pid.step(state, now, params)
        found = stepped(own, memory, out, now)
        np.testing.assert_allclose(found, command.shift, rtol=1e-10, atol=1e-15)
        shift = 0.9 * command.shift
    assert np.abs(memory.integral).max() > 1e-6


def quiet_until(own, memory, out, phase, t):
    """Let a level platform stand still, masses where they are wanted, until a phase is reached."""
    while memory.phase[0] != phase and t < 1000.0:
        stepped(own, memory, out, sample(t, 0.0, out.shift.copy()))
        t += PERIOD
    assert memory.phase[0] == phase
    return t


def test_the_height_is_measured_raised_and_reached():
    """By hand: 3 sd below the target, then 10 um, then the target itself."""
    own, memory = level_by_pid.pid_on(BED, TARGET)
    out, com = request(), np.array([4e-6, 1e-6, -8.0e-5])
    out.com[:], out.com_sd[:] = com, [1e-7, 1e-7, 9e-6]
    t = quiet_until(own, memory, out, level_by_pid.RECORD, 0.0)
    kick = np.linalg.norm(out.shift[:2])
    assert kick == pytest.approx(0.06 * own.depth, rel=1e-6)
    t = quiet_until(own, memory, out, level_by_pid.LEVEL, t)
    assert memory.depth[0] == pytest.approx(27e-6)  # SURE = 3 times 9 um
    assert memory.along[0] == pytest.approx(-1e-4 + 8.0e-5 - 27e-6)
    out.com_sd[2] = 0.9e-6  # below CLOSE
    t = quiet_until(own, memory, out, level_by_pid.RECORD, t)
    t = quiet_until(own, memory, out, level_by_pid.LEVEL, t)
    assert memory.depth[0] == 1e-5
    t = quiet_until(own, memory, out, level_by_pid.LAST, t)
    assert out.shift[2] == pytest.approx(-1e-4 + 8.0e-5)  # the target, less what is at home
    assert out.shift[:2] == pytest.approx(TARGET[:2])  # level without a shift: so r is sideways 0
    while not out.finished[0]:
        stepped(own, memory, out, sample(t, 0.0, out.shift.copy()))
        t += PERIOD
        assert t < 1000.0


def test_moves_come_when_ivanov_makes_them():
    """25, 50, 75 and 100 s after the first row, to the target less r; the end after 15 s more."""
    own, memory = moves_every_25s.moves_on(BED, TARGET)
    out, step, moved = request(), plain_python(moves_every_25s.step), []
    for k in range(700):
        t = 3.0 + 0.2 * k
        out.com[:] = [1e-6 * k, 0.0, 0.0]
        before = out.shift.copy()
        step(own, memory, t, out.attitude, np.zeros(3), (0.0, 0.0, 0.0), out)
        if np.any(out.shift != before):
            moved.append(t - 3.0)
            np.testing.assert_allclose(out.shift, TARGET - out.com, atol=1e-18)
        if out.finished[0]:
            break
    assert moved == pytest.approx(ivanov_25s.EVERY * np.arange(1, 5), abs=0.21)
    assert t - 3.0 == pytest.approx(115.0, abs=0.21)


def test_displacements_shift_the_centre_of_mass_as_wanted():
    """Of six masses, on whole motor steps, within the travel."""
    bed = read_preset("reference-table")
    rails, wanted, d = rails_on(bed), np.array([30e-6, -20e-6, 12e-6]), np.zeros(6)
    put_displacements(rails, wanted, d)
    step = np.array([mass.resolution for mass in bed.masses])
    np.testing.assert_allclose(d / step, np.round(d / step), atol=1e-9)
    half = np.abs(rails.per_travel).T @ (step / 2)
    assert np.all(np.abs(np.array(shift_of(rails, d)) - wanted) <= half)
    put_displacements(rails, np.array([1.0, -1.0, 1.0]), d)
    assert np.all((d == rails.low) | (d == rails.high))


def test_masses_in_a_plane_are_refused():
    bed = read_preset("nanosat")
    with pytest.raises(InputError, match="three directions"):
        rails_on(replace(bed, masses=bed.masses[:2]))
