"""The recursive methods on two minutes of known square waves, seen by ordinary sensors."""

from dataclasses import replace

import numpy as np
import pytest
from builders import COM, INERTIA
from driven import driven, driven_platform

from equipoise.estimation import recursive_methods
from equipoise.estimation.formulations.rows import Posed
from equipoise.estimation.led_motion import led_motion
from equipoise.estimation.method import Options, estimated
from equipoise.estimation.methods import (
    averaged_recursive,
    etd_rls,
    momentum_recursive,
    simplified_recursive,
    td_td_rls,
    torque_recursive,
)
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.recording import Samples

WITH_INERTIA = (torque_recursive, momentum_recursive, averaged_recursive, td_td_rls, etd_rls)
EVERY = (*WITH_INERTIA, simplified_recursive)


def named(modules):
    return pytest.mark.parametrize("method", modules, ids=lambda m: m.METHOD.card.name)


@pytest.fixture(scope="module")
def posed():
    bed = driven_platform()
    return [Posed(r, bed, led_motion(r, bed)) for r in (driven(1), driven(2))]


@named(WITH_INERTIA)
def test_inertia_and_centre_of_mass_are_found(method, posed):
    """Noise and bias of a gyro of 0.05 deg/s: moments to 0.5 %, products to 2 g m2, com to 1 um.

    Eight records spread by 0.02 to 0.06 % and 0.1 um; noise in the rates takes up to 0.25 %.
    """
    for each in posed:
        rows = recursive_methods.rows_of(method.PLAN, each, ())
        found = recursive_methods.solve(method.PLAN, each, rows)
        np.testing.assert_allclose(found.values[:3], INERTIA[:3], rtol=5e-3)
        np.testing.assert_allclose(found.values[3:6], INERTIA[3:], atol=2e-3)
        np.testing.assert_allclose(found.values[6:], COM, atol=1e-6)


@named(EVERY)
def test_course_ends_at_the_estimate(method):
    estimate = estimated(method.METHOD, driven(1, 30.0), driven_platform(), Options())
    assert estimate.outcome.usable
    names = tuple(p.name for p in estimate.parameters)
    assert estimate.course.names == names
    assert names[:3] == COM_NAMES
    assert np.all(np.diff(estimate.course.t) > 0)
    np.testing.assert_array_equal(estimate.course.values[-1], estimate.values(names))
    np.testing.assert_allclose(
        estimate.course.sd[-1], [p.sd for p in estimate.parameters], rtol=1e-12
    )
    assert np.linalg.eigvalsh(estimate.covariance).min() > 0


@named(EVERY)
def test_inertia_can_be_held(method):
    """Held at the truth, J leaves the parameters, and com is found."""
    bed = driven_platform()
    bed = replace(bed, body=replace(bed.body, inertia_P=unpack_symmetric(INERTIA)))
    estimate = method.METHOD.run(driven(1, 60.0), bed, Options(hold=INERTIA_NAMES))
    assert tuple(p.name for p in estimate.parameters) == COM_NAMES
    assert estimate.covariance.shape == (3, 3)
    rough = 20e-6 if method is simplified_recursive else 1e-6
    np.testing.assert_allclose(estimate.com, COM, atol=rough)


@named(WITH_INERTIA)
def test_terms_are_estimated(method):
    """A constant torque that is not there is found to be none: five sd, or 2e-5 of 1e-2 N m."""
    options = Options(terms=("constant_x", "constant_y", "constant_z"))
    estimate = estimated(method.METHOD, driven(1), driven_platform(), options)
    for name in options.terms:
        there = estimate.parameters[estimate.index(name)]
        assert abs(there.value) < max(5 * there.sd, 2e-5)
        assert there.unit == "N m"


@named(WITH_INERTIA)
def test_nothing_known_that_acts_is_refused(method):
    """Any multiple of J and com would do."""
    estimate = method.METHOD.run(
        replace(driven(1, 30.0), torque=None), driven_platform(), Options()
    )
    assert not estimate.outcome.usable
    assert "scale" in estimate.outcome.sentence


@named(EVERY)
def test_record_without_rows_is_refused(method):
    short = driven(1, 0.05)
    assert not method.METHOD.run(short, driven_platform(), Options()).outcome.usable


def test_record_shorter_than_the_filter_is_refused():
    estimate = td_td_rls.METHOD.run(driven(1, 1.0), driven_platform(), Options())
    assert not estimate.outcome.usable


def test_what_is_not_heeded_is_an_error():
    with pytest.raises(InputError, match="prior"):
        estimated(etd_rls.METHOD, driven(1, 5.0), driven_platform(), Options(use_prior=True))


def test_piece_that_the_filter_does_not_fill_is_told():
    """A second of record between gaps: two differentiators settle in 2.4 s."""
    record = driven(1, 20.0)
    t = record.rate.t
    keep = (t < 9.0) | ((t > 10.0) & (t < 11.0)) | (t > 12.0)
    record = replace(record, rate=Samples(t[keep], record.rate.values[keep]))
    estimate = td_td_rls.METHOD.run(record, driven_platform(), Options())
    assert "shorter than the filter" in estimate.outcome.sentence


def test_centre_of_mass_that_steps_is_followed_with_forgetting():
    """com_z steps by 20 um half-way; forgetting in 10 s follows it, J held; all rows do not."""
    bed, record = driven_platform(), driven(3)
    posed = Posed(record, bed, led_motion(record, bed))
    rows = recursive_methods.rows_of(etd_rls.PLAN, posed, ())
    truth = np.concatenate([INERTIA, COM])
    later = (rows.t > 60.0)[:, None]
    torque = rows.A[:, :, 8] - rows.A[np.searchsorted(rows.t, 60.0), :, 8]
    rows = replace(rows, b=rows.b + later * torque * 20e-6 - rows.A[:, :, :6] @ truth[:6])
    rows = replace(rows, A=rows.A[:, :, 6:], names=rows.names[6:])
    follows = recursive_methods.solve(replace(etd_rls.PLAN, forget=10.0), posed, rows)
    remains = recursive_methods.solve(etd_rls.PLAN, posed, rows)
    assert follows.values[2] == pytest.approx(COM[2] + 20e-6, abs=2e-6)
    assert abs(remains.values[2] - COM[2] - 20e-6) > 4e-6


def test_what_is_left_of_the_rows_is_noise_of_the_rates():
    """Chi-square near its number for rows whose noise is that of w alone; J is 10 % off in it."""
    estimate = momentum_recursive.METHOD.run(driven(1), driven_platform(), Options())
    assert 0.7 < estimate.residual.reduced_chi_square < 1.3
    assert abs(estimate.residual.lag_one) < 0.1
