"""How late the attitude is stamped, recovered in units of its sd, and by hand."""

import numpy as np
import pytest

from equipoise.assessment.record_checks.clock_offset import clock_offset, offset_findings
from equipoise.maths.attitude import exponential, multiply, normalise
from equipoise.model.recording import Samples
from equipoise.model.testbed import AttitudeSensor, Gyro

STEP = 0.005  # s
CLOCK = np.arange(-2.0, 62.0, STEP)


def turning() -> tuple[np.ndarray, np.ndarray]:
    """Body rates that change within seconds, and the attitudes that they lead to."""
    rate = [0.15 * np.sin(0.9 * CLOCK), 0.12 * np.cos(0.7 * CLOCK), 0.3 + 0.1 * np.sin(0.4 * CLOCK)]
    w = np.stack(rate, axis=1)
    turns = exponential(0.5 * (w[1:] + w[:-1]) * STEP)
    q = [np.array([1.0, 0, 0, 0])]
    for turn in turns:
        q.append(multiply(q[-1], turn))
    return normalise(np.array(q)), w


Q, W = turning()


def observed(lag: float, seed: int, noise: float = 1e-3) -> tuple[Samples, Samples]:
    """A camera that is late, and a gyro with a zero of its own."""
    rng = np.random.default_rng(seed)
    t, late = np.arange(0, 60, 0.1), np.arange(0, 60, 0.02)
    q = Q[np.round((t - lag - CLOCK[0]) / STEP).astype(int)]
    q = multiply(q, exponential(noise * rng.normal(size=(len(t), 3))))
    w = np.stack([np.interp(late, CLOCK, axis) for axis in W.T], axis=1)
    w += [0.01, 0.0, -0.02] + noise * rng.normal(size=w.shape)
    return Samples(t, q), Samples(late, w)


@pytest.mark.parametrize("lag", [-0.3, 0.0, 0.04, 0.5])
def test_a_lag_is_recovered_without_noise(lag) -> None:
    """To a millisecond: the integral by trapezoids and the mean of two rates are not exact."""
    reported = clock_offset(*observed(lag, 0, noise=0.0))
    assert reported is not None
    assert reported.lag == pytest.approx(lag, abs=1e-3)


def test_its_error_is_of_the_size_of_its_sd() -> None:
    """Thirty seeds: the mean square of error over sd is one within a half."""
    reported = [clock_offset(*observed(0.04, seed)) for seed in range(30)]
    errors = [(o.lag - 0.04) / o.sd for o in reported if o is not None]
    assert len(errors) == 30
    assert 0.5 < np.mean(np.square(errors)) < 1.7


def test_a_steady_rotation_yields_no_clock_offset() -> None:
    """Nothing changes, so nothing is late."""
    t = np.arange(0, 60, 0.1)
    q = exponential(np.outer(t, [0, 0, 0.3]))
    rng = np.random.default_rng(0)
    w = np.tile([0, 0, 0.3], (len(t), 1)) + 1e-3 * rng.normal(size=(len(t), 3))
    assert clock_offset(Samples(t, q), Samples(t, w)) is None


def test_the_testbed_is_held_against_it() -> None:
    """A delay of 20 ms and the half of an averaging of 40 ms are a lag of 40 ms."""
    rows = observed(0.04, 1)
    gyro = Gyro(50.0, 1e-3, 1e-2)
    (fits,) = offset_findings(clock_offset(*rows), AttitudeSensor(10.0, 1e-3, 0.02, 0.04), gyro)
    assert fits.kind == "content"
    (wrong,) = offset_findings(clock_offset(*rows), AttitudeSensor(10.0, 1e-3), gyro)
    assert wrong.kind == "problem"
    assert "the testbed states 0 ms" in wrong.sentence
    reported = float(wrong.sentence.split("gyro's by ")[1].split(" ms")[0])
    assert reported == pytest.approx(40, abs=4)


def test_a_gyro_that_is_late_itself_takes_from_the_lag() -> None:
    """70 ms of the camera less 30 ms of the gyro are a lag of 40 ms."""
    gyro = Gyro(50.0, 1e-3, 1e-2, delay=0.03)
    (fits,) = offset_findings(
        clock_offset(*observed(0.04, 1)), AttitudeSensor(10.0, 1e-3, 0.07), gyro
    )
    assert fits.kind == "content"


@pytest.mark.parametrize("seed", range(8))
def test_a_gyro_in_another_unit_shows_no_offset(seed) -> None:
    """Rates in rad/s that are taken for deg/s: the search for a lag runs off the record."""
    attitude, rate = observed(0.04, seed)
    assert clock_offset(attitude, Samples(rate.t, np.radians(rate.values))) is None


@pytest.mark.parametrize("seed", range(4))
def test_a_gyro_that_shows_nothing_but_noise_shows_no_offset(seed) -> None:
    attitude, rate = observed(0.04, seed)
    noise = 1e-3 * np.random.default_rng(seed).normal(size=rate.values.shape)
    assert clock_offset(attitude, Samples(rate.t, noise)) is None
    assert clock_offset(attitude, Samples(rate.t, 0.0 * noise)) is None
