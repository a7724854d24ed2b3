"""Wheels, gyros, coils and jets of the simulated bench: closed forms, and laws of nature."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.maths.attitude import to_matrix
from equipoise.model.devices import (
    ControlMomentGyro,
    JetPair,
    MagneticField,
    Magnetorquer,
    ReactionWheel,
)
from equipoise.model.errors import DriveRefused, InputError
from equipoise.model.testbed import AttitudeSensor, Gyro
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.followers import at_rest, driven, followed

EYE = np.eye(3)
SENSORS = {"attitude": AttitudeSensor(100.0, 0.0), "gyro": Gyro(100.0, 0.0, 0.0)}
WHEELS = tuple(
    ReactionWheel(f"w{axis}", EYE[i], 1e-4, 600.0, 5e-3, speed=100.0 * i, lag=0.02)
    for i, axis in enumerate("xyz")
)
GYROS = (
    ControlMomentGyro("g1", EYE[2], EYE[0], 0.05, 1.0, 0.3, lag=0.05, gimbal_inertia=2e-4,
                      asymmetry=1e-4),
    ControlMomentGyro("g2", EYE[0], EYE[1], 0.04, 1.0, -0.2, gimbal_inertia=1e-4, asymmetry=2e-4),
)  # fmt: skip
COILS = tuple(Magnetorquer(f"m{axis}", EYE[i], 0.4) for i, axis in enumerate("xyz"))
JETS = (JetPair("jx", EYE[0], 0.02, 0.01, lag=0.002),)
FIELD = np.array([40e-6, -20e-6, -60e-6])


def with_devices(bed):
    """Return a testbed with one device of every kind."""
    return replace(
        bed, wheels=WHEELS, cmgs=GYROS, magnetorquers=COILS, jets=JETS,
        magnetic_field=MagneticField(FIELD),
    )  # fmt: skip


def test_a_follower_is_the_closed_form_of_its_lag():
    wheel = at_rest(np.array([0.5]), np.array([np.inf]), np.array([10.0]))
    wheel = driven(wheel, 1.0, {0: 4.0}, {})
    y, Y = followed(wheel, np.array([0.5, 1.0, 1.5, 3.0]))
    late = 1 - np.exp(-np.array([0.0, 0.0, 1.0, 4.0]))
    np.testing.assert_allclose(y[:, 0], 4.0 * late, rtol=1e-12)
    x = np.array([0.0, 0.0, 0.5, 2.0])
    np.testing.assert_allclose(Y[:, 0], 10.0 + 4.0 * (x - 0.5 * late), rtol=1e-12)


def test_a_pulse_ends_by_itself_and_gives_its_impulse():
    jet = driven(at_rest(np.array([0.01]), np.array([np.inf]), np.zeros(1)), 0.0, {0: 0.02},
                 {0: 0.3})  # fmt: skip
    _, Y = followed(jet, np.array([10.0]))
    assert Y[0, 0] == pytest.approx(0.02 * 0.3, rel=1e-12)


def test_an_input_that_is_not_named_goes_on():
    two = at_rest(np.zeros(2), np.full(2, np.inf), np.zeros(2))
    two = driven(driven(two, 0.0, {0: 1.0, 1: 2.0}, {0: 5.0}), 2.0, {1: -1.0}, {})
    _, Y = followed(two, np.array([2.0, 4.0, 8.0]))
    np.testing.assert_allclose(Y, [[2.0, 4.0], [4.0, 2.0], [5.0, -2.0]], rtol=1e-12)


def test_a_wheel_at_its_limit_stays_there_until_driven_back():
    wheel = driven(at_rest(np.zeros(1), np.array([5.0]), np.zeros(1)), 0.0, {0: 1.0}, {})
    assert followed(wheel, np.array([9.0]))[1][0, 0] == 5.0
    back = driven(wheel, 10.0, {0: -1.0}, {})
    assert followed(back, np.array([12.0]))[1][0, 0] == pytest.approx(3.0)


def inertia_with_gimbals(bench, rows):
    """Return J (n, 3, 3) with the gimbals as they stand, computed gyro by gyro."""
    J = np.repeat(bench.platform.body.inertia_P[None], len(rows), axis=0)
    for k, gyro in enumerate(GYROS):
        n = np.cross(gyro.gimbal_axis, gyro.spin_axis)
        x = rows[:, 3 + k, None]
        s = np.cos(x) * gyro.spin_axis + np.sin(x) * n
        now = np.einsum("ni,nj->nij", s, s)
        J += gyro.asymmetry * (now - np.outer(gyro.spin_axis, gyro.spin_axis))
    return J


def momentum_N(bench, recording):
    """Return R (J w + h) at every row, from what the bench reports with perfect sensors."""
    assert recording.devices is not None
    rows, w = recording.devices.values, recording.rate.values
    h = np.einsum("nij,nj->ni", inertia_with_gimbals(bench, rows), w) + recording.momentum.values
    return np.einsum("nij,nj->ni", to_matrix(recording.attitude.values), h)


def test_wheels_and_gimbals_keep_the_total_momentum(testbed):
    start = {"attitude": np.array([0.1, 0.2, 0.3]), "rate": np.array([0.03, 0.02, -0.025])}
    bench = SimulatedBench(with_devices(testbed((0.0, 0.0, 0.0), truth=start, **SENSORS)), 0)
    first = bench.read(1.0)
    bench.drive({"wx": 1e-3, "wy": -2e-3, "wz": 5e-4, "g1": 0.4, "g2": -0.3})
    bench.read(7.0)
    bench.drive({"wx": -2e-3, "wy": 1e-3, "g1": -0.5, "g2": 0.6})
    later = bench.read(30.0)
    begin, end = momentum_N(bench, first)[0], momentum_N(bench, later)[500:]
    assert np.abs(end - begin).max() < 2e-6 * np.linalg.norm(begin)  # slopes of angles: 1e-6


def test_a_coil_turns_the_platform_as_dipole_cross_field(testbed):
    start = {"attitude": np.array([0.2, -0.1, 0.5]), "rate": np.array([0.02, 0.05, -0.03])}
    bench = SimulatedBench(with_devices(testbed((0.0, 0.0, 0.0), truth=start, **SENSORS)), 0)
    bench.read(1.0)
    bench.drive({"mx": 0.3, "my": -0.2, "mz": 0.4})
    observed = bench.read(20.0)
    L = momentum_N(bench, observed)
    R = to_matrix(observed.attitude.values)
    torque_N = np.cross(np.einsum("nij,j->ni", R, [0.3, -0.2, 0.4]), FIELD)
    t = observed.attitude.t
    steps = 0.5 * (torque_N[1:] + torque_N[:-1]) * np.diff(t)[:, None]
    found = (L - L[0])[10:] - (np.cumsum(steps, axis=0))[9:]
    assert np.ptp(found, axis=0).max() < 1e-5 * np.abs(L - L[0]).max()


def test_a_jet_gives_its_impulse(testbed):
    start = {"attitude": np.zeros(3), "rate": np.zeros(3)}
    bench = SimulatedBench(with_devices(testbed((0.0, 0.0, 0.0), truth=start, **SENSORS)), 0)
    bench.read(1.0)
    before = momentum_N(bench, bench.read(0.5))[-1]
    bench.drive({"jx": 1e-3})
    after = momentum_N(bench, bench.read(1.0))[-1]
    np.testing.assert_allclose(after - before, [1e-3, 0, 0], atol=5e-7)


def test_what_a_jet_reports_adds_up_to_its_impulse(testbed):
    """The mean since the row before: no pulse is lost between two rows, nor over a read."""
    bench = SimulatedBench(with_devices(testbed((0.0, 0.0, 0.0), **SENSORS)), 0)
    bench.read(1.003)
    for impulse in (1e-3, -4e-4, 2.5e-4):
        bench.drive({"jx": impulse})
        rows = np.concatenate([bench.read(0.047).devices.values, bench.read(0.5).devices.values])
        assert rows[:, -1].sum() / 100.0 == pytest.approx(impulse, rel=1e-9)


def test_tachometers_and_encoders_err_by_their_noise_and_not_at_rest(testbed):
    bed = with_devices(testbed((0.0, 0.0, 0.0), **SENSORS))
    noisy = replace(
        bed, wheels=tuple(replace(w, speed_noise=0.3) for w in WHEELS),
        cmgs=tuple(replace(g, angle_noise=2e-3) for g in GYROS),
    )  # fmt: skip
    rows = SimulatedBench(noisy, 0).read(60.0).devices.values
    np.testing.assert_array_equal(rows[:, 0], 0.0)  # the first wheel stands
    np.testing.assert_allclose(rows[:, 1:5].mean(axis=0), [100, 200, 0.3, -0.2], atol=0.02)
    np.testing.assert_allclose(rows[:, 1:5].std(axis=0), [0.3, 0.3, 2e-3, 2e-3], rtol=0.05)


def test_coils_are_in_the_field_as_it_really_is(testbed):
    """Truth has it along y; the testbed as stated has not."""
    start = {"attitude": np.zeros(3), "rate": np.zeros(3), "field_N": np.array([0.0, 5e-5, 0.0])}
    bench = SimulatedBench(with_devices(testbed((0.0, 0.0, 0.0), truth=start, **SENSORS)), 0)
    before = momentum_N(bench, bench.read(1.0))[-1]
    bench.drive({"mx": 0.4})
    gained = momentum_N(bench, bench.read(2.0))[-1] - before
    np.testing.assert_allclose(gained, [0.0, 0.0, 0.4 * 5e-5 * 2.0], atol=1e-6)


def test_the_motion_does_not_depend_on_how_it_is_read(testbed):
    start = {"attitude": np.array([0.1, 0.0, 0.0]), "rate": np.array([0.01, 0.02, 0.0])}
    bed = with_devices(testbed((1e-5, 0.0, -1e-4), truth=start, **SENSORS))

    def rows(cuts):
        bench = SimulatedBench(bed, 3)
        bench.read(1.0)
        bench.drive({"wx": 1e-3, "g1": 0.2, "mx": 0.1, "jx": 2e-3})
        parts = [bench.read(cut) for cut in cuts]
        return np.vstack([part.attitude.values for part in parts])

    np.testing.assert_array_equal(rows([6.0]), rows([0.25, 0.17, 3.0, 2.58]))


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ({"wx": 6e-3}, "device wx: requested 0.006 N m; its limit is 0.005 N m"),
        ({"g1": 1.1}, "device g1: requested 1.1 rad/s"),
        ({"mx": -0.5}, "device mx: requested -0.5 A m"),
        ({"jx": 1e-4}, "device jx: requested 0.0001 N m s at least"),
    ],
)
def test_an_input_beyond_its_limit_is_refused_and_nothing_is_driven(testbed, inputs, message):
    bench = SimulatedBench(with_devices(testbed((0.0, 0.0, -1e-4), **SENSORS)), 0)
    bench.read(1.0)
    with pytest.raises(DriveRefused, match=message):
        bench.drive({"wy": 1e-3, **inputs})
    speeds = bench.read(1.0).devices.values[:, :3]
    np.testing.assert_array_equal(speeds, np.tile([0.0, 100.0, 200.0], (len(speeds), 1)))


def test_a_device_that_is_not_there_is_named(testbed):
    bench = SimulatedBench(with_devices(testbed((0.0, 0.0, -1e-4), **SENSORS)), 0)
    with pytest.raises(InputError, match="did you mean 'g1'"):
        bench.drive({"g11": 0.0})
    with pytest.raises(InputError, match="a finite number"):
        bench.drive({"wx": float("nan")})


def test_stopping_leaves_wheels_at_their_speed_and_ends_everything_else(testbed):
    bench = SimulatedBench(with_devices(testbed((0.0, 0.0, -1e-4), **SENSORS)), 0)
    bench.read(1.0)
    bench.drive({"wx": 1e-3, "g1": 0.5, "mx": 0.2})
    bench.read(2.0)
    bench.stop()
    rows = bench.read(3.0).devices.values[100:]
    np.testing.assert_allclose(rows - rows[0], 0.0, atol=1e-6)
    assert rows[0, 0] > 19.0  # a second of 10 rad/s^2, twice
    np.testing.assert_allclose(rows[:, 5:], 0.0, atol=1e-9)


def test_a_magnetometer_sees_the_field_turned_into_the_body(testbed):
    """Rolled by 90 deg, the laboratory's z is the body's y; noise is as stated."""
    start = {"attitude": np.array([np.pi / 2, 0.0, 0.0]), "rate": np.zeros(3)}
    bed = with_devices(testbed((0.0, 0.0, 0.0), truth=start, **SENSORS))
    bed = replace(bed, magnetic_field=MagneticField(FIELD, noise=1e-7))
    field = SimulatedBench(bed, 0).read(20.0).field
    x, y, z = FIELD
    np.testing.assert_allclose(field.values.mean(axis=0), [x, z, -y], atol=5e-9)
    assert field.values.std() > 0
    np.testing.assert_allclose(field.values.std(axis=0), 1e-7, rtol=0.1)
