"""A lamp at the simulated bench: its warmth, the motion that follows, and what is recorded."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from equipoise.dynamics.lamp_warmth import lamp_warmth
from equipoise.maths.attitude import to_matrix
from equipoise.maths.straight_lines import read_at
from equipoise.model.defects import TrueLamp
from equipoise.model.devices import Lamp, Thermometer
from equipoise.model.recording import join
from equipoise.model.vector_sensors import SunSensor
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.surroundings import lamp as lamps

ON = TrueLamp(np.array([[2.0, 9.5], [20.0, 31.0]]), 3.0, 5.0)
K = np.array([40e-6, -30e-6, 20e-6])  # m/K, large: to be seen within half a minute
THERMAL = dict(zip(("thermal_x", "thermal_y", "thermal_z"), map(float, K), strict=True))
START = {"attitude": np.array([0.1, -0.05, 0.7]), "rate": np.array([0.02, -0.01, 0.03])}


@pytest.fixture
def lit(testbed):
    """Return a maker of testbeds under a lamp; its com at the start hangs 1 mm below."""

    def make(switched=ON, **changes):
        truth = {**START, "lamp": switched, "torque": THERMAL}
        return testbed((1e-4, 0.0, -1e-3), truth=truth, **changes)

    return make


def warmth(t: float) -> float:
    """Return the warmth (K) of ON by superposed steps."""
    steps = ((2.0, 1.0), (9.5, -1.0), (20.0, 1.0), (31.0, -1.0))
    return 3.0 * sum(way * -np.expm1(-(t - at) / 5.0) for at, way in steps if t > at)


def test_warmth_follows_each_switch():
    """3 K (1 - e^-1.5) when it goes off at 9.5 s, of which e^-1 is left 5 s later."""
    found = lamps.lamp_of(None, ON)
    t = np.array([0.0, 2.0, 9.5, 14.5, 25.0, 40.0])
    by_hand = [0.0, 0.0, 2.3306095, 2.3306095 * np.exp(-1.0), warmth(25.0), warmth(40.0)]
    np.testing.assert_allclose(lamps.warmth_at(found, t)[:, 0], by_hand, rtol=1e-7, atol=1e-15)


def test_what_is_on_at_the_start_has_been_on_for_long():
    """And the platform is as stated when it begins, cooling from there."""
    found = lamps.lamp_of(Lamp(3.0, 5.0), TrueLamp(np.array([[0.0, 10.0]])))
    t = np.array([0.0, 10.0, 15.0])
    np.testing.assert_allclose(lamps.warmth_at(found, t)[:, 0], [3.0, 3.0, 3.0 * np.exp(-1.0)])
    cooling = lamps.warmth_since_start(found, t)[:, 0]
    np.testing.assert_allclose(cooling, [0.0, 0.0, 3.0 * np.expm1(-1.0)])


def test_without_a_lamp_nothing_warms():
    t = np.linspace(0.0, 10.0, 4)
    np.testing.assert_array_equal(lamps.warmth_at(lamps.lamp_of(Lamp(3.0, 5.0), None), t), 0.0)
    assert lamps.power_rows(None, 0.0, 1.0) is None


def moved(t: np.ndarray) -> np.ndarray:
    """Return attitude and momentum at times, by SciPy: J = diag(1, 2, 2.5), m = 10, g = 9.81."""
    J, r0, g = np.array([1.0, 2.0, 2.5]), np.array([1e-4, 0.0, -1e-3]), np.array([0, 0, -9.81])

    def slope(now, y):
        w, (a, b, c, d) = y[4:] / J, y[:4]
        turn = [-b * w[0] - c * w[1] - d * w[2], a * w[0] + c * w[2] - d * w[1],
                a * w[1] + d * w[0] - b * w[2], a * w[2] + b * w[1] - c * w[0]]  # fmt: skip
        weight = np.cross(10.0 * (r0 + K * warmth(now)), to_matrix(y[:4]).T @ g)
        return np.append(0.5 * np.array(turn), np.cross(y[4:], w) + weight)

    roll, pitch, yaw = START["attitude"] / 2
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    q = [cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy,
         cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy]  # fmt: skip
    y = np.append(q, J * START["rate"])
    edges = [0.0, 2.0, 9.5, 20.0, 31.0, 40.0]  # its slope breaks where the lamp is switched
    found = []
    for a, b in pairwise(edges):
        part = t[(t >= a) & (t < b)]
        run = solve_ivp(slope, (a, b), y, "DOP853", rtol=1e-12, atol=1e-14, dense_output=True)
        found.append(run.sol(part).T)
        y = run.y[:, -1]
    return np.vstack(found)


def test_motion_is_that_of_another_integrator(lit):
    """40 s under a lamp that warms within 5: the same attitude to 5e-7; without it, 0.02 away."""
    rows = SimulatedBench(lit(), 0).read(39.9).attitude
    np.testing.assert_allclose(rows.values, moved(rows.t)[:, :4], atol=5e-7)
    dark = SimulatedBench(lit(None), 0).read(39.9).attitude
    assert np.abs(dark.values - rows.values).max() > 0.02


def test_how_it_is_read_changes_nothing(lit):
    """The same rows in one read or in many, switches within them or between."""
    setup = lit(thermometer=Thermometer(2.0, 0.1))
    whole, bench = SimulatedBench(setup, 3).read(30.0), SimulatedBench(setup, 3)
    parts = bench.read(0.7)
    while bench.time < 30.0:
        parts = join(parts, bench.read(min(0.7, 30.0 - bench.time)))
    for name in ("attitude", "rate", "temperature"):
        one, other = getattr(whole, name), getattr(parts, name)
        np.testing.assert_array_equal(one.t, other.t)
        np.testing.assert_allclose(one.values, other.values, rtol=0, atol=1e-15)
    lines = [lamp_warmth(each.lamp, Lamp(3.0, 5.0), 30.0) for each in (whole, parts)]
    warm = [read_at(whole.rate.t, line.t, line.values) for line in lines]
    np.testing.assert_allclose(warm[0], warm[1], atol=2e-4)
    exact = [warmth(t) for t in whole.rate.t]
    np.testing.assert_allclose(warm[0][:, 0], exact, atol=1e-3)


def test_switch_and_temperature_are_recorded(lit):
    """Both ends of a read and each switch; 20 degC and the warmth every half second."""
    bench = SimulatedBench(lit(thermometer=Thermometer(2.0)), 0)
    first, second = bench.read(5.0), bench.read(5.0)
    np.testing.assert_array_equal(first.lamp.t, [0.0, 2.0, 5.0])
    np.testing.assert_array_equal(first.lamp.values[:, 0], [0.0, 1.0, 1.0])
    np.testing.assert_array_equal(second.lamp.t, [5.0, 9.5, 10.0])
    np.testing.assert_array_equal(second.lamp.values[:, 0], [1.0, 0.0, 0.0])
    np.testing.assert_array_equal(first.temperature.t, np.arange(0.0, 5.1, 0.5))
    by_hand = [20.0 + warmth(t) for t in first.temperature.t]
    np.testing.assert_allclose(first.temperature.values[:, 0], by_hand, rtol=1e-12)


def test_the_centre_of_mass_is_where_its_warmth_has_moved_it(lit):
    bench = SimulatedBench(lit(), 0)
    bench.read(9.5)
    away = bench.truth().com - np.array([1e-4, 0.0, -1e-3])
    np.testing.assert_allclose(away, K * 2.3306095, rtol=1e-7)


def test_noise_of_a_thermometer_is_as_stated(lit):
    setup = lit(None, thermometer=Thermometer(50.0, 0.2))
    rows = SimulatedBench(setup, 1).read(40.0).temperature.values
    assert np.std(rows - 20.0) == pytest.approx(0.2, rel=0.1)


def test_a_sun_sensor_has_rows_while_its_lamp_is_on(lit):
    """On from 2 to 9.5 s, off from then; a heater's switch takes no row, nor does no switch."""
    up = np.array([0.0, 0.0, 1.0])
    sun = SunSensor(2.0, 0.0, None, delay=0.25)
    bench = SimulatedBench(lit(sun=sun, lamp=Lamp(3.0, 5.0, up)), 0)
    rows = bench.read(12.0).sun
    np.testing.assert_array_equal(rows.t, np.arange(2.5, 9.6, 0.5))
    assert len(bench.read(5.0).sun) == 0
    for other in (lit(sun=replace(sun, direction_N=up), lamp=Lamp(3.0, 5.0)),
                  lit(None, sun=sun, lamp=Lamp(3.0, 5.0, up))):  # fmt: skip
        assert len(SimulatedBench(other, 0).read(12.0).sun) == 25


def test_a_true_lamp_may_differ_from_the_stated_one(lit):
    """2 K stated, 3 K true; the time constant is left as stated."""
    setup = replace(lit(TrueLamp(np.array([[0.5, 90.0]]), 3.0)), lamp=Lamp(2.0, 5.0))
    bench = SimulatedBench(setup, 0)
    bench.read(5.5)
    away = bench.com - np.array([1e-4, 0.0, -1e-3])
    np.testing.assert_allclose(away, K * 3.0 * -np.expm1(-1.0), rtol=1e-12)
