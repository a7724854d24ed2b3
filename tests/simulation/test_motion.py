"""Laws of mechanics, held by the rows of a bench whose sensors are perfect."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.timeline import timeline
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.testbed import AttitudeSensor, Fault, Gyro
from equipoise.model.torque_terms import TERMS
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.carried_out import record

G = 9.81


def energies(bench, recording):
    """Return kinetic and potential energy (J) at the rows; both sensors at one rate."""
    body, w = bench.platform.body, recording.rate.values
    vertical_B = to_matrix(recording.attitude.values)[:, 2, :]
    kinetic = 0.5 * np.einsum("ni,ij,nj->n", w, body.inertia_P, w)
    return kinetic, G * vertical_B @ body.first_moment


@pytest.mark.parametrize(
    ("com", "attitude", "rate"),
    [
        ((0.0, 0.0, 0.0), (0.1, 0.2, 0.3), (0.3, 0.2, 0.25)),  # tumbling, no torque at all
        ((3e-5, -2e-5, -1e-4), (0.05, 0.02, 1.0), (0.004, -0.003, 0.005)),  # as after balancing
        ((0.0, 0.0, -3e-3), (0.3, 0.0, 0.0), (0.0, 0.0, 0.05)),  # hanging 3 mm low
        ((0.0, 0.0, 1e-4), (0.1, 0.0, 0.0), (0.0, 0.01, 0.0)),  # falls over
    ],
)
def test_energy_is_kept_for_ten_minutes(testbed, com, attitude, rate):
    start = {"attitude": np.array(attitude), "rate": np.array(rate)}
    sensors = {"attitude": AttitudeSensor(2.0, 0.0), "gyro": Gyro(2.0, 0.0, 0.0)}
    bench = SimulatedBench(testbed(com, truth=start, **sensors), 0)
    kinetic, potential = energies(bench, bench.read(600.0))
    assert np.ptp(kinetic + potential) < 1e-9 * kinetic.max()


def momentum_N(recording, masses, body):
    """Return R (J(d) w + h), computed mass by mass from the rows, N m s."""
    t, w = recording.rate.t, recording.rate.values
    track = recording.masses
    H = w @ body.inertia_P
    for i, mass in enumerate(masses):
        d = np.interp(t, track.t, track.values[:, i])
        speed = (np.interp(t, track.t, track.values[:, i]) - np.interp(t - 1e-6, track.t,
                 track.values[:, i])) / 1e-6  # fmt: skip
        now, home = mass.home + d[:, None] * mass.axis, mass.home
        H = H + mass.mass * (np.cross(now, np.cross(w, now)) - np.cross(home, np.cross(w, home)))
        H = H + mass.mass * np.cross(now, speed[:, None] * mass.axis)
    return np.einsum("nij,nj->ni", to_matrix(recording.attitude.values), H)


def moving_testbed(testbed, rail, **changes):
    masses = (
        rail("x", (1.0, 0.0, 0.0), (0.0, 0.2, -0.05)),
        rail("z", (0.0, 0.6, 0.8), (0.15, -0.1, 0.05)),
    )
    start = {"attitude": np.array([0.1, -0.05, 0.4]), "rate": np.array([0.02, 0.01, -0.03])}
    sensors = {"attitude": AttitudeSensor(10.0, 0.0), "gyro": Gyro(10.0, 0.0, 0.0)}
    return testbed(masses=masses, truth=start, **sensors, **changes)


# Off the sensors' beat, so that corners lie between rows.
MOVES = ((10.03, {"x": 0.03}), (11.56, {"z": -0.05}), (30.0, {"x": -0.05, "z": 0.02}))


def test_vertical_momentum_is_kept_through_moves(testbed, rail):
    """Gravity has no torque about the vertical, whatever the masses do."""
    setup = moving_testbed(testbed, rail, com=(1e-4, 0.0, -2e-4))
    recording = record(setup, 60.0, MOVES, 0)
    H_N = momentum_N(recording, setup.masses, setup.body)
    assert np.ptp(H_N[:, 2]) < 1e-9 * np.abs(H_N).max()
    assert np.ptp(H_N[:, 0]) > 0.1 * np.abs(H_N).max()


def test_without_gravity_all_momentum_is_kept(testbed, rail):
    setup = moving_testbed(testbed, rail, com=(1e-4, 0.0, -2e-4), gravity=1e-12)
    H_N = momentum_N(record(setup, 60.0, MOVES, 0), setup.masses, setup.body)
    assert np.ptp(H_N, axis=0).max() < 1e-9 * np.abs(H_N).max()


def test_rate_jumps_when_a_mass_starts_and_stops(testbed, rail):
    """0.5 kg at 10 mm/s along x, 0.2 m off in y: h_z = -1e-3 N m s, on 2.5 kg m^2."""
    setup = testbed(masses=(rail(home=(0.0, 0.2, 0.0)),), gravity=1e-12)
    bench = SimulatedBench(setup, 0)
    bench.read(1.0)
    bench.move({"x": 0.01})
    w = bench.read(3.0).rate
    moving = (w.t > 1.0) & (w.t <= 2.0)
    np.testing.assert_allclose(w.values[moving, 2], 1e-3 / 2.5, rtol=1e-3)
    np.testing.assert_allclose(w.values[~moving], 0.0, atol=1e-12)


def test_the_platform_responds_to_actual_and_not_reported_masses(testbed, rail):
    """A stuck mass does nothing; one that slips by half does half as much."""
    masses = (rail("x"), rail("y", (0.0, 1.0, 0.0), (0.2, 0.0, 0.0)))
    rates: list[float] = []
    for gain in (1.0, 0.5, 0.0):
        setup = testbed(masses=masses, truth={"faults": (Fault("y", gain),)}, gravity=1e-12)
        bench = SimulatedBench(setup, 0)
        bench.move({"y": 0.02})
        recording = bench.read(1.0)
        assert recording.masses.values[-1, 1] == pytest.approx(0.01)
        rates.append(recording.rate.values[-1, 2])
    assert rates == pytest.approx([-4e-4, -2e-4, 0.0], rel=1e-3)


def test_agrees_with_the_estimators_propagator(testbed, rail):
    """Same equations, other grid and other way across the corners: 1e-7 rad over 60 s."""
    torque = {"viscous_z": 2e-3, "constant_x": 1e-4, "sag_xz": 1e-4, "drift_y": 1e-6, "swirl": 1e-4}
    setup = moving_testbed(testbed, rail, com=(1e-4, 0.0, -2e-4))
    setup = replace(setup, truth=replace(setup.truth, torque=torque))
    start = SimulatedBench(setup, 0).platform
    terms = np.array([torque.get(term, 0.0) for term in TERMS])
    recording = record(setup, 60.0, MOVES, 0)
    body, masses = setup.body, recording.masses
    line = timeline(recording.attitude.t, recording.rate.t, masses, 2, 0.05)
    motion = propagate(
        body_of(body.mass, G, pack_symmetric(body.inertia_P), body.first_moment, terms),
        mass_maps(setup.masses), line, start.attitude, start.rate,
    )  # fmt: skip
    q = motion.q[line.attitude_node]
    assert np.abs(q - recording.attitude.values).max() < 1e-7
    assert np.abs(q[-1] - q[0]).max() > 0.1


def test_drag_slows_a_spin_as_by_hand(testbed):
    """w = w0 exp(-c t / J)."""
    start = {"rate": np.array([0.0, 0.0, 0.1]), "torque": {"viscous_z": 0.05}}
    w = SimulatedBench(testbed(truth=start), 0).read(50.0).rate
    np.testing.assert_allclose(w.values[:, 2], 0.1 * np.exp(-0.05 * w.t / 2.5), rtol=1e-9)


def test_drifting_centre_of_mass_pushes_more_and_more(testbed):
    """Held level by nothing else: J_y w' = m g t v_x, so w = m g v_x t^2 / 2 J_y while level."""
    bench = SimulatedBench(testbed(truth={"torque": {"drift_x": 1e-8}}), 0)
    for _ in range(4):
        w = bench.read(5.0).rate
    by_hand = 10.0 * G * 1e-8 * w.t**2 / (2 * 2.0)
    np.testing.assert_allclose(w.values[:, 1], by_hand, rtol=1e-6)


def test_noise_torque_drives_the_platform(testbed):
    """Balanced and all but at rest: J w is the integral of the torque."""
    noisy = {"noise_torque": 1e-9, "noise_correlation": 4.0}
    bench = SimulatedBench(testbed(truth=noisy, gyro=Gyro(5.0, 0.0, 0.0)), 0)
    w = bench.read(60.0).rate
    noise = noise_again(60.0, 1e-9)
    by_hand = np.concatenate(
        [np.zeros((1, 3)), np.cumsum(0.5 * (noise[1:] + noise[:-1]) * 0.2, axis=0)]
    )
    response = w.values * np.array([1.0, 2.0, 2.5])
    np.testing.assert_allclose(response, by_hand, atol=1e-14)
    assert np.abs(response).max() > 1e-9


def noise_again(until, sd):
    """Draw the bench's noise torque anew, from the fifth stream of seed 0, on its 0.2 s grid."""
    rng = np.random.default_rng(np.random.SeedSequence(0).spawn(5)[4])
    n, stay = round(until / 0.2), np.exp(-1 / 20)
    values = [sd * rng.standard_normal(3)]
    push = sd * np.sqrt(1 - stay**2)
    for _ in range(n):
        values.append(stay * values[-1] + push * rng.standard_normal(3))
    return np.array(values)


def test_delayed_rows_show_the_motion_before_the_start(testbed):
    """A row stamped 0 with a delay of 0.5 s shows a body that came from there."""
    late = {"attitude": AttitudeSensor(5.0, 0.0, delay=0.5), "gyro": Gyro(5.0, 0.0, 0.0, 0.2, 0.1)}
    start = {"rate": np.array([0.1, 0.0, 0.0])}
    recording = SimulatedBench(testbed(truth=start, **late), 0).read(1.0)
    angle = 2 * np.arctan2(recording.attitude.values[:, 1], recording.attitude.values[:, 0])
    np.testing.assert_allclose(angle, 0.1 * (recording.attitude.t - 0.5), atol=1e-12)
