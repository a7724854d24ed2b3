"""Every method that can run on the real recording, and how well what it found predicts.

Each method is given the first half, with the vertical offset held at CAD where it can be: free
motion shows ratios. Its body is then held, and the second half, which nothing touched, is fitted by
first attitude, first rate and damping alone: what is left is how well that body turns. The body of
the CAD model stands beside them. The recording does not belong to the project; without it nothing
is measured.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from equipoise.estimation.method_contract import Options, heeded
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.output_error.growing_horizon import misfit_at
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.regression.formulations.rows import body_with
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.recording import window
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import GROUPS
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.steps.clean_record import sound
from verification.real_record import CALM_FROM, HELD, RECORD, TESTBED, WHOLE
from verification.result import Result, Row, Spread, at_most, in_turn

CAD = "the CAD model"
NEAREST = 2.0  # deg, what the reference leaves at most


def estimated(name: str) -> Estimate:
    """Return what a method makes of the first half."""
    part = window(read_recording(RECORD), WHOLE[0], CALM_FROM)
    known = heeded(METHODS[name].card, Options(hold=HELD))
    *_, last = identify(part, read_testbed(TESTBED), IdentifyOptions(name, hold=known.hold))
    assert last.estimate is not None
    return last.estimate


def left_by(testbed: Testbed, body: MassProperties) -> float:
    """Return what a body leaves of the second half, deg rms per axis."""
    recording, observed = sound(read_recording(RECORD), replace(testbed, body=body))
    part = window(recording, CALM_FROM, WHOLE[1])
    params = Params(GROUPS["viscous"], hold=(*INERTIA, *COM))
    fitted = fit(part, observed, params)
    return float(np.degrees(misfit_at(fitted.problem, fitted.at)) / np.sqrt(3))


def judged(name: str) -> tuple[str, float | None]:
    """Return what a method says, and what its body leaves of the other half."""
    testbed = read_testbed(TESTBED)
    if name == CAD:
        return "as published", left_by(testbed, testbed.body)
    estimate = estimated(name)
    first = estimate.outcome.reasons[0].sentence
    if not estimate.parameters:
        return f"refuses: {first}", None
    body = body_with(testbed, {p.name: p.value for p in estimate.parameters})
    if not is_possible(body):
        return "no body can have the inertia found, and it says so", None
    said = "warns of its intervals" if estimate.outcome.warns else "usable"
    if not estimate.outcome.usable:
        said = f"not usable: {first}"
    return said, left_by(testbed, body)


def row_of(name: str, said: str, left: float | None) -> Row:
    """Return the row of a method."""
    if name == "trajectory" and left is not None:
        return at_most(f"{name}: leaves of 30 to 60 s, deg rms per axis", left, NEAREST)
    found = said if left is None else f"{left:.3g} deg rms per axis; {said}"
    return Row(name, found, "an answer, or why there is none", bool(said))


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Give every method the first half of the recording."""
    claim = (
        "On a real recording every method either runs or says why not; a body found in 0 to 30 s "
        "is judged by what it leaves of 30 to 60 s, first attitude, rate and damping being free."
    )
    if not RECORD.exists():
        return Result("real_methods", claim, (), ("The recording is not here.",))
    names = (CAD, *METHODS)
    rows = tuple(
        row_of(name, *found) for name, found in zip(names, spread(judged, names), strict=True)
    )
    return Result("real_methods", claim, rows)
