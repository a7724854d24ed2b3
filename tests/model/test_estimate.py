import math

import numpy as np
import pytest

from equipoise.model.estimate import COM, INERTIA, Estimate, Parameter, Residual
from equipoise.model.units import UM
from tests.support.outcomes import of_use


def nine() -> Estimate:
    """com = (1, 2, 3) um and six distinct inertia elements, with a covariance that names pairs."""
    values = [1 * UM, 2 * UM, 3 * UM, 0.11, 0.22, 0.33, 0.12, 0.13, 0.23]
    rows = np.arange(9.0)
    return Estimate(
        method="hand",
        outcome=of_use(),
        parameters=tuple(
            Parameter(name, "m" if name in COM else "kg m2", value, 0.5)
            for name, value in zip(COM + INERTIA, values, strict=True)
        ),
        covariance=np.add.outer(10 * rows, 10 * rows) + np.outer(rows, rows),
    )


def test_interval_by_hand():
    """95 % of a normal distribution: 1.95996 sd on either side."""
    x = Parameter("com_x", "m", 10 * UM, 2 * UM)
    assert x.low95 == pytest.approx(6.08007 * UM, rel=1e-6)
    assert x.high95 == pytest.approx(13.91993 * UM, rel=1e-6)


def test_unseen_parameter_has_an_infinite_interval():
    scale = Parameter("inertia_P_xx", "kg m2", 0.3, math.inf, observable=False)
    assert scale.low95 == -math.inf
    assert scale.high95 == math.inf


def test_com_and_inertia_are_put_together_in_order():
    estimate = nine()
    np.testing.assert_array_equal(estimate.com, [1 * UM, 2 * UM, 3 * UM])
    np.testing.assert_array_equal(
        estimate.inertia_P, [[0.11, 0.12, 0.13], [0.12, 0.22, 0.23], [0.13, 0.23, 0.33]]
    )


def test_covariance_follows_the_requested_names():
    """Entry (i, j) is 10 i + 10 j + i j: com_z is 2, inertia_P_xx is 3."""
    np.testing.assert_array_equal(
        nine().covariance_of(("inertia_P_xx", "com_z")), [[69.0, 56.0], [56.0, 44.0]]
    )


def test_a_name_it_does_not_hold():
    assert nine().has("com_x")
    assert not nine().has("swirl")
    with pytest.raises(KeyError):
        nine().index("swirl")


def test_reduced_chi_square():
    """A fit without freedom left divides by one, not by nothing."""
    assert Residual(None, None, 30.0, 20, 0.0).reduced_chi_square == 1.5
    assert Residual(None, None, 30.0, 0, 0.0).reduced_chi_square == 30.0
