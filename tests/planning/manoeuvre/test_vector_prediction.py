"""Predictions for platforms without a camera: what fits of simulated records state, and err by."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from equipoise.estimation.information import fisher_information
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.trajectory import Params
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.testbed import Truth
from equipoise.planning.manoeuvre.limit_check import for_search
from equipoise.planning.manoeuvre.noiseless_record import imagined
from equipoise.planning.manoeuvre.predicted_information import predicted
from equipoise.sensors.vector_sensors import vector_sensors
from equipoise.simulation.bench import SimulatedBench
from tests.support.without_camera import KITS, without_camera

BODY = (*INERTIA, *COM)
SWING = Manoeuvre(
    60.0, np.radians(6.0), np.array([1.0, 0.0, 0.0]), np.array([-0.02, -0.01, 0.05]),
    ((30.0, {"x1": -0.010, "y1": -0.010, "z1": -0.050}),),
)  # fmt: skip
RUNS = 12


def recorded(bed, seed):
    """Return a noiseless record with noise and biases as the testbed states them.

    Masses stop where commanded, and so does what is predicted of their stops.
    """
    rng = np.random.default_rng(seed)
    record = imagined(bed, bed.body, SWING).recording
    found = {"rate": noisy(record.rate, bed.gyro, rng)}
    for sensor in vector_sensors(bed):
        found[sensor.channel] = noisy(getattr(record, sensor.channel), sensor, rng)
    return replace(record, **found)


def noisy(rows, sensor, rng):
    bias = rng.normal(0.0, sensor.bias_sd, 3)
    noise = rng.normal(0.0, sensor.noise, rows.values.shape)
    return replace(rows, values=rows.values + bias + noise)


def noiseless(bed):
    """Return the testbed with sensors of vectors that have no noise; the bench has no bias."""
    names = ("gyro", "accelerometer", "sun", "magnetometer")
    sensors = {name: getattr(bed, name) for name in names}
    return replace(bed, **{n: s and replace(s, noise=0.0) for n, s in sensors.items()})


@pytest.mark.parametrize("kit", KITS)
def test_an_imagined_record_is_that_of_the_simulated_bench(kit):
    """Two ways to integrate: they agree to a hundredth of the noise of one row."""
    bed, still = without_camera(kit), replace(SWING, moves=(), duration=20.0)
    made = imagined(bed, bed.body, still)
    roll_pitch_yaw = Rotation.from_quat(made.motion.q[0], scalar_first=True).as_euler("ZYX")[::-1]
    level = np.zeros(3)
    start = Truth(bed.body.com, level, level, bed.body.inertia_P, 0.0, roll_pitch_yaw, 0.0,
                  still.rate, 0.0, {}, 0.0, 30.0, level)  # fmt: skip
    bench = SimulatedBench(replace(noiseless(bed), truth=start), 0).read(20.0)
    for sensor in vector_sensors(bed):
        said, simulated = getattr(made.recording, sensor.channel), getattr(bench, sensor.channel)
        rows = np.searchsorted(simulated.t, said.t)
        assert len(simulated) - len(said) <= 1
        np.testing.assert_allclose(said.values, simulated.values[rows], atol=0.01 * sensor.noise)


@pytest.mark.parametrize("kit", KITS)
def test_it_is_what_observe_says_of_the_recording(kit):
    """`observe` fits the noiseless rows first: sd within 0.3 %.

    It ends a little beside the truth: a mass that starts shakes an accelerometer for a moment.
    """
    bed = without_camera(kit)
    params = Params(bed.disturbances)
    said = predicted(bed, bed.body, SWING, params)
    record = imagined(bed, bed.body, SWING).recording
    observed = fisher_information.information_by(record, bed, params)
    assert said.names == observed.names
    np.testing.assert_allclose(said.sd, observed.sd, rtol=3e-3)


@pytest.mark.parametrize("kit", KITS)
def test_fits_of_noisy_records_state_what_was_predicted_and_err_by_it(kit):
    """Stated sd within 5 %; chi-square of the errors within 4 sd of its mean."""
    bed = without_camera(kit)
    params = Params(bed.disturbances)
    said = predicted(bed, bed.body, SWING, params).sd_of(BODY)
    true = np.append(pack_symmetric(bed.body.inertia_P), bed.body.com)
    squares = []
    for seed in range(RUNS):
        record = recorded(bed, seed)
        found = conclude(trajectory.fit(record, bed, params), "fit", record)
        covariance, error = found.covariance_of(BODY), found.values(BODY) - true
        np.testing.assert_allclose(np.sqrt(np.diag(covariance)), said, rtol=0.05)
        squares.append(error @ np.linalg.solve(covariance, error))
    count = RUNS * len(BODY)
    assert abs(sum(squares) - count) < 4.0 * np.sqrt(2.0 * count)


@pytest.mark.parametrize("kit", KITS)
def test_the_thinned_sensors_of_a_search_say_nearly_the_same(kit):
    """Fewer rows with as much information: sd within 2 %; of stiff drives, as those of a search."""
    bed = without_camera(kit)
    bed = replace(bed, masses=tuple(replace(mass, sag_sd=0.0) for mass in bed.masses))
    params = Params(bed.disturbances)
    exact, quick = (predicted(b, b.body, SWING, params).sd_of(BODY) for b in (bed, for_search(bed)))
    np.testing.assert_allclose(quick, exact, rtol=0.02)


def test_of_gyro_and_accelerometer_the_heading_alone_is_open():
    """Gravity's direction and all of the body are known; one direction is not."""
    bed = without_camera("imu")
    found = predicted(bed, bed.body, SWING, Params(bed.disturbances))
    assert [reason.code for reason in found.unobservable] == ["heading"]
    assert np.isfinite(found.sd_of(BODY)).all()
