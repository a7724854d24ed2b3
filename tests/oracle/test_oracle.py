"""The oracle is itself held against laws, hand-worked numbers and a second set of equations."""

from dataclasses import replace

import numpy as np
import pytest

mujoco = pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from benchmarks import problem as bench  # noqa: E402
from equipoise.model.mass_properties import is_possible, parallel_axis  # noqa: E402
from equipoise.model.testbed import AttitudeSensor, Gyro  # noqa: E402
from tests.oracle import mujoco_bench as oracle  # noqa: E402
from tests.support import thorough  # noqa: E402

LOCKED = 120.0 if thorough.THOROUGH else 30.0  # s
SEEDS = range(thorough.count(20, 8))


def platform_and_schedule(seed):
    rng = np.random.default_rng(seed)
    platform = oracle.random_platform(rng)
    return platform, oracle.random_schedule(rng, platform)


@pytest.fixture(scope="module")
def moved():
    return oracle.simulate(*platform_and_schedule(3))


@pytest.fixture(scope="module")
def locked():
    return oracle.simulate(platform_and_schedule(3)[0], duration=LOCKED, locked=True)


def matrices(q):
    return np.array([oracle.matrix(row) for row in q])


def inertias(run):
    """Return J(d) by the parallel-axis theorem, one mass after the other."""
    J = np.broadcast_to(run.platform.inertia_P, (len(run.t), 3, 3)).copy()
    for i, s in enumerate(run.platform.slides):
        places = s.home + run.displacement[:, i : i + 1] * s.axis
        J += np.array([parallel_axis(s.mass, r) for r in places]) - parallel_axis(s.mass, s.home)
    return J


def momentum_in_laboratory(run):
    """Return the total angular momentum about P in laboratory axes."""
    H = np.einsum("nij,nj->ni", inertias(run), run.rate)
    for i, s in enumerate(run.platform.slides):
        H += s.mass * run.velocity[:, i : i + 1] * np.cross(s.home, s.axis)
    return np.einsum("nij,nj->ni", matrices(run.q), H)


@pytest.mark.parametrize("seed", SEEDS)
def test_bodies_add_up_to_the_stated_platform(seed):
    """Total mass, centre of mass and inertia about P of MuJoCo's bodies, masses at home."""
    platform, _ = platform_and_schedule(seed)
    model = mujoco.MjModel.from_xml_string(oracle.model_text(platform, 1e-3))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    J = np.zeros((3, 3))
    for i in range(1, model.nbody):
        R = data.ximat[i].reshape(3, 3)
        J += R @ np.diag(model.body_inertia[i]) @ R.T
        J += parallel_axis(model.body_mass[i], data.xipos[i])
    M = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, M)
    assert model.body_mass.sum() == pytest.approx(platform.mass, rel=1e-14)
    np.testing.assert_allclose(data.subtree_com[1], platform.com, atol=1e-12)
    np.testing.assert_allclose(J, platform.inertia_P, atol=1e-12 * platform.inertia_P.max())
    np.testing.assert_allclose(M[:3, :3], platform.inertia_P, rtol=0, atol=1e-11)


@pytest.mark.parametrize("seed", SEEDS)
def test_random_platforms_are_what_they_promise(seed):
    """4-40 kg, possible and not flat, low centre of mass, start and moves within the stated box."""
    platform, schedule = platform_and_schedule(seed)
    mass, _, inertia_C = oracle.bare_body(platform)
    sigma = np.linalg.eigvalsh(0.5 * np.trace(inertia_C) * np.eye(3) - inertia_C)
    assert 4 <= platform.mass <= 40
    assert 0 < mass < platform.mass
    assert sigma[0] > 0.1 * sigma[2]
    assert -150e-6 <= platform.com[2] <= -40e-6
    assert np.abs(platform.com[:2]).max() <= 30e-6
    assert 3 <= np.rad2deg(platform.tilt) <= 10
    assert np.rad2deg(np.linalg.norm(platform.rate)) <= 2.0
    spin = (oracle.matrix(platform.q) @ platform.rate)[2]
    assert abs(np.rad2deg(spin)) >= 0.5
    assert len(platform.slides) in {3, 6}
    for ramp in schedule:
        assert np.all((np.abs(ramp.targets) >= 0.010) & (np.abs(ramp.targets) <= 0.050))
        assert platform.com_at(ramp.targets)[2] < -40e-6 + 1e-12


def test_energy_is_conserved_with_locked_masses(locked):
    """Kinetic energy plus height: it swings by 1e-3 J and drifts by less than 1e-9 of that."""
    kinetic = 0.5 * np.einsum("ni,nij,nj->n", locked.rate, inertias(locked), locked.rate)
    height = np.einsum("nj,nj->n", matrices(locked.q)[:, 2], locked.com)
    energy = kinetic + locked.platform.mass * locked.platform.gravity * height
    assert np.ptp(energy) < 1e-9 * np.ptp(kinetic)


def test_vertical_momentum_is_conserved_with_locked_masses(locked):
    """Gravity through a ball joint has no moment about the vertical."""
    H = momentum_in_laboratory(locked)[:, 2]
    assert np.ptp(H) < 1e-9 * abs(H[0])


def test_vertical_momentum_is_conserved_while_masses_travel(moved):
    """The same with J(d) and the momentum of the masses on their way, by our formulas."""
    H = momentum_in_laboratory(moved)[:, 2]
    assert np.ptp(H) < 1e-7 * abs(H[0])
    J_home = np.einsum("ij,nj->ni", moved.platform.inertia_P, moved.rate)
    H_home = np.einsum("nj,nj->n", matrices(moved.q)[:, 2], J_home)
    assert np.ptp(H_home) > 1e-4 * abs(H[0])  # and it would not be without them


@pytest.mark.parametrize("seed", thorough.some([3, 4], 1))
def test_half_the_step_gives_the_same_motion(seed):
    """Attitude within 1e-7 rad to the end, moves included."""
    platform, schedule = platform_and_schedule(seed)
    coarse = oracle.simulate(platform, schedule)
    fine = oracle.simulate(platform, schedule, dt=0.5e-3)
    assert oracle.angle_between(coarse.q, fine.q[::2]).max() < 1e-7


def test_small_swings_have_the_pendulum_period():
    """By hand: 2 pi sqrt(J / m g r) = 35.856 s at J 0.36 kg m^2, 14 kg, 80.5 um, 9.81 m/s^2."""
    tilt = np.deg2rad(0.1)
    swing = oracle.Platform(
        mass=14.0,
        inertia_P=np.diag([0.36, 0.50, 0.80]),
        com=np.array([0.0, 0.0, -80.5e-6]),
        slides=(),
        gravity=9.81,
        q=oracle.rotation(np.array([tilt, 0.0, 0.0])),
        rate=np.zeros(3),
    )
    run = oracle.simulate(swing, locked=True)
    lean = run.q[:, 1]
    before = np.flatnonzero(np.diff(np.sign(lean)))
    crossings = run.t[before] - lean[before] * 1e-3 / (lean[before + 1] - lean[before])
    period = 2 * np.mean(np.diff(crossings))
    assert period == pytest.approx(2 * np.pi * np.sqrt(0.36 / (14.0 * 9.81 * 80.5e-6)), rel=1e-6)
    assert period == pytest.approx(35.854, abs=0.002)


def test_a_servo_holds_its_mass_and_follows_the_ramp(moved):
    """Sag is at most g / SERVO^2; the move ends where it was sent, at no more than its speed."""
    platform, schedule = platform_and_schedule(3)
    sag = platform.gravity / oracle.SERVO**2
    assert np.abs(moved.displacement[0]).max() <= sag
    assert np.abs(moved.displacement[-1] - schedule[-1].targets).max() <= sag * 1.01
    assert np.abs(moved.velocity).max() <= schedule[0].speed * 1.01


@pytest.mark.parametrize("seed", thorough.some([3, 4, 5], 1))
def test_a_second_set_of_equations_agrees(seed):
    """Momentum form with J(d), mu(d) and h in NumPy, displacements from the log at 100 Hz."""
    platform, schedule = platform_and_schedule(seed)
    run = oracle.simulate(platform, schedule)
    known, rows = slice(None, None, 10), slice(None, None, 200)
    slides = platform.slides
    start = bench.Point(
        platform.q,
        platform.rate,
        platform.inertia_P[bench.ROWS, bench.COLUMNS],
        platform.com,
    )
    twin = bench.Problem(
        t=run.t[rows],
        q_meas=run.q[rows],
        sigma=1.0,
        mass=platform.mass,
        gravity=platform.gravity,
        slide_mass=platform.slide_mass,
        slide_home=np.array([s.home for s in slides]),
        slide_axis=platform.slide_axes,
        knot_t=run.t[known],
        knot_d=run.displacement[known],
        start=start,
    )
    q = bench.simulate(twin, start)
    assert oracle.angle_between(q, run.q[rows]).max() < 5e-6


def test_a_log_holds_the_stated_noise(moved):
    """Sample statistics of 6001 rows per axis: the sd is known to 1 %, a mean to sd / 77."""
    rng = np.random.default_rng(0)
    bias = np.array([1e-3, -2e-3, 3e-3])
    log = oracle.sensor_log(moved, rng, 50.0, 2e-3, 50.0, 4e-4, bias)
    turn = bench.difference(moved.q[::20], log.attitude.values)
    error = log.rate.values - moved.rate[::20] - bias
    assert np.std(turn, axis=0) == pytest.approx(2e-3, rel=0.04)
    assert np.std(error, axis=0) == pytest.approx(4e-4, rel=0.04)
    assert np.abs(turn.mean(axis=0)).max() < 4 * 2e-3 / np.sqrt(6001)
    assert np.abs(error.mean(axis=0)).max() < 4 * 4e-4 / np.sqrt(6001)
    np.testing.assert_array_equal(log.masses.values, moved.displacement[::20])
    assert log.mass_names == tuple(s.name for s in moved.platform.slides)
    assert log.span == (0.0, 120.0)


def test_a_log_without_a_gyro_has_none_and_odd_rates_are_refused(moved):
    rng = np.random.default_rng(0)
    assert oracle.sensor_log(moved, rng).rate is None
    assert len(oracle.sensor_log(moved, rng).attitude) == 601
    with pytest.raises(ValueError, match="whole number of steps"):
        oracle.sensor_log(moved, rng, attitude_rate=7.0)


@pytest.mark.parametrize("error", [0.02, 0.10])
def test_a_priori_knowledge_errs_as_stated(error):
    for seed in SEEDS:
        rng = np.random.default_rng(seed)
        platform = oracle.random_platform(rng)
        camera, gyro = AttitudeSensor(5.0, 3e-3), Gyro(50.0, 1e-4, 1e-3)
        testbed = oracle.testbed_for(platform, rng, error, camera, gyro)
        ratio = np.diag(testbed.body.inertia_P) / np.diag(platform.inertia_P)
        assert np.abs(ratio - 1).max() <= error
        assert is_possible(testbed.body)
        assert testbed.truth is None
        assert testbed.inertia_sd == error
        assert testbed.mass_named(platform.slides[0].name).mass == platform.slides[0].mass


def test_overlapping_ramps_are_refused():
    platform, schedule = platform_and_schedule(3)
    early = replace(schedule[0], start=schedule[0].start + 1.0)
    with pytest.raises(ValueError, match="a ramp starts"):
        oracle.simulate(platform, (schedule[0], early), duration=1.0)
