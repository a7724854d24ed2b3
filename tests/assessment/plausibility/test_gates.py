"""What cannot be is found before anything is fitted: by MuJoCo's records, set wrong on purpose."""

from dataclasses import replace
from functools import cache
from itertools import permutations, product

import numpy as np
import pytest

from equipoise.assessment.plausibility.body import body_findings
from equipoise.assessment.plausibility.gyro_range import saturation_findings
from equipoise.assessment.plausibility.rotation import rotation_findings
from equipoise.assessment.plausibility.sampling import sampling_findings
from equipoise.assessment.record_checks.clock_offset import clock_offset
from equipoise.io.testbed.presets import preset_names, read_preset
from equipoise.maths.attitude import conjugate
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.recording import Samples
from equipoise.model.units import DEG
from tests.oracle.corpus import corpus_record

SEEDS = (6, 9, 10, 20)  # records with camera and gyro that turn about every axis


@cache
def channels(seed: int) -> tuple[Samples, Samples]:
    """Return attitude and rate of a record."""
    recording = corpus_record(seed).recording
    assert recording.attitude is not None
    assert recording.rate is not None
    return recording.attitude, recording.rate


def judged(attitude: Samples, rate: Samples):
    """Return the findings at the delay that both show."""
    return rotation_findings(attitude, rate, clock_offset(attitude, rate))


def codes(found) -> set[str]:
    """Return the codes of findings of the kind that forbids a fit."""
    return {reason.code for each in found if each.kind == "wrong" for reason in each.reasons}


def other(rate: Samples, order, signs, scale: float = 1.0) -> Samples:
    """Return a gyro whose columns stand otherwise."""
    return Samples(rate.t, rate.values[:, list(order)] * np.array(signs) * scale)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_sound_record_passes(seed) -> None:
    """MuJoCo's own rates and attitudes agree, whatever their noise, delays and clocks."""
    found = judged(*channels(seed))
    assert not codes(found)
    assert any(each.reasons[0].code == Why.SENSORS_AGREE for each in found)


TURNS = [(o, s) for o in permutations(range(3)) for s in product((1, -1), repeat=3)]


@pytest.mark.parametrize(("order", "signs"), TURNS[1:])
def test_every_other_order_and_sign_of_axes_is_named(order, signs) -> None:
    """The axes of the remedy, applied, make the record pass."""
    attitude, rate = channels(6)
    wrong = other(rate, order, signs)
    (found,) = judged(attitude, wrong)
    assert codes([found]) == {Why.GYRO_AXES, Why.READ_AXES}
    named = next(r.parameters for r in found.reasons if r.code == Why.GYRO_AXES)
    back = ["xyz".index(axis[-1]) for axis in named]
    mended = other(wrong, back, [-1 if axis.startswith("-") else 1 for axis in named])
    assert not codes(judged(attitude, mended))


@pytest.mark.parametrize("seed", SEEDS)
def test_an_attitude_of_the_other_direction_is_named(seed) -> None:
    """It turns laboratory into body components."""
    attitude, rate = channels(seed)
    found = judged(Samples(attitude.t, conjugate(attitude.values)), rate)
    assert Why.ATTITUDE_INVERSE in codes(found)
    assert Why.READ_INVERSE in codes(found)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("scale", [1 / DEG, DEG, 1e3, 131 / DEG])
def test_another_unit_is_named_with_its_factor(seed, scale) -> None:
    """Degrees for radians, radians for degrees, thousandths, raw counts."""
    attitude, rate = channels(seed)
    (found,) = judged(attitude, other(rate, (0, 1, 2), (1, 1, 1), scale))
    assert codes([found]) == {Why.OTHER_UNIT, Why.READ_UNIT}
    assert found.reasons[0].numbers["scale"] == pytest.approx(scale, rel=0.1)


def test_one_axis_of_another_scale_is_a_problem_and_no_other_axis() -> None:
    """Its ratio to the attitude's turning, not a ratio of scatters."""
    attitude, rate = channels(6)
    found = judged(attitude, other(rate, (0, 1, 2), (1, 1.3, 1)))
    scales = [each.reasons[0] for each in found if each.reasons[0].code == Why.OTHER_SCALE]
    assert [reason.parameters for reason in scales] == [("y",)]
    assert scales[0].numbers["scale"] == pytest.approx(1.3, rel=0.05)


def test_a_gyro_of_another_platform_is_unrelated() -> None:
    """Its rows, each axis played from another time, show nothing of this motion."""
    attitude, rate = channels(6)
    thirds = [np.roll(axis, k * len(rate) // 7) for k, axis in enumerate(rate.values.T, 2)]
    shifted = np.stack(thirds, axis=1)[::-1]
    found = judged(attitude, Samples(rate.t, shifted))
    assert [each.reasons[0].code for each in found] == [Why.NO_RELATION]


@pytest.mark.parametrize("factor", [1e3, 1e6, 1e-6])
def test_a_clock_in_another_unit_is_named(factor) -> None:
    """Milliseconds or microseconds taken as seconds, and seconds as microseconds."""
    attitude, _ = channels(6)
    found = sampling_findings(Samples(attitude.t * factor, attitude.values), None)
    assert codes(found) == {Why.IMPOSSIBLE_RATE, Why.READ_CLOCK}
    assert not sampling_findings(attitude, None)


def test_attitudes_too_rare_for_the_motion_are_named() -> None:
    """A spin of 90 deg/s and a camera at 0.5 Hz: half a turn from row to row."""
    t = np.arange(20) * 2.0
    half = t * 90.0 * DEG / 2
    q = np.stack([np.cos(half), 0 * t, 0 * t, np.sin(half)], axis=1)
    assert codes(sampling_findings(Samples(t, q), None)) == {Why.TOO_SLOW}
    beside = Samples(np.arange(4000) * 0.01, np.tile([0.0, 0.0, 90 * DEG], (4000, 1)))
    assert not sampling_findings(Samples(t, q), beside)  # the gyro shows how it was


def test_a_gyro_at_the_end_of_its_range_is_named() -> None:
    """A swing of 20 deg/s, cut at 15; one that is cut nowhere."""
    t = np.arange(2000) * 0.01
    swing = 20 * DEG * np.sin(t)[:, None] * [1.0, 0.5, 0.1]
    rate = Samples(t, np.clip(swing, -15 * DEG, 15 * DEG))
    found = saturation_findings(rate)
    assert codes(found) == {Why.SATURATED}
    assert [each.reasons[0].parameters for each in found] == [("x",)]
    assert found[0].reasons[0].numbers["rate"] == pytest.approx(15 * DEG)
    assert not saturation_findings(Samples(t, swing))


def test_coarse_steps_are_no_end_of_a_range() -> None:
    """A slow swing in steps of a tenth of its size stays long at its greatest value."""
    t = np.arange(2000) * 0.01
    coarse = np.round(5 * np.sin(t))[:, None] * [1.0, 1.0, 1.0] * DEG
    assert not saturation_findings(Samples(t, coarse))


@pytest.mark.parametrize("name", preset_names())
def test_every_preset_is_a_body(name) -> None:
    """None is refused."""
    assert not codes(body_findings(read_preset(name)))


@pytest.mark.parametrize(("mass", "inertia"), [(1e3, 1.0), (1.0, 1e4), (1.0, 1e7), (1.0, 1e-4)])
def test_a_unit_of_inertia_or_mass_that_is_wrong_is_named(mass, inertia) -> None:
    """Grams for kilograms, kg cm2 and g mm2 for kg m2, and the other way round."""
    bed = read_preset("nanosat")
    body = replace(bed.body, mass=bed.body.mass * mass, inertia_P=bed.body.inertia_P * inertia)
    assert codes(body_findings(replace(bed, body=body))) == {Why.NO_BODY}
