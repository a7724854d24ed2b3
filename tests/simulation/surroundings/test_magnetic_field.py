"""A cage around the simulated bench: its field, what reports it, and what it does to coils."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.stored_momentum import field_at, with_known_inputs
from equipoise.maths.attitude import to_matrix
from equipoise.model.defects import TrueCoilPair
from equipoise.model.devices import CoilPair, JetPair, MagneticField, Magnetorquer
from equipoise.model.errors import DriveRefused
from equipoise.model.vector_sensors import Magnetometer
from equipoise.simulation.bench import SimulatedBench

X, Y, Z = np.eye(3)
EARTH = MagneticField(np.array([20e-6, 0.0, -40e-6]))
COILS = tuple(Magnetorquer(n, a, 0.5) for n, a in zip(("tx", "ty", "tz"), (X, Y, Z), strict=True))
QUIET = Magnetometer(10.0, 0.0, 0.0)


def pairs(**changes) -> tuple[CoilPair, ...]:
    """A cage that gives up to 100 uT along each laboratory axis, 50 uT along x at the start."""
    made = [CoilPair(n, a, 100e-6, lag=0.1) for n, a in zip("xyz", (X, Y, Z), strict=True)]
    made[0] = replace(made[0], field=50e-6)
    return tuple(replace(pair, **changes) for pair in made)


@pytest.fixture
def caged(testbed):
    """Return a maker of testbeds in a cage, without any torque but that of coils."""

    def make(*, cage=None, background=None, true=(), field_N=None, **changes):
        truth = {"cage": tuple(true), "field_N": field_N, "attitude": np.array([0.0, 0.0, 0.5])}
        return testbed(
            coil_pairs=pairs() if cage is None else cage, magnetic_field=background,
            magnetometer=QUIET, truth=truth, **changes,
        )  # fmt: skip

    return make


def in_laboratory(recording) -> np.ndarray:
    """Return the magnetometer's rows in laboratory axes; the platform does not turn."""
    return recording.field.values @ to_matrix(recording.attitude.values[0]).T


def test_the_cage_is_on_from_the_start_beside_the_background(caged):
    """50 uT along x and the Earth's 20 and -40: 70, 0, -40."""
    rows = in_laboratory(SimulatedBench(caged(background=EARTH), 0).read(1.0))
    np.testing.assert_allclose(rows, np.tile([70e-6, 0.0, -40e-6], (11, 1)), atol=1e-15)


def test_it_follows_what_it_is_driven_by(caged):
    """From 50 to -30 uT along x with a lag of 0.1 s: 1/e of 80 uT is left after it."""
    bench = SimulatedBench(caged(), 0)
    bench.read(1.0)
    bench.drive({"x": -30e-6, "z": 10e-6})
    rows = bench.read(2.0)
    x, _, z = in_laboratory(rows)[0]
    assert x == pytest.approx((-30 + 80 / np.e) * 1e-6, rel=1e-9)
    assert z == pytest.approx(10e-6 * (1 - 1 / np.e), rel=1e-9)
    np.testing.assert_allclose(in_laboratory(rows)[-1], [-30e-6, 0.0, 10e-6], rtol=1e-6, atol=1e-12)
    assert rows.device_names == ("cage:x", "cage:y", "cage:z")
    np.testing.assert_allclose(rows.devices.values[-1], [-30e-6, 0.0, 10e-6], rtol=1e-6)
    assert rows.momentum is None


def test_beyond_its_field_it_is_refused(caged):
    with pytest.raises(DriveRefused, match=r"0\.0001"):
        SimulatedBench(caged(), 0).drive({"x": 101e-6})


def test_a_stop_leaves_the_field_on(caged):
    bench = SimulatedBench(caged(magnetorquers=COILS), 0)
    bench.drive({"x": 60e-6, "ty": 0.3})
    bench.read(2.0)
    bench.stop()
    rows = bench.read(2.0).devices.values
    np.testing.assert_allclose(rows[-1], [0.0, 0.0, 0.0, 60e-6, 0.0, 0.0], atol=1e-12)


def test_what_it_gives_may_differ_from_what_it_is_driven_by(caged):
    """Gain 1.02 along an axis 0.01 rad off, 3 % more at the magnetometer; other background."""
    off = np.array([np.cos(0.01), np.sin(0.01), 0.0])
    setup = caged(true=[TrueCoilPair("x", 1.02, off, 0.03)], background=EARTH,
                  field_N=np.array([21e-6, 1e-6, -40e-6]))  # fmt: skip
    recording = SimulatedBench(setup, 0).read(1.0)
    expected = np.array([21e-6, 1e-6, -40e-6]) + 50e-6 * 1.02 * 1.03 * off
    np.testing.assert_allclose(in_laboratory(recording)[0], expected, rtol=1e-12)
    np.testing.assert_allclose(recording.devices.values[:, 0], 50e-6)  # by its current


def test_deviations_are_drawn_within_what_is_stated(caged):
    """2 %: a uniform share has a third of that squared as variance."""
    cage = pairs(field=50e-6, nonuniformity=0.02)
    shares = [SimulatedBench(caged(cage=cage), seed).platform.field.deviation for seed in range(60)]
    assert np.abs(shares).max() < 0.02
    assert np.std(shares) == pytest.approx(0.02 / 3**0.5, rel=0.15)


def test_a_coil_turns_the_platform_as_the_cage_has_it(caged):
    """0.5 A m2 along body z in 50 uT along x, yaw 0.5 rad: 25 uN m about laboratory y.

    J_xx = 1 and J_yy = 2 kg m2: in the body 25 uN m (sin 0.5, cos 0.5) turns by w = tau t / J.
    """
    bench = SimulatedBench(caged(magnetorquers=COILS), 0)
    bench.drive({"tz": 0.5})
    recording = bench.read(2.0)
    tau = 25e-6 * np.array([np.sin(0.5), np.cos(0.5)])
    spent = 2.0 - 1e-3  # s, behind the least lag of a coil
    np.testing.assert_allclose(recording.rate.values[-1, :2], tau * spent / [1.0, 2.0], rtol=1e-4)
    known = with_known_inputs(recording, replace(bench.testbed))
    np.testing.assert_allclose(known.torque.values[-1, :2], tau, rtol=1e-4)


def test_the_known_field_is_what_the_cage_reports(caged):
    """Without a magnetometer's rows: background and 50, later -30 uT along x, turned by yaw."""
    bench = SimulatedBench(
        replace(caged(background=EARTH, magnetorquers=COILS), magnetometer=None), 0
    )
    first = bench.read(1.0)
    bench.drive({"x": -30e-6})
    bench.read(2.0)
    later = bench.read(1.0)
    R = to_matrix(first.attitude.values[0])
    for recording, x in ((first, 70e-6), (later, -10e-6)):
        found = field_at(recording.devices.t[-1:], recording, bench.testbed)
        np.testing.assert_allclose(found[0], R.T @ [x, 0.0, -40e-6], rtol=1e-6, atol=1e-12)


def test_jets_and_wheels_stand_beside_a_cage(caged):
    """A jet behind the coil pairs among the devices: 0.02 N m for half a second about x."""
    jet = JetPair("jx", X, 0.02)
    bench = SimulatedBench(caged(jets=(jet,), magnetorquers=COILS), 0)
    bench.drive({"jx": 0.01})
    recording = bench.read(1.0)
    assert recording.rate.values[-1, 0] == pytest.approx(0.01, rel=1e-6)
    assert recording.device_names[-1] == "jet:jx"
    total = np.sum(recording.devices.values[:, -1]) / 50.0
    assert total == pytest.approx(0.01, rel=1e-6)
