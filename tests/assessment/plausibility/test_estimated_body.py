"""An estimate that is none of the platform recorded is said to be, and no true one is."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.assessment.plausibility.estimated_body import with_plausibility
from equipoise.assessment.plausibility.swings_through_level import free_swings
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.estimate import BODY, COM, Estimate, Parameter
from equipoise.model.event import Event
from equipoise.model.outcome import OutcomeCode, Trust, outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.reasons.implausible_reasons import ImplausibleReason as Why
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.model.unread_input import InputKind, UnreadInput
from equipoise.procedure.identification.assess import AssessOptions, fit_of
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle.corpus import corpus_record
from tests.support import builders, thorough

BED = builders.platform()
END = 300.0  # s: seven swings
LIFTED = builders.COM * [1.0, 1.0, -1.0]
SD = 4e-6  # m
INERTIA = unpack_symmetric(builders.INERTIA)


def found(com, inertia=INERTIA, com_sd: float = SD, share: float = 1e-3) -> Estimate:
    """Return an estimate of a body with independent errors, J to a share of the largest moment."""
    values = np.append(pack_symmetric(inertia), com)
    sd = np.append(np.full(6, share * float(np.max(inertia))), np.full(3, com_sd))
    parameters = [
        Parameter(name, "", float(value), float(s), bool(np.isfinite(s)))
        for name, value, s in zip(BODY, values, sd, strict=True)
    ]
    covariance = np.diag(np.where(np.isfinite(sd), sd, 0.0) ** 2)
    return Estimate("test", outcome(EstimateReason.LINEAR), tuple(parameters), covariance)


def codes(estimate: Estimate, recording: Recording, testbed: Testbed = BED) -> set[Why]:
    """Return what makes an estimate implausible."""
    reasons = with_plausibility(estimate, recording, testbed).outcome.reasons
    return {reason.code for reason in reasons if isinstance(reason.code, Why)}


@pytest.fixture(scope="module")
def swing() -> Recording:
    """Return a camera's rows of a platform that hangs, 4 deg off level."""
    return builders.noisy(builders.recording(END), 1)


def test_a_lifted_centre_of_mass_contradicts_the_swings(swing):
    """By how many sd, how soon it would fall over, and how often it comes back, are said."""
    judged = with_plausibility(found(LIFTED), swing, BED)
    (reason,) = [r for r in judged.outcome.reasons if r.code is Why.SWINGS_WITH_COM_ABOVE]
    assert judged.outcome.trust is Trust.NOT_TRUSTWORTHY
    assert judged.outcome.code is OutcomeCode.ESTIMATED
    assert reason.numbers["sds"] == pytest.approx(79.0 / 4.0)
    stiffness = builders.MASS * builders.GRAVITY * (79.0e-6 - 3 * SD)
    largest = np.linalg.eigvalsh(INERTIA)[-1]
    assert reason.numbers["seconds"] == pytest.approx(np.sqrt(largest / stiffness))
    assert 2 * 5 < reason.numbers["count"] < 2 * 9
    again = with_plausibility(judged, swing, BED)
    assert again.outcome == judged.outcome


def test_what_is_true_or_open_is_plausible(swing):
    """The true body; a height that chance explains; one too small to have fallen over."""
    assert not codes(found(builders.COM), swing)
    assert not codes(found(LIFTED, com_sd=30e-6), swing)
    assert not codes(found(LIFTED / 100, com_sd=1e-9), swing)
    assert not codes(found(LIFTED, com_sd=np.inf), swing)


def test_a_ratio_shows_a_lifted_centre_of_mass_too(swing):
    """Where the scale is open its sign is known."""
    top = "inertia_P_zz"
    ratios = tuple(
        Parameter(f"{name}/{top}", "1/(kg m)", float(value) / INERTIA[2, 2], SD / INERTIA[2, 2])
        for name, value in zip(COM, LIFTED, strict=True)
    )
    estimate = found(LIFTED, com_sd=np.inf)
    assert codes(replace(estimate, ratios=ratios), swing) == {Why.SWINGS_WITH_COM_ABOVE}
    rough = tuple(replace(each, sd=20 * each.sd) for each in ratios)
    assert not codes(replace(estimate, ratios=rough), swing)


def test_a_platform_that_is_driven_touched_or_stopped_may_have_it_above(swing):
    """Wheels, a column that nothing reads, an event, a stop at 3 deg."""
    lifted, rows = found(LIFTED), len(swing.attitude)
    stored = Samples(swing.attitude.t, np.tile([0.0, 0.0, 1.0], (rows, 1)))
    assert not codes(lifted, replace(swing, momentum=stored))
    unread = (UnreadInput("pwm", InputKind.COMMAND, 0.0, 1.0),)
    assert not codes(lifted, replace(swing, unread=unread))
    touch = Event("impulse", 100.0, 0.1, np.full(3, 1e-3), np.eye(3) * 1e-8, 99.0)
    assert not codes(replace(lifted, events=(touch,)), swing)
    assert not codes(lifted, swing, replace(BED, tilt_limit=np.radians(3.0)))
    assert not codes(lifted, replace(swing, attitude=None, rate=stored))


def test_noise_at_rest_is_no_swing():
    """Rows that scatter about level pass it at every other one."""
    t = np.arange(600) * 0.2
    level = Samples(t, np.tile([1.0, 0.0, 0.0, 0.0], (600, 1)))
    resting = builders.noisy(Recording(attitude=level), 3)
    swings = free_swings(resting, BED)
    assert swings is not None
    assert swings.count == 0
    assert not codes(found(LIFTED), resting)


def test_a_height_is_that_of_the_masses_as_they_stand():
    """A mass that goes up by 50 mm before the swings lifts what hangs 79 um by 55 um."""
    track = Samples(np.array([0.0, 1.0, 6.0, END]), 0.05 * np.eye(3)[2] * [[0], [0], [1], [1]])
    swings = free_swings(builders.noisy(builders.recording(END, track), 2), BED)
    assert swings is not None
    assert swings.span[0] == pytest.approx(6.0, abs=0.3)
    assert swings.displacement == pytest.approx([0.0, 0.0, 0.05])
    heavy = replace(BED.masses[2], mass=0.05)
    bed = replace(BED, masses=(*BED.masses[:2], heavy))
    recording = builders.noisy(builders.recording(END, track), 2)
    assert not codes(found(builders.COM), recording)
    assert codes(found(builders.COM), recording, bed) == {Why.SWINGS_WITH_COM_ABOVE}


@pytest.mark.parametrize("seed", range(thorough.count(100, 12)))
def test_a_true_body_of_the_corpus_is_plausible(seed):
    """Platforms that hang or fall over, spin or swing, with and without masses; sd of 1 %."""
    record = corpus_record(seed)
    com, up = record.truth.com, record.testbed.up
    estimate = found(com, record.truth.inertia_P, com_sd=0.01 * abs(float(com @ up)))
    assert not codes(estimate, record.recording, record.testbed)


@pytest.mark.parametrize("seed", [33, 54, 60])
def test_a_top_that_its_spin_holds_up_may_swing(seed):
    """Its centre of mass is above, and it passes the middle of its motion many times."""
    record = corpus_record(seed)
    com = record.truth.com
    swings = free_swings(record.recording, record.testbed)
    assert swings is not None
    assert swings.count > 10
    assert com[2] > 0
    estimate = found(com, record.truth.inertia_P, com_sd=0.01 * float(com[2]))
    assert not codes(estimate, record.recording, record.testbed)


@pytest.mark.parametrize(
    ("scale", "share", "expected"),
    [
        (1.0, 1e-3, set()),
        (1e4, 1e-3, {Why.INERTIA_OF_NO_BODY}),  # a unit of time that is wrong by 100
        (1e-4, 1e-3, {Why.INERTIA_OF_NO_BODY}),
        (1e4, 0.5, set()),  # by chance
        (0.005, 1e-3, {Why.INERTIA_OF_NO_BODY}),  # less than that of its own masses
    ],
)
def test_an_inertia_that_no_body_has_is_named(swing, scale, share, expected):
    """By more than three sd."""
    assert codes(found(builders.COM, scale * INERTIA, share=share), swing) == expected


def test_an_estimate_without_numbers_of_use_stays_as_it_is(swing):
    """It is judged already."""
    unusable = replace(found(LIFTED), outcome=outcome(EstimateReason.NOT_CONVERGED))
    assert with_plausibility(unusable, swing, BED) is unusable


def moved() -> tuple[Recording, Testbed]:
    """Return a record with moves of camera and gyro, and its platform."""
    track = builders.move_at(60.0, 120.0)
    clean = builders.recording(120.0, track, gyro=20.0)
    return builders.noisy(clean, 4), builders.platform(gyro=True)


def in_grams(testbed: Testbed) -> Testbed:
    """Return a testbed whose mass is a thousand times what it is, and whose first moment stays."""
    body = testbed.body
    return replace(testbed, body=replace(body, mass=1e3 * body.mass, com=body.com / 1e3))


def estimated(recording: Recording, testbed: Testbed) -> set[Why]:
    """Return what makes the estimate of a linear method implausible."""
    *_, last = identify(recording, testbed, IdentifyOptions("momentum_laboratory"))
    assert last.estimate is not None
    assert last.estimate.outcome.usable
    return {r.code for r in last.estimate.outcome.reasons if isinstance(r.code, Why)}


def test_identify_says_so():
    """The moves show an inertia that 14 tonnes cannot have, and that 14 kg have."""
    recording, bed = moved()
    assert estimated(recording, in_grams(bed)) == {Why.INERTIA_OF_NO_BODY}
    assert not estimated(recording, bed)


@thorough.whole  # half a minute
def test_assess_says_so():
    """By the trajectory fit."""
    recording, bed = moved()
    estimate, _ = fit_of(recording, in_grams(bed), AssessOptions())
    assert Why.INERTIA_OF_NO_BODY in {reason.code for reason in estimate.outcome.reasons}
