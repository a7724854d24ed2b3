"""What camera, gyro and mass log get wrong, by hand."""

import numpy as np
import pytest
from scipy.stats import binom

from equipoise.maths.attitude import (
    conjugate,
    difference,
    exponential,
    from_euler321,
    level,
    logarithm,
    multiply,
    to_euler321,
    to_matrix,
)
from equipoise.model.defects import CameraErrors, ComStep, Gap, GyroErrors
from equipoise.model.testbed import AttitudeSensor, Gyro
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.sensor_errors import heading, misfelt, misread, whole_angles

UP_Z = np.array([0.0, 0.0, 1.0])
SPIN = {"rate": np.array([0.0, 0.0, 0.2])}


def left(measured, true):
    """Return the rotation vector on the left of ``true``, laboratory axes."""
    return logarithm(multiply(measured, conjugate(true)))


def yawed(degrees):
    return exponential(np.outer(np.radians(degrees), UP_Z))


def test_a_plumb_error_leans_the_laboratory():
    """exp((a, 0, 0)) on the left: body z of a level platform shows at (0, -a, 1)."""
    plumb = np.array([0.005, 0.0, 0.0])
    q = misread(yawed([0, 50, 200]), CameraErrors(plumb=plumb), UP_Z)
    np.testing.assert_allclose(to_matrix(q)[..., 2], np.tile([0, -0.005, 1], (3, 1)), atol=2e-5)


@pytest.mark.parametrize(
    "up", [(0, 0, 1.0), (0, 1.0, 0), (1.0, 0, 0), (0.6, 0, -0.8), (0, 0, -1.0)]
)
def test_heading_is_zero_when_level_and_grows_with_a_turn_about_the_vertical(up):
    """Whichever body axis is up."""
    turned = multiply(yawed([0.0, 30.0, -100.0]), level(np.array(up)))
    np.testing.assert_allclose(heading(turned, np.array(up)), np.radians([0, 30, -100]), atol=1e-14)


@pytest.mark.parametrize("up", [(0, 0, 1.0), (0, 1.0, 0)])
def test_heading_is_that_of_body_x_when_z_or_y_is_up(up):
    q = exponential(np.array([0.3, -0.2, 1.0]))
    x, y, _ = to_matrix(q)[:, 0]
    assert heading(q, np.array(up)) == pytest.approx(np.arctan2(y, x))


def test_heading_errors_stand_in_body_axes():
    """c cos 2 psi + s sin 2 psi: c at 0 deg, s at 45, -c at 90, -s at 135."""
    c, s = np.array([1e-3, 0.0, 2e-3]), np.array([0.0, -2e-3, 1e-3])
    true = yawed([0, 45, 90, 135])
    observed = misread(true, CameraErrors(heading_cos=c, heading_sin=s), UP_Z)
    np.testing.assert_allclose(difference(observed, true), [c, s, -c, -s], atol=1e-15)


def test_the_bench_shows_its_camera_errors(testbed):
    errors = CameraErrors(
        np.array([3e-3, -1e-3, 0]), np.array([0, 1e-3, 0]), np.array([0, 0, 2e-3])
    )
    true, observed = (
        SimulatedBench(testbed(truth={**SPIN, "camera": e}), 0).read(30.0).attitude.values
        for e in (CameraErrors(), errors)
    )
    np.testing.assert_allclose(observed, misread(true, errors, UP_Z), atol=1e-14)
    assert np.abs(left(observed, true)).max() > 2e-3


def test_bad_rows_are_as_many_and_as_wrong_as_stated(testbed):
    """2001 rows, 5 % of them turned by 0.2 rad; the bench says which."""
    errors = CameraErrors(bad_share=0.05, bad_turn=0.2)
    sensor = AttitudeSensor(20.0, 0.0)
    bench = SimulatedBench(testbed(truth={"camera": errors}, attitude=sensor), 3)
    rows = bench.read(100.0).attitude
    off = difference(rows.values, np.array([1.0, 0, 0, 0]))
    bad = np.isin(rows.t, bench.bad_rows)
    np.testing.assert_allclose(np.linalg.norm(off, axis=1), 0.2 * bad, atol=1e-12)
    low, high = binom.ppf([1e-4, 1 - 1e-4], len(rows), 0.05)
    assert low <= np.count_nonzero(bad) <= high
    axes = off[bad] / 0.2  # no axis is preferred: uniform components have a variance of 1/3
    assert np.all(np.abs(axes.mean(axis=0)) < 4 / np.sqrt(3 * len(axes)))
    assert np.all(np.abs(np.mean(axes**2, axis=0) - 1 / 3) < 4 * 0.3 / np.sqrt(len(axes)))


def test_a_gyro_that_sits_turned_sees_the_rate_turn_the_other_way():
    """Turned by a quarter about z, its x lies along body y; then its own axes are off in scale."""
    wrong = GyroErrors(np.array([0.01, -0.02, 0.0]), np.array([0, 0, np.pi / 2]))
    read = misfelt(np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 2.0]]), wrong)
    np.testing.assert_allclose(read, [[1.01, 0, 0], [0, -0.98, 2.0]], atol=1e-15)


def test_the_bench_shows_its_gyro_errors_before_the_bias(testbed):
    """1.01 x 0.2 about z, and the bias as it is."""
    wrong = GyroErrors(scale=np.array([0.0, 0.0, 0.01]))
    truth = {**SPIN, "gyro": wrong, "gyro_bias": np.array([0, 0, 0.1])}
    rate = SimulatedBench(testbed(truth=truth), 0).read(1.0).rate
    np.testing.assert_allclose(rate.values[:, 2], 0.302, atol=1e-12)


def test_rows_come_in_whole_quanta(testbed):
    """0.2 rad/s to the nearest 0.03 is 0.21; yaw 0.2 t to the nearest 0.05."""
    sensors = {
        "attitude": AttitudeSensor(5.0, 0.0, quantum=0.05),
        "gyro": Gyro(50.0, 0.0, 0.0, quantum=0.03),
    }
    rows = SimulatedBench(testbed(truth=SPIN, **sensors), 0).read(10.0)
    np.testing.assert_allclose(rows.rate.values[:, 2], 0.21, rtol=1e-12)
    roll, pitch, yaw = to_euler321(rows.attitude.values)
    np.testing.assert_allclose([roll, pitch], 0, atol=1e-15)
    steps = yaw / 0.05
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-10)
    assert np.abs(yaw - 0.2 * rows.attitude.t).max() == pytest.approx(0.02, abs=1e-9)  # 5 Hz


def test_each_angle_is_rounded_on_its_own():
    q = whole_angles(from_euler321(0.123, -0.456, 2.789)[None], 0.01)
    np.testing.assert_allclose(np.ravel(to_euler321(q)), [0.12, -0.46, 2.79], atol=1e-12)


def test_rows_in_a_gap_are_missing_and_the_others_as_without(testbed):
    """Both ends included; noise is drawn for missing rows, too."""
    sensors = {"attitude": AttitudeSensor(5.0, 1e-3), "gyro": Gyro(50.0, 1e-3, 0.0)}
    gaps = (Gap(1.0, 2.0), Gap(4.1, 4.15))
    whole = SimulatedBench(testbed(**sensors), 0).read(5.0)
    holed = SimulatedBench(testbed(truth={"gaps": gaps}, **sensors), 0).read(5.0)
    for a, b, missing in ((whole.attitude, holed.attitude, 6), (whole.rate, holed.rate, 54)):
        kept = np.isin(a.t, b.t)
        assert np.count_nonzero(~kept) == missing
        np.testing.assert_array_equal(a.values[kept], b.values)


def test_an_outlier_within_a_gap_is_not_listed(testbed):
    truth = {"camera": CameraErrors(bad_share=1.0, bad_turn=0.2), "gaps": (Gap(1.0, 2.0),)}
    bench = SimulatedBench(testbed(truth=truth), 0)
    rows = bench.read(3.0).attitude
    np.testing.assert_array_equal(bench.bad_rows, rows.t)
    assert len(rows) == 10


def test_masses_are_behind_their_report_by_the_lag(testbed, rail):
    """0.5 kg at 10 mm/s on 10 kg: 0.5 mm/s of centre of mass, from 0.3 s after the command on."""
    setup = testbed(
        (0.0, 0.0, -1e-4), masses=(rail(home=(0.0, 0.0, 0.0)),), truth={"mass_lag": 0.3}
    )
    bench = SimulatedBench(setup, 0)
    bench.read(1.0)
    bench.move({"x": 0.02})
    reported = bench.read(1.0).masses.values[-1]
    np.testing.assert_allclose(reported, 0.010)
    np.testing.assert_allclose(bench.displacements, 0.007)
    assert bench.truth().com[0] == pytest.approx(0.5 * 0.007 / 10)
    bench.read(1.2)
    np.testing.assert_allclose(bench.displacements, 0.019)
    bench.read(0.2)
    np.testing.assert_allclose(bench.displacements, 0.020)


def test_late_masses_move_the_platform_late(testbed, rail):
    """Sent at 1.0 s with a lag of 0.307 s, or at 1.307 s without: the same motion.

    Nothing else happens at these moments, so the masses' corners must be nodes of their own.
    """

    def rates(lag, start):
        bench = SimulatedBench(testbed(masses=(rail(),), truth={"mass_lag": lag}), 0)
        bench.read(start)
        bench.move({"x": 0.02})
        return bench.read(6.0 - start).rate.values

    prompt = rates(0.0, 1.307)
    assert np.abs(prompt[-1]).max() > 1e-3
    np.testing.assert_allclose(rates(0.307, 1.0)[-len(prompt) :], prompt, atol=1e-12)


def test_a_defect_leaves_everything_else_as_drawn(testbed):
    """Streams of their own: with outliers the noise of the other rows is the same."""
    sensors = {"attitude": AttitudeSensor(5.0, 1e-3), "gyro": Gyro(50.0, 1e-3, 0.0)}
    errors = CameraErrors(bad_share=0.2, bad_turn=0.2)
    plain = SimulatedBench(testbed(**sensors), 0).read(20.0)
    bench = SimulatedBench(testbed(truth={"camera": errors}, **sensors), 0)
    spoilt = bench.read(20.0)
    good = ~np.isin(plain.attitude.t, bench.bad_rows)
    assert 0 < np.count_nonzero(~good) < len(good) / 2
    np.testing.assert_array_equal(plain.rate.values, spoilt.rate.values)
    np.testing.assert_allclose(
        plain.attitude.values[good], spoilt.attitude.values[good], atol=1e-15
    )


def test_slips_and_lags_do_not_disturb_each_other(testbed, rail):
    steps = (ComStep(0.5, np.array([0, 1e-5, 0])),)
    truth = {"mass_lag": 0.3, "com_steps": steps}
    bench = SimulatedBench(testbed(masses=(rail(home=(0.0, 0.0, 0.0)),), truth=truth), 0)
    bench.move({"x": 0.01})
    bench.read(1.0)
    np.testing.assert_allclose(bench.truth().com, [0.5 * 0.007 / 10, 1e-5, 0], atol=1e-15)
