"""The published filters as methods: they find what made the record, in units of their own sd."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods import (
    ekf_6,
    ekf_9,
    ekf_12,
    kf_simplified,
    ukf_4,
    ukf_6,
    ukf_9,
    ukf_12,
)
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro
from equipoise.study.method_record import Scene, judged_record
from tests.oracle import mujoco_bench as oracle
from tests.support import thorough
from tests.support.builders import (
    COM,
    INERTIA,
    MASS,
    RATE,
    line_of,
    move_at,
    noisy,
    platform,
    recording,
    travel,
)
from tests.support.outcomes import codes_of
from tests.support.random_walk_records import guessed, square_waves, walked

FREE = (kf_simplified, ekf_6, ekf_9, ukf_6, ukf_9)
DRIVEN = (ekf_12, ukf_12)
EVERY = (*FREE, *DRIVEN, ukf_4)
SEEDS = 20
every_filter = pytest.mark.parametrize("module", EVERY, ids=lambda m: m.METHOD.card.name)
free_filter = pytest.mark.parametrize("module", FREE, ids=lambda m: m.METHOD.card.name)
driven_filter = pytest.mark.parametrize("module", DRIVEN, ids=lambda m: m.METHOD.card.name)


def estimate(module, record, testbed):
    return module.METHOD.run(record, testbed, Options())


def errors(found, com, inertia=INERTIA):
    """Errors in stated sd."""
    truth = dict(zip((*COM_NAMES, *INERTIA_NAMES), (*com, *inertia), strict=True))
    return [(p.value - truth[p.name]) / p.sd for p in found.parameters]


def squares(module, inertia_sd, torque=None, seeds=SEEDS):
    """Mean square of error / sd over seeds; every outcome has to be usable."""
    z = []
    for seed in range(seeds):
        record, com = walked(seed, 60.0, torque)
        found = estimate(module, record, guessed(seed, inertia_sd))
        assert found.outcome.usable, found.outcome.sentence
        z.append(errors(found, com))
    return np.array(z)


@free_filter
def test_errors_are_as_large_as_stated(module):
    """20 swings, J exact: the mean square of 60 errors, each of sd 1, is 1 +- 0.18 of one sd.

    The upper bound is of 3 sd and 10 % that the noise of the attitude, an input, adds.
    """
    z = squares(module, 0.0)
    assert 0.5 < np.mean(z**2) < 1.65
    assert np.abs(z).max() < 4


@free_filter
def test_intervals_know_how_well_the_inertia_is_known(module):
    """20 swings with J drawn 5 % off: intervals of 95 % hold at least 88 % of 60 errors."""
    z = squares(module, 0.05)
    assert np.mean(np.abs(z) < 1.96) > 0.88


@pytest.mark.parametrize("module", [ekf_6, ekf_9, ukf_6], ids=lambda m: m.METHOD.card.name)
def test_an_interval_that_took_a_wrong_inertia_for_exact_would_not_hold(module):
    """The same swings, J taken as exact: errors of several sd, so the last test can fail."""
    z = []
    for seed in range(5):
        record, com = walked(seed)
        found = estimate(module, record, replace(guessed(seed, 0.05), inertia_sd=0.0))
        z.append(errors(found, com))
    assert np.mean(np.square(z)) > 4


@driven_filter
@pytest.mark.parametrize("inertia_sd", [0.05, 0.1])
def test_inertia_and_com_are_found_under_known_torques(module, inertia_sd):
    """A minute of square waves of 10 mN m: nine errors in each of 10 records, as large as stated.

    J to better than 0.1 %, from a guess of 5 or 10 %.
    """
    z = squares(module, inertia_sd, square_waves(60.0), 10)
    assert 0.6 < np.mean(z**2) < 1.5
    assert np.abs(z).max() < 4.5
    record, _ = walked(0, 60.0, square_waves(60.0))
    found = estimate(module, record, guessed(0, inertia_sd))
    sd = np.sqrt(np.diag(found.covariance_of(INERTIA_NAMES)))[:3]
    assert np.all(sd < 1e-3 * INERTIA[:3])


@pytest.mark.parametrize("across", [1e-7, 3e-6])
def test_height_alone_is_found_where_the_rest_is_balanced(across):
    """com_z of 20 swings, com across known to 0.1 or 3 um, of which the interval takes notice."""
    z, sd = [], []
    for seed in range(SEEDS):
        record, com = walked(seed)
        rng = np.random.default_rng(seed)
        first = COM + np.array([across, across, 3e-5]) * rng.normal(size=3)
        body = MassProperties(MASS, first, unpack_symmetric(INERTIA))
        testbed = replace(
            platform(gyro=True), inertia_sd=0.0, com_sd=np.array([across, across, 3e-5]), body=body
        )
        found = estimate(ukf_4, record, testbed)
        (only,) = found.parameters
        assert only.name == "com_z"
        z.append((only.value - com[2]) / only.sd)
        sd.append(only.sd)
    assert np.mean(np.square(z)) < 1.9
    assert np.mean(sd) < 1.5e-6 + 10 * across


SWINGS = [(name, seed) for name in ("reference-table", "unb", "cubesat-tas", "nanosat")
          for seed in thorough.some(range(1, 6), 2)]  # fmt: skip


def strayed(preset, seed):
    """How far the height goes per offset across up, times the sine of the rms tilt of a swing.

    J is exact. The filter is linear in the offset: 1 um along x and along y are enough.
    """
    record = judged_record(Scene(read_preset(preset), 60.0, (), Options()), seed)
    com = np.array([record.truth[name] for name in COM_NAMES])
    six = np.array([record.truth[name] for name in INERTIA_NAMES])

    def height(off):
        body = replace(record.testbed.body, com=com - off, inertia_P=unpack_symmetric(six))
        known = replace(
            record.testbed, body=body, com_sd=np.array([0.0, 0.0, 1e-4]), inertia_sd=0.0
        )
        (only,) = estimate(ukf_4, record.recording, known).parameters
        return only.value

    exact = height(np.zeros(3))
    slopes = [(height(1e-6 * axis) - exact) / 1e-6 for axis in np.eye(3)[:2]]
    level = to_matrix(record.recording.attitude.values)[:, 2, :2]
    return np.hypot(*slopes) * np.sqrt(np.mean(np.sum(level**2, axis=1)))


def test_the_card_has_the_size_of_what_an_offset_across_up_does_to_the_height():
    found = [strayed(*swing) for swing in SWINGS]
    least, most = ukf_4.STRAYS
    assert min(found) > 0.95 * least
    assert max(found) < 1.05 * most
    assert max(found) > 0.7 * most
    assert min(found) < 2.0 * least
    assert f"{least:g} to {most:g} um / sin(rms tilt)" in ukf_4.METHOD.card.cannot_see
    at_six = np.array([least, most]) / np.sin(np.radians(6.0))
    assert "{:.0f} to {:.0f} um at 6 deg".format(*at_six) in ukf_4.METHOD.card.cannot_see


def test_a_height_that_is_hidden_stays_as_the_testbed_has_it_and_says_so():
    """com across up known to 100 um: the record says nothing of com_z, which is 50 um off."""
    record, com = walked(0)
    body = MassProperties(MASS, np.append(com[:2], com[2] + 5e-5), unpack_symmetric(INERTIA))
    testbed = replace(platform(gyro=True), inertia_sd=0.0, com_sd=np.full(3, 1e-4), body=body)
    (only,) = estimate(ukf_4, record, testbed).parameters
    assert only.value - com[2] == pytest.approx(5e-5, rel=0.3)
    assert only.sd == pytest.approx(1e-4, rel=0.1)


@pytest.mark.parametrize("up", [[0.0, 0, -1], [1.0, 0, 0], [0.6, 0, 0.8]])
def test_the_component_along_up_has_its_name_and_sign(up):
    """com_z for z down, com_x for x up, com_up for neither; begun and left near the testbed's."""
    record, _ = walked(0, 10.0)
    testbed = replace(platform(gyro=True), inertia_sd=0.0, com_sd=np.full(3, 1e-9))
    testbed = replace(testbed, up=np.array(up))
    (only,) = estimate(ukf_4, record, testbed).parameters
    names = {(0.0, 0, -1): ("com_z", [0, 0, 1]), (1.0, 0, 0): ("com_x", [1, 0, 0])}
    name, axis = names.get(tuple(up), ("com_up", up))
    assert only.name == name
    assert abs(only.value - testbed.body.com @ axis) < 1e-6


@every_filter
def test_a_known_move_passes_through(module):
    """com with the masses at home, although they end 10 to 50 mm away: within 4 sd."""
    record, com = walked(3, 60.0, square_waves(60.0, 1e-4), move_at(20.0, 60.0))
    testbed = guessed(3, 0.0 if module not in DRIVEN else 0.05)
    if module is ukf_4:
        testbed = replace(testbed, com_sd=np.array([1e-7, 1e-7, 1e-4]))
        testbed = replace(testbed, body=replace(testbed.body, com=COM))
    found = estimate(module, record, testbed)
    assert found.outcome.usable, found.outcome.sentence
    assert np.abs(errors(found, com)).max() < 4
    moved = 1e-2 * 0.0156 / MASS
    sd = [p.sd for p in found.parameters if p.name.startswith("com")]
    assert max(sd[:2]) < 0.2 * moved  # so forgetting the move would show


def gapped(record: Recording, start: float, end: float) -> Recording:
    def cut(channel):
        keep = (channel.t < start) | (channel.t > end)
        return Samples(channel.t[keep], channel.values[keep])

    return replace(record, attitude=cut(record.attitude), rate=cut(record.rate))


@free_filter
def test_a_gap_of_20_s_adds_only_its_random_walk_variance(module):
    """Errors within 4 sd; the course goes on with what was known, less what it has walked."""
    record, com = walked(5, 80.0)
    found = estimate(module, gapped(record, 30.0, 50.0), guessed(5, 0.0))
    assert found.outcome.usable
    assert np.abs(errors(found, com)).max() < 4
    course = found.course
    behind = int(np.searchsorted(course.t, 40.0))
    assert course.t[behind] - course.t[behind - 1] > 19
    grown = course.sd[behind] ** 2 - course.sd[behind - 1] ** 2
    np.testing.assert_allclose(grown, 5e-8**2 * np.diff(course.t)[behind - 1], rtol=1e-3)


@every_filter
def test_where_masses_stopped_is_part_of_the_interval(module):
    """0.3 mm of where each of three masses stops is 0.33 um of com, at least."""
    record = noisy(recording(40.0, move_at(10.0, 40.0), 5.0, 20.0), 2)
    exact, rough = (
        estimate(module, record, replace(platform(a, gyro=True), inertia_sd=0.01))
        for a in (0.0, 3e-4)
    )
    gain = rough.parameters[0].sd ** 2 - exact.parameters[0].sd ** 2
    assert gain > 0.99 * (3e-4 * 0.0156 / MASS) ** 2


def test_the_simplified_model_says_when_it_does_not_hold():
    """At 10 deg/s the gyroscopic torque moves com by tens of um: reported, and in the interval.

    The bias is what the full filter does not have; on a ball nothing is left out or reported.
    """
    testbed, record = replace(platform(gyro=True), inertia_sd=0.0), spun(10.0)
    found, whole = (estimate(m, record, testbed) for m in (kf_simplified, ekf_6))
    assert "gyroscopic_torque_left_out" in codes_of(found)
    assert found.outcome.warns
    bias, sd = np.array([p.value for p in found.parameters]) - COM, [p.sd for p in found.parameters]
    assert np.abs(bias).max() > 10e-6
    assert np.abs(bias / sd).max() < 2
    assert whole.parameters[2].sd < 0.1 * max(sd)
    ball = MassProperties(MASS, COM, 0.5 * np.eye(3))
    held = estimate(kf_simplified, record, replace(testbed, body=ball))
    assert "gyroscopic_torque_left_out" not in codes_of(held)


def spun(times: float) -> Recording:
    """A noisy minute begun with ``times`` the shared rate."""
    t = np.arange(1201) / 20
    line = line_of(t)
    motion = travel(line, w0=times * RATE)
    q, w = motion.q[line.attitude_node], motion.rate[line.attitude_node]
    return noisy(Recording(Samples(t[::4], q[::4]), Samples(t, w)), 1)


@free_filter
def test_a_wrong_noise_or_body_is_not_usable(module):
    """A sensor ten times as noisy as stated: innovations say so."""
    record, _ = walked(1)
    testbed = guessed(1, 0.0)
    quiet = replace(
        testbed,
        attitude=replace(testbed.attitude, noise=0.1 * testbed.attitude.noise),
        gyro=replace(testbed.gyro, noise=0.1 * testbed.gyro.noise),
    )
    found = estimate(module, record, quiet)
    assert not found.outcome.usable
    assert codes_of(found)[0] == "filter_innovations_too_large"


@every_filter
def test_what_is_missing_is_said(module):
    """No camera, too few rows; no gyro where one is needed; nothing known that changes."""
    record, _ = walked(1, 20.0, square_waves(20.0))
    testbed = guessed(1, 0.05)
    short = replace(
        record, attitude=Samples(record.attitude.t[:6], record.attitude.values[:6]),
        rate=Samples(record.rate.t[:6], record.rate.values[:6]),
    )  # fmt: skip
    cases = [(replace(record, attitude=None), "no_camera"), (short, "too_few_rows_for_filter")]
    if not module.KIND.attitude:
        cases.append((replace(record, rate=None), "no_gyro"))
    if module in DRIVEN:
        cases.append((replace(record, torque=None), "no_known_input"))
    for lacking, code in cases:
        found = estimate(module, lacking, testbed)
        assert not found.outcome.usable
        assert found.parameters == ()
        assert codes_of(found) == [code]
    if module.KIND.unscented:
        found = estimate(module, record, guessed(1, 0.3))
        assert codes_of(found) == ["inertia_too_uncertain"]


@every_filter
def test_an_estimate_carries_course_and_origin(module):
    record, _ = walked(1, 20.0, square_waves(20.0))
    record = replace(record, source="there.csv", sha256="abc")
    found = estimate(module, record, guessed(1, 0.02))
    names = tuple(p.name for p in found.parameters)
    assert found.course.names == names
    np.testing.assert_array_equal(found.course.values[-1], [p.value for p in found.parameters])
    np.testing.assert_allclose(found.course.sd[-1], [p.sd for p in found.parameters], rtol=1e-12)
    assert found.provenance["source"] == "there.csv"
    assert found.provenance["sha256"] == "abc"
    assert found.covariance.shape == (len(names), len(names))


@free_filter
def test_records_of_an_independent_simulator_are_explained(module):
    """Three platforms of MuJoCo's, J exact, no walk: errors of com within 4 sd of one with walk."""
    for seed in range(3):
        rng = np.random.default_rng(seed)
        bench = oracle.random_platform(rng)
        run = oracle.simulate(bench, duration=40.0, dt=2e-3, locked=True)
        record = oracle.sensor_log(run, rng, 50.0, np.radians(0.05), 50.0, 1e-4, np.full(3, 1e-3))
        sensors = AttitudeSensor(50.0, np.radians(0.05)), Gyro(50.0, 1e-4, 0.01)
        testbed = oracle.testbed_for(bench, rng, 0.0, *sensors)
        body = MassProperties(bench.mass, np.array([0, 0, -1e-4]), bench.inertia_P)
        testbed = replace(testbed, body=body, inertia_sd=0.0, com_sd=np.full(3, 1e-4))
        found = estimate(module, record, testbed)
        assert found.outcome.usable, found.outcome.sentence
        assert np.abs(errors(found, bench.com)).max() < 4
