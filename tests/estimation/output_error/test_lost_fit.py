"""A fit that did not find the motion says so, and gives no sd to what means nothing."""

from dataclasses import replace

import numpy as np

from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import METHOD, Params, fit, problem_of
from equipoise.model.outcome import OutcomeCode
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from tests.support.builders import move_at, noisy, platform, recording
from tests.support.outcomes import codes_of

RECORD = noisy(recording(60.0, move_at(20.0, 60.0)), 0)


def lost(hold=()):
    """Return the estimate of a fit that turns the other way, broken off at once."""
    bed, params = platform(), Params(hold=hold)
    good = fit(RECORD, bed, params)
    point = replace(good.point, w0=good.point.w0 + [0.0, 0.0, 0.5])
    return conclude(settle(problem_of(RECORD, bed, params), point, None, 1), METHOD, RECORD)


def test_a_lost_fit_is_an_outcome_of_its_own():
    """Not that something moves the platform: half a radian a second leads far from the record."""
    found = lost()
    assert codes_of(found) == ["motion_not_found"]
    assert found.outcome.code is OutcomeCode.NOT_CONVERGED
    assert not found.outcome.usable
    assert Why.UNEXPLAINED_ATTITUDE not in codes_of(found)


def test_numbers_of_a_lost_fit_have_no_sd_and_held_ones_are_held():
    found = lost(("com_z",))
    held = found.parameters[found.index("com_z")]
    assert held.observable
    assert held.sd < 1e-9
    assert held.value == platform().body.com[2]
    rest = [p for p in found.parameters if p.name != "com_z"]
    assert not any(p.observable for p in rest)
    assert all(np.isinf(p.sd) for p in rest)
