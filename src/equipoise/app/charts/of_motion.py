"""A recorded motion with the estimated centre of mass and inertia, to be replayed."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.figures.estimate.inertia_ellipsoid import semi_axes
from equipoise.app.text.charts import MovingMass, Replay, Triple
from equipoise.model.arrays import Floats
from equipoise.model.estimate import BODY, COM, Estimate
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.record_courses import displacement_at

MOST = 1200  # attitudes, chosen: ten a second of two minutes
CAPTION = (
    "Recorded motion. The distance of the centre of mass from the centre of rotation P is "
    "exaggerated by the factor shown; the small ellipsoid is one standard deviation. The large "
    "ellipsoid, true to scale, has uniform density and the estimated inertia. Both are with the "
    "masses at home."
)


def of_motion(
    recording: Recording | None, testbed: Testbed, estimate: Estimate | None, record: str
) -> Iterator[Replay]:
    """Yield the replay of a record with attitude, if the estimate is that of a possible body."""
    if recording is None or recording.attitude is None or not len(recording.attitude):
        return
    if estimate is None or not estimate.sees(BODY):
        return
    body = MassProperties(testbed.body.mass, estimate.com, estimate.inertia_P)
    if not is_possible(body):
        return
    every = slice(None, None, -(-len(recording.attitude) // MOST))
    rows = recording.attitude.where(every)
    lengths, directions = semi_axes(body)
    yield Replay(
        f"replay_{record}",
        CAPTION,
        record,
        testbed.layout,
        triple(testbed.up),
        tuple(np.round(rows.t, 4).tolist()),
        tuple(map(_four, rows.values)),
        tuple(
            MovingMass(m.name, triple(m.home), triple(m.axis), m.travel) for m in testbed.masses
        ),
        tuple(
            tuple(row) for row in np.round(displacement_at(rows.t, recording, testbed), 6).tolist()
        ),
        triple(estimate.com),
        tuple(estimate.covariance_of(COM).ravel().tolist()),
        triple(lengths),
        (triple(directions[:, 0]), triple(directions[:, 1]), triple(directions[:, 2])),
    )


def triple(vector: Floats) -> Triple:
    """Return a vector as three plain numbers."""
    x, y, z = vector.tolist()
    return x, y, z


def _four(q: Floats) -> tuple[float, float, float, float]:
    w, x, y, z = np.round(q, 6).tolist()
    return w, x, y, z
