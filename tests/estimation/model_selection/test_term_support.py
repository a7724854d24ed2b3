"""How firmly a record supports terms of a fit: ratios worked by hand."""

import numpy as np
import pytest

from equipoise.estimation.model_selection.reference_fit import estimate as identified
from equipoise.estimation.model_selection.survey_reasons import reasons_of_added, term_reasons
from equipoise.estimation.model_selection.term_support import is_supported, support
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.parameters.fit_parameters import sensor_sizes
from equipoise.io.testbed.presets import read_preset
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.torque_terms import GROUPS, typical
from tests.support.builders import move_at, noisy, platform, recording
from tests.support.outcomes import of_use

DRIFT = GROUPS["drift"]
SIZE = typical("drift_x")
SIZES = np.full(3, SIZE)


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
    assert support(found, DRIFT[:1], SIZES[:1]) == pytest.approx(3.80685, abs=1e-5)


def test_a_record_that_shows_nothing_supports_nothing():
    """The posterior is the prior: 2 ln 1 = 0."""
    assert support(estimate_of((0.0, 0.0, 0.0), 1.0), DRIFT, SIZES) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("size", "sure"), [(1.55, False), (1.65, True)])
def test_terms_need_a_lead_of_six(size, sure):
    """x^2 / (1/4) + 3 ln(1/4) = 5.45 at 1.55 typical sizes, 6.73 at 1.65."""
    assert is_supported(estimate_of((size, 0.0, 0.0), 0.25), DRIFT, SIZES) == sure


def test_no_number_no_use_and_no_terms_are_not_supported():
    assert not is_supported(estimate_of((np.nan, 0.0, 0.0), 0.25), DRIFT, SIZES)
    assert not is_supported(estimate_of((9.0, 9.0, 9.0), 0.25, usable=False), DRIFT, SIZES)
    assert not is_supported(estimate_of((9.0, 9.0, 9.0), 0.25), (), np.zeros(0))


GROUPS_OF_ALL = [*sensor_terms.GROUPS.items(), *torque_terms.GROUPS.items()]


@pytest.mark.parametrize(("group", "terms"), GROUPS_OF_ALL, ids=[g for g, _ in GROUPS_OF_ALL])
def test_what_was_added_is_named_by_its_group(group, terms):
    """A gyro's scale and its cross-coupling are different things; both were 'gyro'."""
    first, *to_declare = reasons_of_added(terms)
    assert first.parameters == (group,)
    assert [r.parameters for r in to_declare] == [(group,)] * (group in torque_terms.GROUPS)


@pytest.mark.parametrize("group", [g for g in sensor_terms.GROUPS if g != "plumb"])
@pytest.mark.parametrize(("sizes", "code"), [(0.0, Why.TERMS_CARRIED), (3.0, Why.TERMS_ADDED)])
def test_an_error_of_a_sensor_is_only_said_to_be_there_when_it_is_shown(group, sizes, code):
    """At its prior it may as well be zero; at three sizes with sd 0.3 it may not."""
    terms, testbed = sensor_terms.GROUPS[group], read_preset("sputnix")
    size, sd = sensor_sizes(terms, testbed), 0.3 if sizes else 1.0
    found = tuple(Parameter(t, "", sizes * s, sd * s) for t, s in zip(terms, size, strict=True))
    estimate = Estimate("trajectory", of_use(True), found, np.diag((sd * size) ** 2))
    (reason,) = term_reasons(terms, estimate, testbed)
    assert (reason.code, reason.parameters) == (code, (group,))


def test_torques_are_added_when_they_are_shown_and_no_other_way():
    """Those needed a sure lead to be sought: an open one is not carried."""
    estimate = estimate_of((0.0, 0.0, 0.0), 1.0)
    first, second = term_reasons(DRIFT, estimate, read_preset("sputnix"))
    assert [first.code, second.code] == [Why.TERMS_ADDED, Why.TERMS_TO_DECLARE]


@pytest.mark.parametrize("seed", [0, 8, 9])  # those with something carried, of 0 to 9
def test_a_clean_record_shows_no_error_of_a_sensor(seed):
    """Whatever is carried to be safe, nothing that is not there is said to be supported."""
    found = identified(noisy(recording(60.0, move_at(30.0, 60.0)), seed), platform(), Params())
    codes = [reason.code for reason in found.outcome.reasons]
    assert Why.TERMS_CARRIED in codes
    assert Why.TERMS_ADDED not in codes
