"""Defects of the oracle's records, by hand-worked numbers and laws."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import COM, INERTIA
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import cases, defective_run, sensors
from tests.oracle import defects as flaws
from tests.oracle import mujoco_bench as oracle
from tests.oracle.defects import BadRow, ComStep, Contact, Defects, Harmonic
from tests.support import thorough

J = np.diag([0.35, 0.54, 0.85])
LEVEL = np.array([1.0, 0.0, 0.0, 0.0])


def body(rate=(0.0, 0.0, 0.0), com=(0.0, 0.0, 0.0), **changes):
    """Return 14 kg without masses, level, centre of mass at P unless told."""
    plain = oracle.Platform(14.0, J, np.array(com), (), 9.81, LEVEL, np.array(rate))
    return replace(plain, **changes)


def spinning(duration=2.0, w=2.0):
    """Return a run that turns about the vertical at w (rad/s): heading = w t."""
    return oracle.simulate(body((0.0, 0.0, w)), (), duration, locked=True)


def observed(run, defects, rate=10.0):
    """Return the camera's rows without noise."""
    return sensors.camera(run, np.random.default_rng(0), rate, 0.0, defects)


def turn_N(measured, true):
    """Return the rotation vector on the left of ``true``, laboratory axes, rad."""
    error = oracle.product(measured, true * np.array([1.0, -1.0, -1.0, -1.0]))
    return 2 * error[..., 1:] * np.sign(error[..., :1])  # small: sin x = x to x^3 / 24


def turn_B(measured, true):
    """Return the rotation vector on the right of ``true``, body axes, rad."""
    error = oracle.product(true * np.array([1.0, -1.0, -1.0, -1.0]), measured)
    return 2 * error[..., 1:] * np.sign(error[..., :1])  # small: sin x = x to x^3 / 24


def momentum(run):
    """Return the angular momentum about P in laboratory axes of a platform without masses."""
    return np.array(
        [
            oracle.matrix(q) @ run.platform.inertia_P @ w
            for q, w in zip(run.q, run.rate, strict=True)
        ]
    )


# --- the motion -----------------------------------------------------------------------------------


@pytest.mark.parametrize("duration", [0.010, 0.0237, 0.050])
def test_a_contact_changes_the_momentum_in_the_laboratory_by_its_impulse(duration):
    """With the centre of mass at P nothing else can: exactly so, in all three directions."""
    impulse = np.array([1.1e-3, -0.7e-3, 0.4e-3])
    hit = Defects(contacts=(Contact(1.0, duration, impulse),))
    H = momentum(defective_run.simulate(body((0.02, -0.03, 0.4)), (), hit, 3.0))
    np.testing.assert_allclose(H[1000] - H[0], 0, atol=1e-11)
    np.testing.assert_allclose(H[-1] - H[0], impulse, rtol=0, atol=1e-11)


def test_a_contact_leaves_the_rest_to_gravity():
    """Of a pendulum the vertical momentum alone jumps by the impulse, and stays."""
    hit = Defects(contacts=(Contact(1.0, 0.03, np.array([1e-3, 0.0, -2e-3])),))
    H = momentum(defective_run.simulate(body((0.02, 0.0, 0.1), (0, 0, -80e-6)), (), hit, 20.0))
    assert H[-1, 2] - H[0, 2] == pytest.approx(-2e-3, rel=1e-8)
    assert abs(H[-1, 0] - H[0, 0] - 1e-3) > 1e-4


def test_a_slip_makes_a_torque():
    """By hand: 14 kg 9.81 m/s^2 2 um / 0.54 kg m^2 = 5.0867e-4 rad/s^2 about +y, from rest."""
    slip = Defects(com_steps=(ComStep(1.0, 0.05, np.array([2e-6, 0.0, 0.0])),))
    run = defective_run.simulate(body(), (), slip, 3.0)
    np.testing.assert_allclose(run.rate[1000], 0, atol=1e-12)
    late = 1.025 + 2 / defective_run.TIGHT  # the middle of the slip, and the servo's lag
    assert run.rate[3000, 1] == pytest.approx(5.0867e-4 * (3.0 - late), rel=1e-4)
    np.testing.assert_allclose(run.rate[3000, [0, 2]], 0, atol=1e-9)


def test_a_slip_moves_the_centre_of_mass_by_what_is_stated():
    """As the run and the record have it, among masses that stay where they are."""
    slips = (
        ComStep(1.0, 0.05, np.array([1e-6, -2e-6, 3e-6])),
        ComStep(2.0, 0.05, np.array([4e-6, 0, 0])),
    )
    case = cases.case_s(1, defects=Defects(com_steps=slips)).case
    defects = Defects(com_steps=slips)
    run = defective_run.simulate(case.platform, (), defects, 3.0)
    still = defective_run.simulate(case.platform, (), Defects(), 3.0)
    between = run.com[[0, 1500, 3000]] - still.com[[0, 1500, 3000]]
    np.testing.assert_allclose(np.diff(between, axis=0), [s.shift for s in slips], atol=2e-8)
    np.testing.assert_array_equal(defects.com_shift(1.5), slips[0].shift)
    np.testing.assert_allclose(defects.com_shift(2.5), [5e-6, -2e-6, 3e-6], rtol=1e-12)
    assert run.displacement.shape == (3001, 3)


def test_the_slipping_part_has_no_effect_before_it_slips():
    """Its sag is along gravity and its points are at P: 60 s of motion agree to 1e-6 rad."""
    case = cases.case_s(1).case
    late = Defects(com_steps=(ComStep(60.0, 0.05, np.full(3, 1e-6)),))
    with_part = defective_run.simulate(case.platform, (), late, 60.0)
    without = defective_run.simulate(case.platform, (), Defects(), 60.0)
    assert oracle.angle_between(with_part.q, without.q).max() < 1e-6


def test_drag_takes_the_spin_away():
    """By hand: 2 exp(-0.017 / 0.85 10) = 1.637462 rad/s after 10 s about z alone."""
    run = oracle.simulate(
        body((0, 0, 2.0), viscous=np.array([0.5, 0.5, 0.017])), (), 10.0, locked=True
    )
    assert run.rate[-1, 2] == pytest.approx(1.637462, abs=1e-6)


def test_soft_servos_lag_by_25_ms_and_sag_by_a_millimetre_and_a_half():
    """2 / 80 s behind a ramp of constant speed, 10 mm/s: 0.25 mm; g / 80^2 = 1.533 mm down."""
    q = LEVEL
    platform = replace(cases.case_g(1).case.platform, q=q, rate=np.zeros(3), com=np.zeros(3))
    ramp = (oracle.Ramp(0.0, np.array([0.010, 0.010, 0.010]), even=True),)
    run = oracle.simulate(platform, ramp, 0.8)
    sent = sensors.where_masses_were_sent(run, ramp, 50.0)
    are = sensors.where_masses_are(run, 50.0)
    assert are.values[0] == pytest.approx([0, 0, -9.81 / 6400], abs=1e-15)
    assert sent.values[30] == pytest.approx([6e-3, 6e-3, 6e-3], rel=1e-12)
    lag = sent.values[30] - are.values[30]
    assert lag == pytest.approx([0.25e-3, 0.25e-3, 0.25e-3 + 9.81 / 6400], rel=0.01)


def test_the_sag_of_three_equal_masses_is_parallel_to_gravity():
    logged = cases.case_g(2)
    down_B = oracle.matrix(logged.run.q[0]).T @ np.array([0.0, 0.0, -1.0])
    np.testing.assert_allclose(
        logged.run.displacement[0], down_B * 9.81 / cases.SOFT**2, rtol=1e-12
    )


# --- the camera -----------------------------------------------------------------------------------


def test_attitudes_between_steps_are_those_of_a_finer_run():
    platform = cases.spinner(1).case.platform
    coarse = oracle.simulate(platform, (), 2.0, dt=1e-3, locked=True)
    fine = oracle.simulate(platform, (), 2.0, dt=0.25e-3, locked=True)
    between = sensors.attitude_at(coarse, fine.t)
    assert oracle.angle_between(between, fine.q).max() < 1e-8


def test_a_mean_of_frames_is_stamped_in_the_middle_and_is_short():
    """4 frames 25 ms apart: var = 0.78125e-3 s^2, so 1 - 4 0.78125e-3 / 8 at 2 rad/s."""
    run = spinning()
    rows = observed(run, Defects(frames=4, frame_gap=0.025))
    assert rows.length == pytest.approx(np.full(19, 1 - 0.390625e-3), abs=5e-8)
    assert rows.attitude.t[[0, -1]] == pytest.approx([0.1, 1.9])
    assert oracle.angle_between(rows.attitude.values, run.q[100:1901:100]).max() < 1e-9


def test_a_single_last_row_is_the_first_frame_of_its_mean():
    """37.5 ms early, so 0.075 rad back at 2 rad/s, and of full length."""
    run = spinning()
    rows = observed(run, Defects(frames=4, last_row_single=True))
    assert rows.attitude.t[-1] == pytest.approx(2.0)
    assert rows.length[-1] == pytest.approx(1.0, abs=1e-14)
    assert turn_N(rows.attitude.values[-1], run.q[-1])[2] == pytest.approx(-0.075, rel=1e-3)
    assert np.all(rows.length[:-1] < 0.9997)


@pytest.mark.parametrize("frames", [1, 4])
def test_a_mean_has_the_stated_noise(frames):
    """2001 rows, three axes: the sd is known to 1 %."""
    run = spinning(20.0)
    rows = sensors.camera(run, np.random.default_rng(1), 100.0, 2e-3, Defects(frames=frames))
    first = round(rows.attitude.t[0] * 1000)
    true = run.q[first::10][: len(rows.attitude)]
    assert np.std(turn_N(rows.attitude.values, true)) == pytest.approx(2e-3, rel=0.04)


def test_a_plumb_error_leans_the_laboratory():
    """exp((a, 0, 0)) on the left: body z of a level platform shows at (0, -a, 1)."""
    run = spinning()
    rows = observed(run, Defects(plumb=np.array([0.005, 0.0])))
    for q in rows.attitude.values:
        assert oracle.matrix(q)[:, 2] == pytest.approx([0, -0.005, 1], abs=2e-5)
    both = observed(run, Defects(plumb=np.array([0.003, -0.004])))
    error = turn_N(both.attitude.values, run.q[::100])
    np.testing.assert_allclose(error, np.tile([0.003, -0.004, 0.0], (21, 1)), atol=1e-7)


def test_the_heading_grows_with_a_turn_about_the_vertical_and_forgets_tilt():
    psi = np.deg2rad(30.0)
    q = oracle.rotation(np.array([0.0, 0.0, psi]))
    assert sensors.heading(q) == pytest.approx(psi)
    lean = oracle.rotation(0.3 * np.array([np.cos(psi), np.sin(psi), 0.0]))  # about body x
    assert sensors.heading(oracle.product(lean, q)) == pytest.approx(psi)


def test_heading_errors_stand_in_body_axes():
    """c cos 2 psi + s sin 2 psi: c at 0 deg, s at 45, -c at 90, -s at 135."""
    c, s = np.array([1e-3, 0.0, 2e-3]), np.array([0.0, -2e-3, 1e-3])
    psi = np.deg2rad([0.0, 45.0, 90.0, 135.0])
    true = oracle.rotation(np.outer(psi, [0.0, 0.0, 1.0]))
    measured = sensors.in_camera_axes(true, Defects(heading=(Harmonic(2, c, s),)))
    np.testing.assert_allclose(turn_B(measured, true), [c, s, -c, -s], atol=1e-8)


def test_heading_errors_of_order_3_come_round_three_times():
    c = np.array([0.0, 1e-3, 0.0])
    error = sensors.heading_error(np.deg2rad(np.arange(0, 360, 60.0)), (Harmonic(3, c, 0 * c),))
    np.testing.assert_allclose(error[:, 1], 1e-3 * (-1.0) ** np.arange(6), atol=1e-15)


def test_a_delayed_camera_shows_what_was():
    """30 ms at 2 rad/s: 0.06 rad back. Before the first frame there is no row."""
    run = spinning()
    rows = observed(run, Defects(camera_delay=0.030))
    assert rows.attitude.t[0] == pytest.approx(0.1)
    error = turn_N(rows.attitude.values, run.q[100::100])
    np.testing.assert_allclose(error[:, 2], -0.06, rtol=1e-3)


def test_bad_rows_are_turned_and_no_others():
    run = spinning()
    turn = np.array([0.0, 0.2, 0.0])
    rows = observed(run, Defects(bad_rows=(BadRow(0.7, turn),)))
    off = oracle.angle_between(rows.attitude.values, run.q[::100])
    assert off[7] == pytest.approx(0.2)
    assert np.delete(off, 7).max() < 1e-9


# --- the gyro -------------------------------------------------------------------------------------


def test_a_gyro_reads_what_its_matrix_and_zero_make_of_the_rate():
    """By hand: (E + M) (0, 0, 2) + b with M_xz = 0.01, M_zz = -0.02."""
    M = np.array([[0, 0, 0.01], [0, 0, 0], [0, 0, -0.02]])
    wrong = Defects(gyro_matrix=M, gyro_bias=np.array([1e-3, 2e-3, 3e-3]))
    rows = sensors.gyro(spinning(), np.random.default_rng(0), 100.0, 0.0, wrong)
    np.testing.assert_allclose(rows.values, np.tile([0.021, 0.002, 1.963], (201, 1)), atol=1e-12)


def test_a_gyro_that_sits_turned_sees_the_rate_turn_the_other_way():
    """Turned by +t about z, it sees w = (1, 0, 0) as (1, -t, 0)."""
    ranges = flaws.Ranges(scale=0.0)
    M = flaws.gyro_matrix(np.random.default_rng(4), ranges)
    x, y, z = np.random.default_rng(4).normal(0.0, ranges.misalignment, 3)
    np.testing.assert_allclose(M @ [1.0, 0, 0], [0, -z, y])
    np.testing.assert_allclose(M, -np.cross([x, y, z], np.eye(3)).T)


def test_a_coarse_gyro_gives_whole_multiples():
    """2 rad/s = 1833.46 sixteenths of a degree per second, so 1833 of them."""
    coarse = Defects(gyro_quantum=flaws.SIXTEENTH)
    rows = sensors.gyro(spinning(), np.random.default_rng(0), 100.0, 0.0, coarse)
    np.testing.assert_allclose(np.rad2deg(rows.values[:, 2]), 1833 / 16, rtol=1e-12)


# --- drawing --------------------------------------------------------------------------------------


def values_of(defects):
    return {name: repr(getattr(defects, name)) for name in Defects.__dataclass_fields__}


@pytest.mark.parametrize("kind", flaws.KINDS)
def test_a_kind_is_the_same_alone_and_with_others(kind):
    alone = values_of(flaws.drawn(np.random.default_rng(7), (kind,), 120.0, 5.0))
    together = values_of(flaws.drawn(np.random.default_rng(7), flaws.KINDS, 120.0, 5.0))
    nothing = values_of(Defects())
    changed = {name for name in nothing if alone[name] != nothing[name]}
    assert changed
    assert all(alone[name] == together[name] for name in changed)


def test_sizes_are_within_their_ranges():
    for seed in range(50):
        found = flaws.drawn(np.random.default_rng(seed), flaws.KINDS, 120.0, 5.0)
        assert 1 <= len(found.contacts) <= 4
        assert all(0.2e-3 <= np.linalg.norm(c.impulse) <= 2e-3 for c in found.contacts)
        assert all(0.010 <= c.duration <= 0.050 for c in found.contacts)
        assert all(4.8 <= c.time <= 115.2 for c in (*found.contacts, *found.com_steps))
        assert len(found.bad_rows) == 6
        assert all(1 <= np.rad2deg(np.linalg.norm(b.turn)) <= 20 for b in found.bad_rows)
        assert 0.1 <= np.rad2deg(np.linalg.norm(found.plumb)) <= 0.5
        assert [h.order for h in found.heading] == [2, 3]
    with pytest.raises(ValueError, match="no such kinds"):
        flaws.drawn(np.random.default_rng(0), ("contact",), 120.0, 5.0)


# --- whole cases ----------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(thorough.count(3, 1)))
def test_cases_move_as_promised(seed):
    for case, tilt, rate in ((cases.case_g, 14.0, 1.3), (cases.spinner, 7.0, 110.0)):
        logged = case(seed)
        up = np.array([oracle.matrix(q) @ logged.testbed.up for q in logged.run.q[::100]])
        assert np.rad2deg(np.arccos(up[:, 2])).max() < tilt
        assert np.rad2deg(np.abs(logged.run.rate)).max() < rate


def test_both_logs_of_masses_are_of_the_same_record():
    logged = cases.case_g(1, (flaws.PLUMB,))
    same, sent = logged.recording, logged.commanded
    np.testing.assert_array_equal(same.attitude.values, sent.attitude.values)
    np.testing.assert_array_equal(same.rate.values, sent.rate.values)
    assert sent.masses.values[-1] == pytest.approx(cases.MOVE)
    assert np.abs(sent.masses.values - same.masses.values).max() == pytest.approx(1.7e-3, rel=0.1)


def test_other_defects_leave_platform_and_noise_alone():
    plain, plumbed = cases.case_s(3), cases.case_s(3, (flaws.PLUMB,))
    np.testing.assert_array_equal(plain.run.q, plumbed.run.q)
    np.testing.assert_array_equal(plain.testbed.body.inertia_P, plumbed.testbed.body.inertia_P)
    error = turn_N(plumbed.recording.attitude.values, plain.recording.attitude.values)
    np.testing.assert_allclose(error, np.tile([*plumbed.defects.plumb, 0.0], (601, 1)), atol=1e-6)


def test_bad_rows_are_marked():
    logged = cases.case_s(2, (flaws.BAD_ROWS, flaws.LAST_ROW))
    assert np.count_nonzero(logged.bad_row) == 7
    assert logged.bad_row[-1]


@pytest.mark.parametrize("case", [cases.case_s, cases.case_g, cases.spinner])
def test_without_defects_truth_is_found(case):
    """Errors of com and inertia in units of the stated sd, where the masses are known."""
    logged = case(1)
    hold = ("com_y",) if case is cases.spinner else ()
    *_, last = identify(logged.recording, logged.testbed, IdentifyOptions("trajectory", hold=hold))
    names = tuple(name for name in COM + INERTIA if name not in hold)
    true = dict(
        zip(
            COM + INERTIA, [*logged.truth.com, *pack_symmetric(logged.truth.inertia_P)], strict=True
        )
    )
    estimate = last.estimate
    sd = np.array([estimate.parameters[estimate.index(name)].sd for name in names])
    z = (estimate.values(names) - [true[name] for name in names]) / sd
    assert estimate.outcome.usable
    assert np.abs(z).max() < 4.0
