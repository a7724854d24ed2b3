"""Many records at once: each as fitted alone, and true to its covariance."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.output_error.monte_carlo.many_fits import ManyFits, fit_each
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.parameters.fit_parameters import physical
from equipoise.maths.attitude import exponential, logarithm, multiply
from equipoise.maths.linalg import inverse_where
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.recording import Recording, Samples
from equipoise.model.sensor_terms import GROUPS
from equipoise.model.testbed import Testbed
from tests.support.builders import COM, guessed_wrong, level, move_at, noisy, platform, recording

LENGTH = 30.0  # s
SOUGHT = tuple(
    term
    for name in ("plumb", "heading2", "heading3", "camera_delay", "gyro_scale")
    for term in GROUPS[name]
)
DRIVEN = Samples(np.array([0.0, 9.0, 12.0, LENGTH]), np.array([[0.0, 0, 0], [3e-4, 0, -2e-4]] * 2))


@cache
def clean(gyro: float = 0.0, moved: bool = True) -> Recording:
    return recording(LENGTH, move_at(12.0, LENGTH) if moved else None, gyro=gyro)


def drawn(seeds: int, gyro: float = 0.0, moved: bool = True) -> list[Recording]:
    bias = np.array([2e-3, -1e-3, 5e-4])
    return [noisy(clean(gyro, moved), seed, bias) for seed in range(seeds)]


def assert_as_alone(
    found: ManyFits, records: list[Recording], bed: Testbed, params: Params
) -> None:
    """Values to 1e-6 sd, covariance to 1e-6 of itself, and the same way there."""
    for k, record in enumerate(records):
        own = fit(record, bed, params)
        values = physical(own.point, bed.body.mass, own.problem.layout)
        values[:3] = logarithm(own.point.q0)
        covariance = inverse_where(own.at.normal, ~own.problem.prior.held)
        sd = np.sqrt(np.diag(covariance))
        free = sd > 0
        size = np.outer(sd[free], sd[free])
        np.testing.assert_array_less(np.abs(found.values[k] - values), 1e-6 * sd + 1e-13)
        off = found.covariance[k][np.ix_(free, free)] - covariance[np.ix_(free, free)]
        np.testing.assert_array_less(np.abs(off) / size, 1e-6)
        np.testing.assert_allclose(found.cost[k], own.at.cost, rtol=1e-9)
        assert found.names == own.problem.layout.names
        assert (found.converged[k], found.evaluations[k]) == (own.converged, own.evaluations)


@pytest.mark.parametrize(
    ("bed", "gyro", "moved", "params"),
    [
        (platform(), 0.0, True, Params()),
        (guessed_wrong(platform(2e-4)), 0.0, True, Params()),
        (guessed_wrong(platform(2e-4, gyro=True)), 20.0, True, Params(use_prior=True)),
        (platform(gyro=True), 20.0, False, Params()),
        (level(platform(gyro=True)), 20.0, True, Params(robust=True, sensor=SOUGHT)),
    ],
)
def test_each_is_as_alone(bed, gyro, moved, params):
    """Camera alone and with a gyro, errors of masses, priors, an open scale, a sensor's error."""
    records = drawn(6, gyro, moved)
    found = fit_each(records, bed, params)
    assert not found.alone.any()
    assert_as_alone(found, records, bed, params)


def test_known_torques_and_momenta_count():
    """The record says that a torque acts, and fits that nothing else explains find it so."""
    bed = platform()
    driven = [replace(record, torque=DRIVEN, momentum=DRIVEN) for record in drawn(3)]
    found = fit_each(driven, bed)
    assert_as_alone(found, driven, bed, Params())
    assert np.abs(found.values - fit_each(drawn(3), bed).values).max() > 1e-3


@pytest.mark.parametrize("params", [Params(terms=("constant_x",)), Params(hold=("com_x",))])
def test_what_a_compiled_start_does_not_do_is_done_alone(params):
    records = drawn(2)
    found = fit_each(records, platform(), params)
    assert found.alone.all()
    assert_as_alone(found, records, platform(), params)


def test_records_whose_own_speed_decides_the_step_are_fitted_alone():
    """At 80 Hz the noise of a camera looks like 0.6 rad/s, each record like another one."""
    dense = recording(LENGTH, move_at(12.0, LENGTH), camera=80.0)
    records = [noisy(dense, seed) for seed in range(3)]
    found = fit_each(records, platform())
    assert found.alone.tolist() == [False, True, True]
    assert_as_alone(found, records, platform(), Params())


def test_a_record_that_is_lost_is_fitted_alone_and_no_other():
    """Somebody turned the camera by 20 deg half-way."""
    records, bed = drawn(3), platform()
    camera = records[1].attitude
    turn = exponential(np.outer(camera.t > LENGTH / 2, np.radians([0.0, 20.0, 0.0])))
    records[1] = replace(records[1], attitude=Samples(camera.t, multiply(turn, camera.values)))
    found = fit_each(records, bed)
    assert found.alone.tolist() == [False, True, False]
    assert_as_alone(found, records, bed, Params())


def test_the_covariance_is_true():
    """Com of 60 records: errors in sd have a mean square of one within 3 sd of its scatter."""
    found = fit_each(drawn(60, 20.0), platform(gyro=True))
    com = [found.names.index(name) for name in COM_NAMES]
    sd = np.sqrt(np.diagonal(found.covariance, axis1=1, axis2=2))[:, com]
    square = np.mean(((found.values[:, com] - COM) / sd) ** 2)
    assert square == pytest.approx(1.0, abs=3 * np.sqrt(2 / sd.size))


def test_chunks_abreast_are_what_all_at_once_are():
    """Two threads, whose kernels run at the same time."""
    records, bed = drawn(8, 20.0), platform(2e-4, gyro=True)
    whole = fit_each(records, bed)
    with ThreadPoolExecutor(2) as pool:
        halves = list(pool.map(lambda chunk: fit_each(chunk, bed), [records[:4], records[4:]]))
    for name in ("values", "covariance", "cost", "evaluations"):
        parts = np.concatenate([getattr(half, name) for half in halves])
        np.testing.assert_array_equal(parts, getattr(whole, name))


@pytest.mark.parametrize("channel", ["attitude", "masses"])
def test_records_that_differ_in_more_than_what_is_measured_are_refused(channel):
    first, other = drawn(2)
    samples = getattr(other, channel)
    other = replace(other, **{channel: Samples(samples.t + 1e-3, samples.values)})
    with pytest.raises(InputError, match=f"record 1: found '{channel}'"):
        fit_each([first, other], platform())
