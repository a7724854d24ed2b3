"""Small symmetric systems: by hand, in any units, beside LAPACK."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from equipoise.maths.scaled_solve import scaled_solve


def test_damping_by_hand():
    """Damped by 1 the diagonal doubles: half of Newton's step when A is diagonal."""
    A, b = np.diag([4.0, 1e-12]), np.array([8.0, 3e-12])
    np.testing.assert_allclose(scaled_solve(A, b, 0.0), [2.0, 3.0])
    np.testing.assert_allclose(scaled_solve(A, b, 1.0), [1.0, 1.5])


def test_unseen_parameter_stays():
    """A zero row says nothing about its parameter: no step along it."""
    step = scaled_solve(np.diag([2.0, 0.0]), np.array([2.0, 0.0]), 1e-9)
    np.testing.assert_allclose(step, [1.0, 0.0], atol=1e-8)


@given(st.integers(1, 18), st.integers(0, 2**31), st.sampled_from([0.0, 1e-6, 1.0]))
def test_solution_agrees_with_lapack(n, seed, damping):
    """Any size, units eight decades apart. Compared in units of the diagonal."""
    rng = np.random.default_rng(seed)
    J = rng.normal(size=(3 * n, n)) * 10.0 ** rng.uniform(-4, 4, n)
    A, b = J.T @ J, J.T @ rng.normal(size=3 * n)
    unit = np.sqrt(np.diag(A))
    plain = np.linalg.solve(A / np.outer(unit, unit) + damping * np.eye(n), b / unit)
    np.testing.assert_allclose(scaled_solve(A, b, damping) * unit, plain, rtol=1e-7, atol=1e-9)
