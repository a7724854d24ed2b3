"""What sag of the masses' drives adds to a fit: damping by hand, and the fit of sagging masses."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.output_error.servo_sag_covariance import (
    by_sag,
    damping,
    downward,
    lateness,
)
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.parameters.fit_parameters import JP, R, physical
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import inverse_spd, inverse_where
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from tests.support.builders import (
    GRAVITY,
    line_of,
    move_at,
    platform,
    recording,
    sliding_masses,
    travel,
)

END, MOVE = 120.0, move_at(60.0, 120.0)
AT_HOME = Samples(np.array([0.0, END]), np.zeros((2, 3)))
SAG, LATE = 2e-3, 0.04  # m, s
DOWN = np.array([0.0, 0.0, -1.0])


def soft(sag: float = SAG, lag: float = LATE) -> Testbed:
    """The shared platform with soft drives and sensors that see what they do."""
    bed = platform(gyro=True)
    assert bed.attitude is not None
    assert bed.gyro is not None
    masses = tuple(replace(mass, lag_sd=lag, sag_sd=sag) for mass in sliding_masses())
    camera, gyro = replace(bed.attitude, noise=2e-4), replace(bed.gyro, noise=1e-5)
    return replace(bed, masses=masses, attitude=camera, gyro=gyro)


def hung(sag: float, commands: Samples = MOVE) -> Recording:
    """The rows of masses that hang by ``sag`` and are late, and their commands.

    Where they hang follows the motion of masses that do not: the difference is of second order.
    """
    t = np.arange(int(END / 0.02) + 1) * 0.02
    late = np.column_stack([np.interp(t - LATE, commands.t, d) for d in commands.values.T])
    line = line_of(t, Samples(t, late))
    down = -to_matrix(travel(line).q[np.searchsorted(line.t, t - 1e-9)])[:, 2, :]
    hanging = sag * np.column_stack([np.interp(t - LATE, t, n) for n in down.T])
    observed = recording(END, Samples(t, late + hanging), gyro=20.0)
    return replace(observed, masses=commands)


def fitted(sag: float, bed: Testbed, commands: Samples = MOVE) -> Fitted:
    found = fit(hung(sag, commands), bed, Params())
    assert found.converged
    return found


@pytest.fixture(scope="module")
def stiff() -> Fitted:
    """The fit of masses that do not hang, though they might."""
    return fitted(0.0, soft())


def test_damping_by_hand(stiff):
    """Level: x's mass damps turns about y, y's about x, and z's none; m g s tau each."""
    sag, late = np.array([1e-3, 2e-3, 5e-3]), np.array([0.02, 0.03, 0.04])
    wanted = 0.0156 * GRAVITY * np.array([2e-3 * 0.03, 1e-3 * 0.02, 0.0])
    assert damping(stiff.problem, DOWN, sag, late) == pytest.approx(wanted, rel=1e-12, abs=1e-20)


def test_masses_that_hang_late_damp(stiff):
    """The weight of masses at s u.n(t - tau): what is not parallel to gravity is -C w, level."""
    w = np.array([0.02, -0.03, 0.05])
    late = DOWN + LATE * np.cross(w, DOWN)  # n a moment ago, since n' = n x w
    weight = 0.0156 * GRAVITY * DOWN
    torque = sum(np.cross(SAG * (u @ late) * u, weight) for u in np.eye(3))
    C = damping(stiff.problem, DOWN, np.full(3, SAG), np.full(3, LATE))
    assert torque == pytest.approx(-C * w, rel=1e-9, abs=1e-15)


def test_the_lag_is_found_and_counts_with_its_sd(stiff):
    """40 ms, of all three; the rms of value and doubt."""
    covariance = inverse_spd(stiff.at.normal)
    at = stiff.problem.layout.names.index("mass_lag_1")
    sd = np.sqrt(covariance[at, at])
    assert stiff.point.error[0] == pytest.approx(LATE, abs=0.2 * sd)
    wanted = np.hypot(stiff.point.error[0], sd)
    assert lateness(stiff, covariance).tolist() == pytest.approx([wanted] * 3)


def test_the_downward_direction_agrees_with_the_recorded_attitude(stiff):
    """At 30 s, from the record's own attitude; the record begins with 4 deg of tilt."""
    n, t = downward(stiff), stiff.problem.line.t
    record = hung(0.0)
    assert record.attitude is not None
    wanted = -to_matrix(record.attitude.values[150])[2]
    assert np.array([np.interp(30.0, t, c) for c in n.T]) == pytest.approx(wanted, abs=1e-5)
    assert np.degrees(np.arccos(-n[0, 2])) == pytest.approx(4.0, abs=0.1)


def test_what_is_carried_is_what_sag_does_to_the_fit(stiff):
    """Against fits of masses that hang by 2 mm: to a tenth of the sd of each parameter.

    The whole first moment hangs in the record, and only its damping is in what is carried.
    """
    problem, covariance = stiff.problem, inverse_spd(stiff.at.normal)
    there = fitted(SAG, soft()).point
    moved = physical(there, problem.mass, problem.layout)
    moved -= physical(stiff.point, problem.mass, problem.layout)
    moved[:3] = 0.0  # of the first attitude: a turn
    added = by_sag(stiff, covariance)
    sd = np.sqrt(np.diag(covariance))
    core = slice(6, 15)
    z = (moved / sd)[core]
    carried = (added / np.outer(sd, sd))[core, core]
    assert np.abs(z).max() > 1.0
    assert np.sqrt(np.diag(carried)) == pytest.approx(np.abs(z), abs=0.1 * np.abs(z).max())


def test_where_nothing_travels_masses_that_hang_move_no_com_but_the_shape_of_the_body():
    """com is theirs as they hang; J_zz/J_xx against the fit of masses that hang by 2 mm."""
    stiff, there = (fitted(sag, soft(), AT_HOME) for sag in (0.0, SAG))
    covariance = inverse_where(stiff.at.normal, ~stiff.problem.prior.held)
    added = by_sag(stiff, covariance)
    assert not added[R].any()
    fits = (stiff, there)
    before, after = (physical(f.point, f.problem.mass, f.problem.layout)[JP] for f in fits)
    slope = np.array([-before[2] / before[0] ** 2, 0.0, 1 / before[0], 0.0, 0.0, 0.0])
    moved = after[2] / after[0] - before[2] / before[0]
    assert np.sqrt(slope @ added[JP, JP] @ slope) == pytest.approx(abs(moved), rel=0.1)


def test_a_mass_that_stands_is_as_late_as_stated():
    """A drive's lag that no travel shows."""
    found = fitted(0.0, soft(), AT_HOME)
    assert lateness(found, inverse_spd(found.at.normal)).tolist() == [LATE] * 3


def test_stiff_drives_add_nothing():
    """Sag 0."""
    found = fitted(0.0, soft(sag=0.0))
    assert not by_sag(found, inverse_spd(found.at.normal)).any()


def test_without_a_camera_down_is_as_it_began():
    """A gyro alone: the tilt of the first attitude, all along."""
    bed = replace(soft(), attitude=None)
    found = fit(replace(hung(0.0), attitude=None), bed, Params())
    n = downward(found)
    assert n.shape == (len(found.problem.line.t), 3)
    assert np.ptp(n, axis=0).tolist() == [0, 0, 0]
    assert np.degrees(np.arccos(-n[0, 2])) == pytest.approx(4.0, abs=0.1)
