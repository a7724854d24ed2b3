"""What an estimate says that its camera measured: its lean from the vertical is part of that."""

from dataclasses import replace

import numpy as np

from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.predict import predict
from equipoise.estimation.output_error.trajectory import Params
from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.model.estimate import Estimate
from tests.support.builders import CAMERA_SD, guessed_wrong, move_at, noisy, platform, recording

LEAN = np.array([0.02, -0.03, 0.0])  # rad, laboratory axes


def with_lean(found: Estimate, lean) -> Estimate:
    """The estimate with another lean of its camera."""
    values = dict(zip(("plumb_x", "plumb_y"), lean[:2], strict=True))
    return replace(found, parameters=tuple(
        replace(p, value=values.get(p.name, p.value)) for p in found.parameters
    ))  # fmt: skip


def test_a_lean_turns_every_attitude_about_the_laboratory():
    record, bed = noisy(recording(120.0, move_at(60.0, 120.0)), 5), platform()
    found = estimate(record, guessed_wrong(bed), Params())
    assert found.has("plumb_x")
    upright, leaning = (predict(record, bed, with_lean(found, x)) for x in (0 * LEAN, LEAN))
    np.testing.assert_array_equal(leaning.rate, upright.rate)
    turned = multiply(exponential(LEAN), upright.q)
    np.testing.assert_allclose(difference(leaning.q, turned), 0.0, atol=1e-12)


def test_what_a_leaning_camera_says_is_predicted_to_its_noise():
    """Its vertical is 0.036 rad off, ten times its noise; prior and truth alike."""
    record, bed = noisy(recording(120.0, move_at(60.0, 120.0)), 5), platform()
    rows = record.attitude
    shown = multiply(exponential(LEAN), rows.values)
    leaning = replace(record, attitude=replace(rows, values=shown))
    known = replace(bed, attitude=replace(bed.attitude, plumb_sd=0.05))
    found = estimate(leaning, guessed_wrong(known), Params())
    off = difference(shown, predict(leaning, known, found).q)
    rms = np.sqrt(np.mean(off**2, axis=0))
    np.testing.assert_allclose(rms, CAMERA_SD, rtol=0.15)
