"""Rest positions worked by hand: the centre of mass hangs under the centre of rotation."""

from dataclasses import replace

import numpy as np
from builders import MASS, platform

from equipoise.estimation.equilibrium import estimate
from equipoise.maths.attitude import exponential
from equipoise.model.recording import Recording, Samples

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
    found = estimate(two_rests(), platform())
    assert found.outcome.usable
    np.testing.assert_allclose(found.com, [0.0, 0.0, -SHIFT], rtol=0, atol=1e-9)


def test_noise_is_in_the_interval():
    """0.2 deg on each of 250 rows: within 4 sd, and the sd is that of 20 um x 0.2 deg / 16."""
    record = two_rests()
    error = np.radians(0.2) * np.random.default_rng(5).normal(size=(len(record.attitude), 3))
    turns = np.where((record.attitude.t > LEAVES)[:, None], TURNED, LEVEL)
    noisy = replace(record, attitude=Samples(record.attitude.t, exponential(turns + error)))
    found = estimate(noisy, platform())
    sd = np.array([p.sd for p in found.parameters])
    assert np.all(np.abs(found.com - [0.0, 0.0, -SHIFT]) < 4 * sd)
    single = SHIFT * np.radians(0.2) / np.sqrt(250)
    assert np.all((sd > 0.3 * single) & (sd < 6 * single))


def test_one_rest_is_refused_with_a_sentence():
    """A direction without a length: the sentence says what to do about it."""
    alone = replace(two_rests(), masses=None, mass_names=())
    level = Samples(alone.attitude.t, exponential(np.zeros((len(alone.attitude), 3))))
    found = estimate(replace(alone, attitude=level), platform())
    assert not found.outcome.usable
    assert found.parameters == ()
    assert "two are needed: move a mass sideways" in found.outcome.sentence
