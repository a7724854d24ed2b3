"""What linear methods say of themselves: covariance, bias, what is left out, what moves unseen."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import LINEAR, METHODS
from equipoise.estimation.regression.linear_method import bands, excess, posed_of
from equipoise.estimation.regression.monte_carlo_replicates import Drawn, drawn, pairs
from equipoise.maths.attitude import difference
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.recording import Samples
from equipoise.model.testbed import AttitudeSensor
from tests.support import thorough
from tests.support.builders import COM, INERTIA, move_at, noisy, platform, recording
from tests.support.driven_records import driven, driven_platform
from tests.support.outcomes import codes_of

NAMES = (*COM_NAMES, *INERTIA_NAMES)
TRUTH = np.array([*COM, *INERTIA])
LENGTH, SHORT = (60.0, 30.0) if thorough.THOROUGH else (30.0, 15.0)  # s
RECORDS = 12


def run(name, recording_, testbed, **options):
    return METHODS[name].run(recording_, testbed, Options(**options))


def posed(knows=False):
    bed = replace(platform(accuracy=1e-4, gyro=True), inertia_sd=0.1 if knows else 0.0)
    return posed_of(noisy(recording(30.0, move_at(10.0, 30.0), 5.0, 20.0), 1), bed, Options())


# --- Errors drawn anew ------------------------------------------------------------------------


def test_draws_come_in_pairs_of_opposite_sign():
    """Their mean is the record to second order, and half their difference has the stated sd."""
    first, second = next(pairs(posed(), Drawn()))
    w = posed().recording.rate.values
    plus, minus = (each.recording.rate.values - w for each in (first, second))
    np.testing.assert_allclose(plus, -minus, atol=1e-15)
    assert plus.std() == pytest.approx(1e-4, rel=0.05)
    q = posed().recording.attitude.values
    turns = [difference(each.recording.attitude.values, q) for each in (first, second)]
    np.testing.assert_allclose(turns[0], -turns[1], atol=1e-4)


def test_draws_are_the_same_every_time_and_differ_from_one_another():
    one, again, other = (drawn(posed(), k, 1.0, Drawn()) for k in (3, 3, 4))
    np.testing.assert_array_equal(one.recording.rate.values, again.recording.rate.values)
    assert not np.array_equal(one.recording.rate.values, other.recording.rate.values)


def test_masses_are_drawn_where_they_may_have_stopped():
    """Stops of 0.1 mm: before the move nothing changes, behind it a tenth of a millimetre does."""
    moved = [drawn(posed(), k, 1.0, Drawn()).recording.masses for k in range(60)]
    at = np.array([[np.interp(s, m.t, m.values[:, 2]) for s in (5.0, 29.0)] for m in moved])
    true = np.interp([5.0, 29.0], move_at(10.0, 30.0).t, move_at(10.0, 30.0).values[:, 2])
    assert np.abs(at[:, 0] - true[0]).max() < 1e-12
    assert np.sqrt(np.mean((at[:, 1] - true[1]) ** 2)) == pytest.approx(1e-4, rel=0.3)


def test_an_inertia_that_is_taken_as_known_is_drawn_by_its_sd():
    moments = [
        drawn(posed(True), k, 1.0, Drawn(inertia=True)).testbed.body.inertia_P[1, 1]
        for k in range(60)
    ]
    assert np.std(moments) == pytest.approx(0.1 * INERTIA[1], rel=0.3)
    assert drawn(posed(True), 0, 1.0, Drawn()).testbed.body.inertia_P[1, 1] == INERTIA[1]


def test_noise_alone_can_be_drawn():
    """Where masses stopped and the testbed's inertia then stay as they are."""
    alone = drawn(posed(True), 2, 1.0, Drawn(constant=False))
    whole = posed(True)
    at = [np.interp(29.0, r.masses.t, r.masses.values[:, 2]) for r in
          (alone.recording, whole.recording)]  # fmt: skip
    assert at[0] == pytest.approx(at[1], abs=1e-12)
    assert not np.array_equal(alone.recording.rate.values, whole.recording.rate.values)


def test_a_leaning_camera_is_drawn():
    """By 0.3 deg about level axes; a level one is not turned."""
    bed = replace(posed().testbed, attitude=AttitudeSensor(5.0, 1e-9))
    leaning = posed_of(posed().recording, bed, Options())
    turns = [difference(drawn(leaning, k, 1.0, Drawn()).recording.attitude.values[:1],
                        leaning.recording.attitude.values[:1])[0] for k in range(80)]  # fmt: skip
    assert np.degrees(np.sqrt(np.sum(np.square(turns)) / 160)) == pytest.approx(0.3, rel=0.2)


# --- Covariance and bias ----------------------------------------------------------------------


@thorough.whole
def test_stated_sd_is_the_scatter_of_records():
    """Corrected momentum on records of half a minute: sd within 30 % of scatter, pooled."""
    bed = driven_platform()
    found = [run("momentum_corrected", driven(seed, 30.0), bed) for seed in range(RECORDS)]
    values = np.array([each.values(NAMES) for each in found])
    stated = np.array([[each.parameters[each.index(n)].sd for n in NAMES] for each in found])
    z = (values - TRUTH) / stated
    assert np.mean(z**2) == pytest.approx(1.0, abs=0.35)


def test_the_bias_of_a_noisy_regressor_is_found_and_reported():
    """A gyro ten times as noisy: J low by percents; the bias is in the interval, and reported."""
    bed, record = driven_platform(), driven(1, LENGTH)
    rng = np.random.default_rng(2)
    w = record.rate.values + 10 * bed.gyro.noise * rng.normal(size=record.rate.values.shape)
    noisy_bed = replace(bed, gyro=replace(bed.gyro, noise=10.05 * bed.gyro.noise))
    spoiled = replace(record, rate=Samples(record.rate.t, w))
    plain, corrected = (run(n, spoiled, noisy_bed) for n in ("momentum_body", "momentum_corrected"))
    assert np.all(plain.values(INERTIA_NAMES[:3]) / INERTIA[:3] < 0.99)
    assert "bias_by_noise" in codes_of(plain)
    assert plain.outcome.trust == "not_trustworthy"
    for each in (plain, corrected):
        sd = np.sqrt(np.diag(each.covariance_of(NAMES)))
        assert np.all(np.abs(each.values(NAMES) - TRUTH) < 4 * sd)
    assert "bias_by_noise" not in codes_of(corrected)
    np.testing.assert_allclose(corrected.values(INERTIA_NAMES[:3]), INERTIA[:3], rtol=0.01)


def test_what_the_simplified_model_omits_is_reported_and_included_in_the_sd():
    bed = driven_platform()
    bed = replace(bed, body=replace(bed.body, inertia_P=unpack_symmetric(INERTIA)), inertia_sd=0.0)
    found = run("simplified", driven(1, LENGTH), bed)
    assert "bias_by_model" in codes_of(found)
    sd = np.sqrt(np.diag(found.covariance_of(COM_NAMES)))
    assert np.all(np.abs(found.com - COM) < 3 * sd)


def test_an_unreported_torque_makes_the_estimate_unusable_and_is_reported():
    """The known torque left out of half the record: far more than noise is left, and it says so."""
    record = driven(1, LENGTH)
    torque = record.torque
    half = torque.values * (torque.t < LENGTH / 2)[:, None]
    found = run("momentum_body", replace(record, torque=Samples(torque.t, half)), driven_platform())
    assert not found.outcome.usable
    assert "residual_too_large" in codes_of(found)


def test_regressor_bias_is_not_mistaken_for_an_unreported_torque():
    """Slopes of a cubic lose percents of J; without that, what is left is noise."""
    found = run("torque_savitzky_golay", driven(1, LENGTH), driven_platform())
    assert {"bias_by_noise", "regressor_noise_too_large"} & set(codes_of(found))
    assert found.residual.spectral_peak < 2.0


def test_excess_is_one_for_noise_and_the_ratio_for_more():
    rng = np.random.default_rng(3)
    left = rng.normal(size=(2000, 3))
    expected = np.full(1001, 3.0 * 2000)
    assert excess(left, expected) == 1.0
    slow = 20 * np.sin(2 * np.pi * np.arange(2000) / 1000.0)[:, None] * np.ones(3)
    # 3 axes, (20 x 1000)^2 in one of five bins of 6000 each
    assert excess(left + slow, expected) == pytest.approx(3 * 4e8 / 5 / 6000, rel=0.1)


def test_bands_cover_every_frequency_once():
    covered = np.concatenate([np.arange(band.start, band.stop) for band in bands(801)])
    assert covered.tolist() == list(range(1, 801))


# --- Forms that must agree --------------------------------------------------------------------


@pytest.mark.usefixtures("few_draws")
def test_damped_and_possible_end_where_least_squares_do():
    names = ("momentum_body", "momentum_damped", "momentum_possible")
    plain, *others = (run(name, driven(1, LENGTH), driven_platform()) for name in names)
    sd = np.sqrt(np.diag(plain.covariance_of(NAMES)))
    for other in others:
        assert np.all(np.abs(other.values(NAMES) - plain.values(NAMES)) < 1e-3 * sd)


def test_error_indices_of_a_good_fit_are_small():
    """What is left is noise of 1e-3 rad/s times J, beside momenta of some 0.01 N m s."""
    residual = run("momentum_body", driven(1, LENGTH), driven_platform()).residual
    assert 0 < residual.error_index < 0.1
    assert set(residual.error_indices) == set(NAMES)
    assert all(0 < value < 1 for name, value in residual.error_indices.items() if "P_xx" in name)


@pytest.mark.usefixtures("few_draws")
@pytest.mark.parametrize("module", thorough.some(LINEAR, 6), ids=lambda m: m.METHOD.card.name)
def test_every_linear_method_finds_a_held_body(module):
    """J held at the truth, fine sensors: com within 4 stated sd on a known drive."""
    bed = driven_platform()
    bed = replace(bed, body=replace(bed.body, inertia_P=unpack_symmetric(INERTIA)), inertia_sd=0.0)
    found = module.METHOD.run(driven(1, SHORT), bed, Options(hold=INERTIA_NAMES))
    if not found.outcome.usable:
        assert {"regressor_noise_too_large", "residual_too_large"} & set(codes_of(found))
        return
    sd = np.sqrt(np.diag(found.covariance_of(COM_NAMES)))
    assert np.all(np.abs(found.com - COM) < 4 * sd)
