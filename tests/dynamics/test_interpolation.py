"""The state between steps, and its mean over a sensor's averaging: the cubic of ``hermite``."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.polynomial import Polynomial

from equipoise.dynamics.propagation import hermite, interpolate
from equipoise.maths.attitude import difference, multiply, normalise
from tests.support.builders import ATTITUDE, body, line_of, travel

FAST = np.array([0.3, -0.2, 0.5])  # rad/s


def read(f: Polynomial, h: float, share: float, spread: float) -> float:
    """Return what the weights make of a polynomial on the step from 0 to h."""
    slope = f.deriv()
    ends = (f(0.0), slope(0.0), f(h), slope(h))
    return float(np.dot(hermite(h, share, spread), ends))


@pytest.mark.parametrize(
    ("coefficients", "expected"),
    [
        ([1], 1.0),
        ([0, 1], 1.0),
        ([0, 0, 1], 13 / 12),  # (1.5^3 - 0.5^3) / 3
        ([0, 0, 0, 1], 1.25),  # (1.5^4 - 0.5^4) / 4
    ],
    ids=["1", "t", "t2", "t3"],
)
def test_mean_over_a_second_by_hand(coefficients, expected):
    """A step of 2 s, a window from 0.5 to 1.5 s: moments of variance 1/12 s^2 about its middle."""
    found = read(Polynomial(coefficients), 2.0, 0.5, 1 / 12)
    assert found == pytest.approx(expected, rel=1e-14)


@given(
    arrays(np.float64, 4, elements=st.floats(-2, 2)),
    st.floats(0.01, 2.0),
    st.floats(-0.3, 1.3),
    st.floats(0.0, 3.0),
)
def test_mean_of_any_cubic_over_any_window(coefficients, h, share, width):
    """Windows that reach beyond the step, or are wider than it, included."""
    f, middle = Polynomial(coefficients), share * h
    whole = f.integ()
    wide = width * h
    mean = (
        (whole(middle + wide / 2) - whole(middle - wide / 2)) / wide if wide > 1e-3 else f(middle)
    )
    spread = wide**2 / 12 if wide > 1e-3 else 0.0
    assert read(f, h, share, spread) == pytest.approx(mean, abs=1e-10)


# --- Attitudes --------------------------------------------------------------------------------


def slope_of(q, w):
    """Return q' = q (0, w) / 2."""
    return 0.5 * multiply(q, np.concatenate([[0.0], w]))


def read_attitude(motion, line, share, spread):
    """Return the attitude within the step between the first and the last node."""
    ends = [(motion.q[i], slope_of(motion.q[i], motion.rate[i])) for i in (0, -1)]
    out = np.empty(4)
    interpolate(*ends[0], *ends[1], line.t[-1], share, spread, out)
    return out


@pytest.mark.parametrize("share", [0.3, 0.5, 0.7])
def test_averaged_attitude_is_the_mean_of_quaternions(share):
    """A tumbling platform, a step of 0.2 s, windows of 0.1 s: the mean of 201 quaternions.

    The rate turns within the body, so that mean and middle are 7e-5 rad apart. What the cubic
    leaves out is of order (w h / 2)^4 / 24 = 6e-7 for 0.62 rad/s.
    """
    line = line_of(np.linspace(0, 0.2, 401), step=1.0)
    motion = travel(line, body(), q0=ATTITUDE, w0=FAST)
    first = round(share * 400) - 100
    mean = normalise(motion.q[first : first + 201].mean(axis=0))
    spread = (np.arange(201) * 0.2 / 400).var()
    found, middle = (read_attitude(motion, line, share, s) for s in (spread, 0.0))
    assert np.linalg.norm(difference(middle, mean)) > 5e-5
    assert np.linalg.norm(difference(found, mean)) < 1e-6
    assert np.linalg.norm(found) == pytest.approx(1.0, abs=1e-15)
