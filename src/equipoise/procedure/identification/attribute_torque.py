"""Attribute: which cause gave a platform how much torque in every second of a recording."""

from equipoise.estimation.torque_by_cause.attribution import torque_by_cause
from equipoise.model.errors import InputError
from equipoise.model.estimate import BODY, COM, Estimate
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.torque_by_cause import TorqueByCause
from equipoise.procedure.steps.clean_record import sound

FEWEST = 4  # rows of a sensor
SHORTEST = 3.0  # s, chosen: two intervals and what lies around them


def attribute_torque(recording: Recording, testbed: Testbed, estimate: Estimate) -> TorqueByCause:
    """Return the torque of each cause, second by second, without the recording's odd rows.

    Raises InputError for an estimate without inertia and centre of mass, or whose inertia no body
    can have, and for a recording of less than three seconds.
    """
    if not all(map(estimate.has, BODY)):
        found = f"an estimate by {estimate.method} without {BODY[0]} or {COM[0]}"
        raise InputError("estimate", found, "one of inertia and centre of mass, of a free swing")
    if not is_possible(MassProperties(testbed.body.mass, estimate.com, estimate.inertia_P)):
        raise InputError("estimate", "an inertia that no body can have", "one by trajectory")
    recording, testbed = sound(recording, testbed)
    seconds = recording.span[1] - recording.span[0] if recording.rows >= FEWEST else 0.0
    if seconds < SHORTEST:
        raise InputError("recording", f"{seconds:.3g} s", f"at least {SHORTEST:g} s of rows")
    return torque_by_cause(recording, testbed, estimate)
