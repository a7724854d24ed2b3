"""A recorded motion with the estimated centre of mass and inertia, to be replayed."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.figures.estimate.inertia_ellipsoid import semi_axes
from equipoise.app.text.charts import Ellipsoid, MovingMass, Replay, Triple
from equipoise.model.arrays import Floats
from equipoise.model.estimate import BODY, COM, Estimate
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.record_courses import displacement_at

MOST = 1200  # attitudes, chosen: ten a second of two minutes
MOTION = "Recorded motion. Drag to turn the view; Ctrl and the wheel zoom."
COM_SHOWN = (
    " The distance of the centre of mass from the centre of rotation P is exaggerated by the "
    "factor shown, and so is its ellipsoid of one standard deviation; masses at home."
)
INERTIA_SHOWN = (
    " The large ellipsoid, true to scale, has uniform density and the estimated inertia."
)


def of_motion(
    recording: Recording | None, testbed: Testbed, estimate: Estimate | None, record: str
) -> Iterator[Replay]:
    """Yield the replay of a record with attitude, with what an estimate shows of the body."""
    if recording is None or recording.attitude is None or not len(recording.attitude):
        return
    rows = recording.attitude.where(slice(None, None, -(-len(recording.attitude) // MOST)))
    at = np.round(displacement_at(rows.t, recording, testbed), 6)
    known = estimate if estimate is not None and estimate.sees(COM) else None
    shape = None if estimate is None else ellipsoid_of(estimate, testbed)
    yield Replay(
        f"replay_{record}",
        MOTION + ("" if known is None else COM_SHOWN) + ("" if shape is None else INERTIA_SHOWN),
        record,
        testbed.layout,
        triple(testbed.up),
        tuple(np.round(rows.t, 4).tolist()),
        tuple(map(_four, rows.values)),
        tuple(MovingMass(m.name, triple(m.home), triple(m.axis), m.travel) for m in testbed.masses),
        tuple(map(tuple, at.tolist())),
        None if known is None else triple(known.com),
        () if known is None else tuple(known.covariance_of(COM).ravel().tolist()),
        shape,
    )


def ellipsoid_of(estimate: Estimate, testbed: Testbed) -> Ellipsoid | None:
    """Return the ellipsoid of an estimated body; None where it is not known, or not possible."""
    if not estimate.sees(BODY):
        return None
    body = MassProperties(testbed.body.mass, estimate.com, estimate.inertia_P)
    if not is_possible(body):
        return None
    lengths, directions = semi_axes(body)
    one, two, three = map(triple, directions.T)
    return Ellipsoid(triple(lengths), (one, two, three))


def triple(vector: Floats) -> Triple:
    """Return a vector as three plain numbers."""
    x, y, z = vector.tolist()
    return x, y, z


def _four(q: Floats) -> tuple[float, float, float, float]:
    w, x, y, z = np.round(q, 6).tolist()
    return w, x, y, z
