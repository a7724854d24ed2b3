"""Rest positions worked by hand: the centre of mass hangs under the centre of rotation."""

import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from equipoise.estimation.method_contract import Options
from equipoise.estimation.regression.rest_positions import (
    Rest,
    along,
    estimate,
    quiet_spans,
    solve,
    too_rough,
)
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential
from equipoise.model.recording import Recording, Samples
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.carried_out import recorded
from tests.support.builders import MASS, platform
from tests.support.outcomes import codes_of

LEVEL, TURNED = np.zeros(3), np.array([0.0, np.pi / 4, 0.0])
SHIFT = 20e-6  # m, of the centre of mass
WAY = SHIFT * MASS / 0.0156  # m, what that takes of the mass along x
LEAVES, ARRIVES = 50.0, 50.0 + WAY / 0.01  # s, at 10 mm/s


def two_rests() -> Recording:
    """Level; then, with the mass along x sent out, turned by 45 deg about y."""
    t = np.arange(0.0, 100.0, 0.2)
    turns = np.where((t > LEAVES)[:, None], TURNED, LEVEL)
    way = np.outer([0.0, 0.0, 1.0, 1.0], [WAY, 0.0, 0.0])
    masses = Samples(np.array([0.0, LEAVES, ARRIVES, 100.0]), way)
    return Recording(
        attitude=Samples(t, exponential(turns)), mass_names=("x", "y", "z"), masses=masses
    )


def test_two_rests_by_hand():
    """20 um sideways tilt it by 45 deg, so it hangs 20 um low (to 1e-9 m: nothing is noisy)."""
    found = estimate(two_rests(), platform(), Options())
    assert found.outcome.usable
    np.testing.assert_allclose(found.com, [0.0, 0.0, -SHIFT], rtol=0, atol=1e-9)


def test_noise_is_in_the_interval():
    """0.2 deg on each of 250 rows: within 4 sd, and the sd is that of 20 um x 0.2 deg / 16."""
    record = two_rests()
    error = np.radians(0.2) * np.random.default_rng(5).normal(size=(len(record.attitude), 3))
    turns = np.where((record.attitude.t > LEAVES)[:, None], TURNED, LEVEL)
    noisy = replace(record, attitude=Samples(record.attitude.t, exponential(turns + error)))
    found = estimate(noisy, platform(), Options())
    sd = np.array([p.sd for p in found.parameters])
    assert np.all(np.abs(found.com - [0.0, 0.0, -SHIFT]) < 4 * sd)
    single = SHIFT * np.radians(0.2) / np.sqrt(250)
    assert np.all((sd > 0.3 * single) & (sd < 6 * single))


def test_one_rest_is_refused_with_a_sentence():
    """A direction without a length: the sentence says what to do about it."""
    alone = replace(two_rests(), masses=None, mass_names=())
    level = Samples(alone.attitude.t, exponential(np.zeros((len(alone.attitude), 3))))
    found = estimate(replace(alone, attitude=level), platform(), Options())
    assert not found.outcome.usable
    assert found.parameters == ()
    assert codes_of(found) == ["too_few_rests"]


def test_masses_that_travel_together_end_one_stop():
    """Two masses leave at 50 s and arrive 1 s apart: two stops, not a third between arrivals."""
    t = np.array([0.0, 50.0, 51.0, 52.0, 100.0])
    way = np.array([[0, 0, 0], [0, 0, 0], [0.01, 0.01, 0], [0.01, 0.02, 0], [0.01, 0.02, 0]])
    record = replace(two_rests(), masses=Samples(t, way))
    assert quiet_spans(record, platform()) == [(0.0, 50.0), (52.0, pytest.approx(99.8))]


def rests_of(com, shifts, sd: float, seed: int) -> list[Rest]:
    """Rests whose directions err by ``sd`` (rad)."""
    rng, rests = np.random.default_rng(seed), []
    for shift in shifts:
        u = (com + shift) / np.linalg.norm(com + shift) + sd * rng.standard_normal(3)
        rests.append(Rest(u / np.linalg.norm(u), sd, shift, 0.0))
    return rests


def test_three_rests_with_noise():
    """A com (3, -2, -60) um, one rest with 2 um of lever arm, 0.06 deg of noise."""
    com = np.array([3e-6, -2e-6, -60e-6])
    shifts = np.array([[0, 0, 0], [-3e-6, 0, 60e-6], [30e-6, 20e-6, 0]])
    found, information, misfit = solve(rests_of(com, shifts, 1e-3, 1))
    off = found - com
    assert off @ information @ off < 16.3  # 99.9 % of chi-square, 3 degrees of freedom
    assert misfit < 16.3
    assert np.sqrt(np.linalg.inv(information)[2, 2]) < 2e-6


def test_errors_are_as_large_as_stated_near_the_centre_too():
    """One rest has 0.2 um of lever arm: mean NEES of 3 unknowns over 200 seeds, and its chi-square.

    Linear rows, weighted by lever arms of 1 um at least, stated sd that were 1.7 times too large.
    """
    com = np.array([0.0, 0.0, -20e-6])
    shifts = np.array([[0, 0, 0], [0.2e-6, 0, 19.9e-6], [10e-6, 0, 0]])
    nees = []
    for seed in range(200):
        found, information, _ = solve(rests_of(com, shifts, 1e-3, seed))
        nees.append((found - com) @ information @ (found - com))
    low, high = chi2.ppf([1e-4, 1 - 1e-4], 3 * 200) / 200
    assert low < np.mean(nees) < high


def test_information_is_that_of_the_directions_by_complex_step():
    """du/dr = (E - u u^T) / |r + dr|, to rounding."""
    lever = np.array([3e-6, -2e-6, -60e-6])
    u, slope = along(lever)
    steps = [lever + 1j * 1e-20 * e for e in np.eye(3)]
    exact = np.array([np.imag(v / np.sqrt(v @ v)) / 1e-20 for v in steps]).T
    np.testing.assert_allclose(slope, exact, rtol=1e-12, atol=1e-6)
    np.testing.assert_allclose(u, lever / np.linalg.norm(lever), rtol=1e-15)


def test_a_swing_is_no_rest():
    """3 deg of swing about one axis, 1.5 deg rms of two: numbers, but a sentence against them."""
    record = two_rests()
    swing = np.radians(3.0) * np.sin(2 * np.pi * record.attitude.t / 7.0)
    turns = np.where((record.attitude.t > LEAVES)[:, None], TURNED, LEVEL)
    swung = exponential(turns + np.outer(swing, [1.0, 0, 0]))
    found = estimate(
        replace(record, attitude=Samples(record.attitude.t, swung)), platform(), Options()
    )
    assert "swung by 1.5 deg rms" in found.outcome.sentence
    assert codes_of(found) == ["from_rests", "swings_at_rest"]
    assert found.outcome.trust == "not_trustworthy"


@pytest.mark.parametrize(("sd", "reported"), [(0.99, True), (1.01, False)])
def test_an_sd_longer_than_the_arm_is_rejected_as_too_rough(sd, reported):
    """Arms of 20 um along z and x, directions to s: 1 / s^2 + 1 / s^2 across both, 1 / s^2 else.

    The least information is (1 / (20 um s))^2: the sd is as long as the arm at s = 1 rad.
    """
    com, arm = np.array([0.0, 0.0, -SHIFT]), SHIFT
    sideways = np.array([arm, 0.0, arm])  # the second arm lies along x
    rests = [
        Rest(np.array([0.0, 0.0, -1.0]), sd, np.zeros(3), 1.0),
        Rest(np.array([1.0, 0.0, 0.0]), sd, sideways, 1.0),
    ]
    information = sum(along(com + s.shift)[1].T @ along(com + s.shift)[1] / sd**2 for s in rests)
    assert (too_rough(rests, com, information) is None) is reported


def test_rests_of_a_platform_that_swings_widely_are_refused_with_a_sentence():
    """Platform 4 of `sputnix` swings by 26 deg rms: the minimum runs away, which ended in an error.

    Its information was singular ("Singular matrix").
    """
    bed = replace(read_preset("sputnix"), tilt_limit=np.pi)  # within its stop it swings less
    record = recorded(SimulatedBench(bed, 4), 120.0, [(60.0, {"z1": -0.05, "x1": 0.05})])
    found = estimate(record, bed, Options())
    assert not found.outcome.usable
    assert found.parameters == ()
    assert re.search(r"swung by \d+ deg rms", found.outcome.sentence)
    assert codes_of(found) == ["rests_too_rough"]
