"""How firmly a record supports terms of a fit: ratios worked by hand."""

import numpy as np
import pytest

from equipoise.estimation.model_selection.survey_reasons import reasons_of_added
from equipoise.estimation.model_selection.term_support import is_supported, support
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.torque_terms import GROUPS, typical
from tests.support.outcomes import of_use

DRIFT = GROUPS["drift"]
SIZE = typical("drift_x")


def estimate_of(drift, variance, usable=True):
    """An estimate of drift alone, in typical sizes, with the same variance about every axis."""
    sd = SIZE * float(np.sqrt(variance))
    found = tuple(
        Parameter(name, "m/s", SIZE * value, sd) for name, value in zip(DRIFT, drift, strict=True)
    )
    return Estimate("trajectory", of_use(usable), found, sd**2 * np.eye(3))


def test_support_is_the_ratio_of_the_marginal_likelihoods():
    """Of y = b + noise, b and noise N(0, 1): ln ratio is that of N(3; 0, 2) over N(3; 0, 1).

    b is N(3/2, 1/2) then, and 2 ln ratio = -ln 2 - 9/2 + 9 = 3.80685.
    """
    found = estimate_of((1.5, 0.0, 0.0), 0.5)
    assert support(found, DRIFT[:1]) == pytest.approx(3.80685, abs=1e-5)


def test_a_record_that_shows_nothing_supports_nothing():
    """The posterior is the prior: 2 ln 1 = 0."""
    assert support(estimate_of((0.0, 0.0, 0.0), 1.0), DRIFT) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("size", "sure"), [(1.55, False), (1.65, True)])
def test_terms_need_a_lead_of_six(size, sure):
    """x^2 / (1/4) + 3 ln(1/4) = 5.45 at 1.55 typical sizes, 6.73 at 1.65."""
    assert is_supported(estimate_of((size, 0.0, 0.0), 0.25), DRIFT) == sure


def test_no_number_no_use_and_no_terms_are_not_supported():
    assert not is_supported(estimate_of((np.nan, 0.0, 0.0), 0.25), DRIFT)
    assert not is_supported(estimate_of((9.0, 9.0, 9.0), 0.25, usable=False), DRIFT)
    assert not is_supported(estimate_of((9.0, 9.0, 9.0), 0.25), ())


GROUPS_OF_ALL = [*sensor_terms.GROUPS.items(), *torque_terms.GROUPS.items()]


@pytest.mark.parametrize(("group", "terms"), GROUPS_OF_ALL, ids=[g for g, _ in GROUPS_OF_ALL])
def test_what_was_added_is_named_by_its_group(group, terms):
    """A gyro's scale and its cross-coupling are different things; both were 'gyro'."""
    first, *to_declare = reasons_of_added(terms)
    assert first.parameters == (group,)
    assert [r.parameters for r in to_declare] == [(group,)] * (group in torque_terms.GROUPS)
