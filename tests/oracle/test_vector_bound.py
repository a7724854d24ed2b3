"""The bound that records without a camera are judged by, from runs of MuJoCo alone.

    I = sum over rows S^T S / sd^2 + priors,     S by differences of whole runs of MuJoCo

Body, first attitude and first rate are changed one by one; what the sensors are off by enters as
the matrices say. No line of the estimator is used.
"""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.maths.linalg import unpack_symmetric
from tests.oracle import mujoco_bench as oracle
from tests.oracle.inertial_sensors import accelerometer, vector
from tests.oracle.vector_records import LAMP, LEE, PLACE, case, movable
from verification.vector_sensors import bound_of

SECONDS, SEED = 25.0, 5
SIZE = np.repeat([1e-8, 1e-5, 1e-6, 1e-6], [3, 6, 3, 3])  # m, kg m^2, rad, rad/s: 1e-3 sd or less


def changed(platform, k):
    """Return a platform with one of com, J_P, first attitude and first rate a little larger."""
    step = SIZE * (np.arange(15) == k)
    return replace(
        platform,
        com=platform.com + step[:3],
        inertia_P=platform.inertia_P + unpack_symmetric(step[3:9]),
        q=oracle.product(platform.q, oracle.rotation(step[9:12])),
        rate=platform.rate + step[12:],
    )


def clean_rows(platform, schedule):
    """Return what gyro, accelerometer and sun sensor see of a run, without errors."""
    run = oracle.simulate(platform, schedule, SECONDS)
    rows = oracle.every(run, LEE.gyro.rate)
    force = accelerometer(run, LEE.accelerometer.rate, PLACE, schedule)
    return run.rate[rows], force.values, vector(run, LEE.sun.rate, LAMP).values


def by_errors(clean):
    """Return the columns (n, 3, 12): gyro bias, accelerometer bias, mountings of both sensors."""
    gyro, force, sun = (np.zeros((len(rows), 3, 12)) for rows in clean)
    gyro[:, :, :3] = force[:, :, 3:6] = np.eye(3)
    force[:, :, 6:9] = np.cross(clean[1][:, None, :], np.eye(3)).swapaxes(1, 2)
    sun[:, :, 9:] = np.cross(clean[2][:, None, :], np.eye(3)).swapaxes(1, 2)
    return gyro, force, sun


def test_the_bound_is_that_of_differences_of_whole_runs():
    """Within 1 %, where it is known at which moment between two rows each mass departs."""
    record = case(SEED, LEE, SECONDS)
    platform, schedule = movable(np.random.default_rng([SEED, 77]), SECONDS)
    np.testing.assert_array_equal(platform.com, record.platform.com)
    clean = clean_rows(platform, schedule)
    moved = [clean_rows(changed(platform, k), schedule) for k in range(15)]
    noise = (LEE.gyro.noise, LEE.accelerometer.noise, LEE.sun.noise)
    prior = np.repeat(
        [LEE.gyro.bias_sd, LEE.accelerometer.bias_sd, LEE.accelerometer.mounting_sd,
         LEE.sun.mounting_sd], 3,
    )  # fmt: skip
    information = np.diag(np.append(np.zeros(15), prior**-2.0))
    for i, (rows, errors) in enumerate(zip(clean, by_errors(clean), strict=True)):
        core = np.stack([(moved[k][i] - rows) / SIZE[k] for k in range(15)], axis=2)
        S = np.concatenate([core, errors], axis=2).reshape(-1, 27)
        information += S.T @ S / noise[i] ** 2
    least = np.sqrt(np.diag(np.linalg.inv(information)))[:9]
    bound = bound_of(record, known=("departure", "arrival"))
    np.testing.assert_allclose(np.sqrt(np.diag(bound)), least, rtol=0.01)
    assert (np.diag(bound_of(record)) > np.diag(bound)).all()
