"""The recursive methods on two minutes of known square waves, measured by ordinary sensors."""

from dataclasses import replace
from itertools import cycle

import numpy as np
import pytest

from equipoise.estimation.method_contract import Options, estimated
from equipoise.estimation.methods.registry import METHODS, REGRESSIONS
from equipoise.estimation.motion.fused_motion import led_motion
from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.formulations.rows import Posed
from equipoise.estimation.regression.formulations.tracked import extended
from equipoise.estimation.regression.solvers.recursion import (
    Plan,
    of_extended,
    passed,
    recursion_of,
    some,
    unfiltered,
)
from equipoise.estimation.regression.solvers.recursive import advance, begin
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from tests.support import thorough
from tests.support.builders import COM, INERTIA
from tests.support.driven_records import driven, driven_platform

pytestmark = pytest.mark.usefixtures("few_draws")

EVERY = [module.METHOD.card.name for module in REGRESSIONS]
LONG = 120.0 if thorough.THOROUGH else 60.0  # s
WITH_INERTIA = [name for name in EVERY if name != "simplified_recursive"]


def named(names):
    return pytest.mark.parametrize("name", names)


def run(name, recording, testbed, options=None):
    return estimated(METHODS[name], recording, testbed, options or Options())


@pytest.mark.parametrize(("name", "seed"), list(zip(WITH_INERTIA, cycle([1, 2]))))
def test_inertia_and_centre_of_mass_are_found(name, seed):
    """Noise and bias of a gyro of 0.05 deg/s: moments to 1 %, products to 5 g m2, com to 5 um.

    Slopes of a cubic through half a second are so noisy that they bias J by up to 5 %. Everything
    is within 4 of its stated sd, the bias that noise brings among them.
    """
    found = run(name, driven(seed, LONG), driven_platform())
    values = found.values((*INERTIA_NAMES, *COM_NAMES))
    np.testing.assert_allclose(
        values[:3], INERTIA[:3], rtol=0.05 if name == "torque_recursive" else 0.01
    )
    np.testing.assert_allclose(values[3:6], INERTIA[3:], atol=5e-3)
    np.testing.assert_allclose(values[6:], COM, atol=5e-6)
    sd = np.sqrt(np.diag(found.covariance_of((*INERTIA_NAMES, *COM_NAMES))))
    assert np.all(np.abs(values - [*INERTIA, *COM]) < 4 * sd)


@named(EVERY)
def test_course_ends_at_the_estimate(name):
    estimate = run(name, driven(1, LONG / 4), driven_platform())
    names = estimate.course.names
    assert set(names) == {p.name for p in estimate.parameters}
    assert np.all(np.diff(estimate.course.t) > 0)
    np.testing.assert_array_equal(estimate.course.values[-1], estimate.values(names))
    sd = np.sqrt(np.diag(estimate.covariance_of(names)))
    np.testing.assert_allclose(estimate.course.sd[-1], sd, rtol=1e-12)


@named(thorough.some(EVERY, 3))
def test_inertia_can_be_held(name):
    """Held at the truth, J leaves the parameters, and com is found."""
    bed = driven_platform()
    bed = replace(bed, body=replace(bed.body, inertia_P=unpack_symmetric(INERTIA)))
    estimate = run(name, driven(1, LONG / 2), bed, Options(hold=INERTIA_NAMES))
    assert tuple(p.name for p in estimate.parameters) == COM_NAMES
    rough = 20e-6 if name == "simplified_recursive" else 1e-6
    np.testing.assert_allclose(estimate.com, COM, atol=rough)


@named(thorough.some(WITH_INERTIA, 2))
def test_terms_are_estimated(name):
    """A constant torque that is not there is found to be none: five sd."""
    options = Options(terms=("constant_x", "constant_y", "constant_z"))
    estimate = run(name, driven(1, LONG), driven_platform(), options)
    for term in options.terms:
        there = estimate.parameters[estimate.index(term)]
        assert abs(there.value) < 5 * there.sd
        assert there.unit == "N m"


@named(WITH_INERTIA)
def test_free_motion_gives_ratios(name):
    """Any multiple of J and com would do."""
    estimate = run(name, replace(driven(1, LONG / 4), torque=None), driven_platform())
    assert estimate.unobservable[0].code == "scale"
    assert not any(p.observable for p in estimate.parameters)
    assert estimate.ratios


@named(EVERY)
def test_record_without_rows_is_refused(name):
    assert not run(name, driven(1, 0.05), driven_platform()).outcome.usable


def test_record_shorter_than_the_filter_is_refused():
    assert not run("td_td_rls", driven(1, 1.0), driven_platform()).outcome.usable


def test_what_is_not_heeded_is_an_error():
    with pytest.raises(InputError, match="prior"):
        run("etd_rls", driven(1, 5.0), driven_platform(), Options(use_prior=True))


def test_row_by_row_is_all_at_once():
    """Rows of a record given one by one, as live, and together, as from a file: identical."""
    bed, record = driven_platform(), driven(1, 5.0)
    rows = body_axes(Posed(record, bed, led_motion(record, bed)))
    plan = Plan(unfiltered)
    whole = passed(plan, bed, rows)
    recursion = recursion_of(plan, bed, rows)
    state = begin(recursion, True)
    for k in range(len(rows.t)):
        state, _, _ = advance(recursion, state, some(rows, slice(k, k + 1)))
    np.testing.assert_array_equal(state.x, whole.state.x)
    np.testing.assert_array_equal(state.P, whole.state.P)


def test_centre_of_mass_that_steps_is_followed_with_forgetting():
    """com_z steps by 20 um half-way; forgetting in 10 s follows it, J held; all rows do not."""
    bed, record = driven_platform(), driven(3)
    rows = extended(Posed(record, bed, led_motion(record, bed)))
    later = (rows.t > 60.0)[:, None]
    torque = rows.A[:, :, 8] - rows.A[np.searchsorted(rows.t, 60.0), :, 8]
    rows = replace(rows, b=rows.b + later * torque * 20e-6 - rows.A[:, :, :6] @ INERTIA)
    rows = replace(rows, A=rows.A[:, :, 6:], names=rows.names[6:])
    follows, remains = (
        passed(Plan(of_extended, forget=forget), bed, rows).values[-1] for forget in (10.0, np.inf)
    )
    assert follows[2] == pytest.approx(COM[2] + 20e-6, abs=2e-6)
    assert abs(remains[2] - COM[2] - 20e-6) > 4e-6


def test_recursive_is_batch_without_forgetting():
    """The same rows, axes weighed alike, the loose start's share aside: within 1 % of an sd."""
    names = (*INERTIA_NAMES, *COM_NAMES)
    bed = driven_platform()
    ball = replace(bed, body=replace(bed.body, inertia_P=0.5 * np.eye(3)))
    one, all_rows = (run(n, driven(1, LONG), ball) for n in ("momentum_recursive", "momentum_body"))
    sd = np.sqrt(np.diag(all_rows.covariance_of(names)))
    assert np.all(np.abs(one.values(names) - all_rows.values(names)) < 0.01 * sd)
