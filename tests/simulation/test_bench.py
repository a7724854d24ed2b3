from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import from_euler321
from equipoise.model.bench import Bench
from equipoise.model.defects import CameraErrors, ComStep, Contact, Gap, GyroErrors
from equipoise.model.errors import InputError, MoveRefused
from equipoise.model.recording import CHANNELS, join
from equipoise.model.testbed import AttitudeSensor, Fault, Gyro
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.carried_out import record

MOVES = {7.5: {"x1": 0.02, "z2": -0.03}, 8.4: {"x1": -0.01}, 20.0: {"y1": 0.05}, 22.0: None}
EVERYTHING = {"viscous_z": 1e-4, "drift_x": 1e-7, "swirl": 1e-5}


def sputnix(delay=0.0, averaging=0.0):
    """The preset with all that a bench can have: gyro, noise torque, drift, play, every defect."""
    preset = read_preset("sputnix")
    truth = replace(
        preset.truth, torque=EVERYTHING, noise_torque=1e-5, noise_correlation=7.0,
        gyro_bias=np.full(3, 1e-3), faults=(Fault("z2", 0.5),),
        mass_lag=0.07, gaps=(Gap(12.0, 12.5),),
        contacts=(Contact(11.1, np.full(3, 1e-3)), Contact(12.0, np.full(3, -1e-3))),
        com_steps=(ComStep(11.1, np.full(3, 1e-6)), ComStep(17.77, np.full(3, 2e-6))),
        camera=CameraErrors(np.full(3, 1e-3), np.full(3, 1e-3), np.full(3, 1e-3), 0.1, 0.2),
        gyro=GyroErrors(np.full(3, 0.01), np.full(3, 0.01)),
    )  # fmt: skip
    return replace(
        preset,
        truth=truth,
        attitude=AttitudeSensor(5.0, 3e-3, delay, averaging),
        gyro=Gyro(33.0, 1e-3, 0.0, delay / 2, averaging / 2),
        masses=tuple(replace(m, backlash=1e-4, accuracy=1e-4) for m in preset.masses),
    )


def driven(testbed, seed, cuts, end=30.0, moves=MOVES):
    """Read up to each cut and each command in turn; return the bench and all rows."""
    bench, whole = SimulatedBench(testbed, seed), None
    for time in sorted({*cuts, *moves, end}):
        part = bench.read(time - bench.time)
        whole = part if whole is None else join(whole, part)
        if time in moves:
            bench.stop() if moves[time] is None else bench.move(moves[time])
    return bench, whole


def assert_same_sensors(a, b):
    """Bit for bit, but for the last bit of a cosine, which may depend on an array's length."""
    np.testing.assert_array_equal(a.attitude.t, b.attitude.t)
    np.testing.assert_allclose(a.attitude.values, b.attitude.values, rtol=0, atol=5e-16)
    np.testing.assert_array_equal(a.rate.t, b.rate.t)
    np.testing.assert_array_equal(a.rate.values, b.rate.values)


def test_it_is_a_bench():
    bench = SimulatedBench(read_preset("sputnix"), 0)
    assert isinstance(bench, Bench)
    assert bench.testbed.name == "Sputnix mock-up"
    assert bench.time == 0.0


def test_a_seed_reproduces_everything():
    (one, first), (two, second) = (driven(sputnix(0.1, 0.05), 4, ()) for _ in range(2))
    for name in CHANNELS:
        a, b = getattr(first, name), getattr(second, name)
        if a is not None:
            np.testing.assert_array_equal(a.t, b.t)
            np.testing.assert_array_equal(a.values, b.values)
    np.testing.assert_array_equal(one.truth().com, two.truth().com)
    other, _ = driven(sputnix(0.1, 0.05), 5, ())
    assert not np.any(one.truth().com == other.truth().com)


@pytest.mark.parametrize(("delay", "averaging"), [(0.0, 0.0), (0.13, 0.0), (0.21, 0.5)])
@pytest.mark.parametrize("step", [0.1, 0.37, 3.0, 11.0])
def test_how_it_is_read_changes_nothing(delay, averaging, step):
    """Rows, and where masses and platform really are; averaging may outlast a frame."""
    testbed = sputnix(delay, averaging)
    one, whole = driven(testbed, 2, ())
    other, parts = driven(testbed, 2, np.arange(0.0, 30.0, step))
    assert_same_sensors(whole, parts)
    np.testing.assert_array_equal(one.displacements, other.displacements)
    np.testing.assert_array_equal(one.bad_rows, other.bad_rows)
    assert one.tilt_now() == pytest.approx(other.tilt_now(), abs=1e-12)
    # the same lines, though cuts add rows
    for a, b in ((whole, parts), (parts, whole)):
        line = np.column_stack([np.interp(b.masses.t, a.masses.t, d) for d in a.masses.values.T])
        np.testing.assert_allclose(line, b.masses.values, atol=1e-15)


def test_two_reads_are_one():
    bench, other = (SimulatedBench(sputnix(), 1) for _ in range(2))
    assert_same_sensors(join(bench.read(10.0), bench.read(10.0)), other.read(20.0))


def test_rows_come_once_and_none_is_lost():
    """Tenths of a second, which do not add up exactly; the first read holds time zero."""
    bench = SimulatedBench(sputnix(0.05), 0)
    first = bench.read(0.0)
    assert first.attitude.t.tolist() == first.rate.t.tolist() == [0.0]
    reads = [bench.read(0.1) for _ in range(100)]
    assert bench.time == 10.0
    stamps = np.concatenate([r.attitude.t for r in reads])
    np.testing.assert_array_equal(stamps, np.arange(1, 51) / 5)
    assert len(np.concatenate([r.rate.t for r in reads])) == 330


def test_a_refused_move_changes_nothing():
    """Not the mass refused, not the others, not the randomness of what follows."""
    (bench, twin) = (SimulatedBench(sputnix(), 3) for _ in range(2))
    for b in (bench, twin):
        b.read(2.0)
        b.move({"x1": 0.01})
        b.read(0.5)
    with pytest.raises(MoveRefused):
        bench.move({"x2": 0.02, "y1": 0.06})
    with pytest.raises(InputError):
        bench.move({"x2": 0.02, "y1": np.nan})
    with pytest.raises(InputError, match="did you mean 'x1'"):
        bench.move({"x2": 0.02, "xx1": 0.01})
    for b in (bench, twin):
        b.read(5.0)
        b.move({"y1": 0.01})
    after, untouched = bench.read(5.0), twin.read(5.0)
    np.testing.assert_array_equal(after.masses.values, untouched.masses.values)
    np.testing.assert_array_equal(after.attitude.values, untouched.attitude.values)
    np.testing.assert_array_equal(bench.displacements, twin.displacements)


@pytest.mark.parametrize("duration", [-1.0, np.nan, np.inf])
def test_time_goes_forward(duration):
    with pytest.raises(InputError, match="zero or more seconds"):
        SimulatedBench(read_preset("sputnix"), 0).read(duration)


def test_truth_is_where_the_masses_really_stand(testbed, rail):
    """0.5 kg by 20 mm on 10 kg: 1 mm. J_zz: 0.5 (0.02^2 + 0.2^2) against 0.5 x 0.2^2."""
    setup = testbed((0.0, 0.0, -1e-4), masses=(rail(home=(0.0, 0.2, 0.0)),))
    bench = SimulatedBench(setup, 0)
    bench.move({"x": 0.02})
    bench.read(1.0)
    np.testing.assert_allclose(bench.truth().com, [5e-4, 0.0, -1e-4], atol=1e-15)
    bench.read(9.0)
    truth = bench.truth()
    np.testing.assert_allclose(truth.com, [1e-3, 0.0, -1e-4], atol=1e-15)
    np.testing.assert_allclose(np.diag(truth.inertia_P), [1.0, 2.0002, 2.5002], atol=1e-15)
    np.testing.assert_allclose(truth.inertia_P[0, 1], -0.5 * 0.02 * 0.2, atol=1e-15)
    assert truth.mass == 10.0


def test_truth_knows_what_is_not_reported(testbed, rail):
    """A stuck mass and one that misses its stop: the report says otherwise."""
    masses = (rail("x", accuracy=1e-3), rail("y", (0.0, 1.0, 0.0)))
    bench = SimulatedBench(testbed(masses=masses, truth={"faults": (Fault("y", 0.0),)}), 0)
    bench.move({"x": 0.02, "y": 0.02})
    reported = bench.read(10.0).masses.values[-1]
    np.testing.assert_allclose(reported, 0.02)
    off = bench.truth().com * 10.0 / 0.5 - [0.02, 0.02, 0.0]
    assert 1e-5 < abs(off[0]) < 5e-3
    assert off[1] == pytest.approx(-0.02)


def test_truth_drifts_at_its_rate(testbed):
    drift = {"drift_x": 1e-7, "drift_y": -2e-7, "drift_z": 3e-7}
    bench = SimulatedBench(testbed((1e-4, 0.0, 0.0), truth={"torque": drift}), 0)
    bench.read(7.0)
    bench.read(3.0)
    np.testing.assert_allclose(bench.truth().com, [1.01e-4, -2e-6, 3e-6], atol=1e-18)


def test_tilt_now_is_the_angle_from_the_vertical(testbed):
    """Roll 0.3 then rolling on at 0.05 rad/s; taken at a moment without a sample of any sensor."""
    start = {"attitude": np.array([0.3, 0.0, 1.0]), "rate": np.array([0.05, 0.0, 0.0])}
    bench = SimulatedBench(testbed(truth=start), 0)
    assert bench.tilt_now() == pytest.approx(0.3)
    bench.read(2.2222)
    assert bench.tilt_now() == pytest.approx(0.3 + 0.05 * 2.2222, abs=1e-9)


def test_first_row_is_the_first_attitude(testbed):
    start = {"attitude": np.array([0.1, 0.2, 0.3])}
    first = SimulatedBench(testbed(truth=start), 0).read(1.0).attitude.values[0]
    np.testing.assert_allclose(first, from_euler321(0.1, 0.2, 0.3), atol=1e-15)


def test_masses_are_reported_from_read_to_read():
    bench = SimulatedBench(read_preset("sputnix"), 0)
    bench.read(5.0)
    bench.move({"x1": 0.02})
    recording = bench.read(1.0)
    assert recording.mass_names == ("x1", "x2", "y1", "y2", "z1", "z2")
    np.testing.assert_allclose(recording.masses.t, [5.0, 6.0])
    np.testing.assert_allclose(recording.masses.values[:, 0], [0.0, 0.01])
    np.testing.assert_allclose(bench.read(3.0).masses.t, [6.0, 7.0, 9.0])


def test_mass_rows_reach_back_over_the_sensor_delay(testbed, rail):
    late = AttitudeSensor(5.0, 0.0, delay=0.4)
    bench = SimulatedBench(testbed(masses=(rail(),), attitude=late), 0)
    bench.read(5.0)
    bench.move({"x": 0.02})
    bench.read(2.1)
    np.testing.assert_allclose(bench.read(1.0).masses.t, [6.7, 7.0, 8.1])


def test_a_bench_without_sensors_or_masses_still_runs(testbed):
    bench = SimulatedBench(testbed(attitude=None, gyro=None), 0)
    recording = bench.read(3.3)
    assert all(getattr(recording, name) is None for name in CHANNELS)
    assert bench.tilt_now() == pytest.approx(0.0)


def test_record_is_the_same_as_reading():
    moves = [(t, m) for t, m in MOVES.items() if m is not None]
    _, whole = driven(sputnix(), 6, (), moves=dict(moves))
    recording = record(sputnix(), 30.0, moves, 6)
    assert_same_sensors(whole, recording)
    np.testing.assert_allclose(recording.masses.t, whole.masses.t)
    np.testing.assert_allclose(recording.masses.values, whole.masses.values)
    assert recording.source == "simulated Sputnix mock-up, seed 6"


@pytest.mark.parametrize("times", [(-1.0,), (31.0,), (20.0, 10.0), (np.nan,)])
def test_record_wants_moves_in_order(times):
    with pytest.raises(InputError, match="times in order, from 0 to 30 s"):
        record(sputnix(), 30.0, [(t, {"x1": 0.0}) for t in times], 0)
