"""How well a record of a length determines centre of mass and inertia: the bound of its covariance.

The first measurement is a free swing of the platform as stated, with the usual move
(``usual_swing``). It determines the centre of mass with the masses as they stand at its end. The
errors of their stops are part of its uncertainty, and so is the scale, which counts most for a
platform that hangs low.

A later measurement is a free swing at the target, without a move. Its priors are the inertia of the
first one and the centre of mass as left by the measurements and moves before.

Both are bounds of a fit with the testbed's values as prior (``predicted_information``). Where a
record does not determine the centre of mass, its prior remains.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.estimation.output_error.fit_estimate import end_rows
from equipoise.estimation.output_error.trajectory import Params
from equipoise.maths.linalg import inverse_spd
from equipoise.model.arrays import Floats, Matrix3, Square, Vector3
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.mass_properties import from_centre
from equipoise.model.reasons.data_reasons import RecordCaution
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.testbed import Testbed
from equipoise.planning.manoeuvre.predicted_information import (
    Known,
    Predicted,
    at_truth,
    posed,
    predicted,
    prediction,
)
from equipoise.planning.manoeuvre.reference_manoeuvre import gentle_swing, usual, usual_swing


@dataclass(frozen=True, slots=True, eq=False)
class MeasurementBound:
    """How well a record of a length determines centre of mass and inertia."""

    duration: float  # s
    com: Matrix3  # m^2, covariance, masses as they stand at the end
    inertia: Square  # (6, 6) kg^2 m^4, covariance of that about P, xx yy zz xy xz yz
    inertia_observable: bool
    peak_tilt: float  # rad
    cautions: tuple[Reason, ...]

    @property
    def com_sd(self) -> Vector3:
        """Return one sd of each component, m."""
        return np.sqrt(np.diag(self.com))

    @property
    def inertia_sd(self) -> Floats:
        """Return one sd of each element, kg m^2; infinite: not all are observable."""
        return np.sqrt(np.diag(self.inertia)) if self.inertia_observable else np.full(6, np.inf)


def first_bound(testbed: Testbed, duration: float) -> MeasurementBound:
    """Return the bound for a record of this length (s) with a known move."""
    swing = usual_swing(testbed, duration)
    problem = posed(swing.observed, testbed, sought(testbed), None)
    fitted = at_truth(problem, swing.observed, testbed.body, swing.manoeuvre, None)
    end = end_rows(fitted, None)
    reported = prediction(fitted, swing.observed, testbed)
    com, stated = rows_of(reported, COM) if end is None else end[1], np.diag(testbed.com_sd**2)
    measurement = bound_of(testbed, duration, reported, com, stated)
    return replace(
        measurement, cautions=(*measurement.cautions, *shortening(testbed, swing.manoeuvre))
    )


def shortening(testbed: Testbed, manoeuvre: Manoeuvre) -> tuple[Reason, ...]:
    """Return that the usual move was shortened: longer records then need not be better."""
    length = longest(manoeuvre)
    if length >= longest(usual(testbed, manoeuvre.duration, {})):
        return ()
    return one_reason(RecordCaution.MOVE_SHORTENED, length=length)


def longest(manoeuvre: Manoeuvre) -> float:
    """Return the longest way (m) that a mass goes from home."""
    return max((abs(d) for _, goals in manoeuvre.moves for d in goals.values()), default=0.0)


def later_bound(
    testbed: Testbed, duration: float, target: Vector3, before: MeasurementBound
) -> MeasurementBound:
    """Return the bound for a record of this length (s) of a platform near the target (m).

    ``before`` is the prior: inertia from a measurement, centre of mass after a move.
    """
    body = from_centre(testbed.body.mass, target, testbed.body.inertia_C)
    names = (*COM, *INERTIA) if before.inertia_observable else COM
    known = np.zeros((9, 9))
    known[:3, :3], known[3:, 3:] = inverse_spd(before.com), inverse_spd(before.inertia)
    known = known[: len(names), : len(names)]
    manoeuvre = gentle_swing(testbed, duration)
    reported = predicted(testbed, body, manoeuvre, sought(testbed), Known(names, known))
    return bound_of(testbed, duration, reported, rows_of(reported, COM), before.com)


def sought(testbed: Testbed) -> Params:
    """Return the model of a fit: what the testbed considers, but for sag, as in ``balance``.

    At small tilts a deck that sags is a stiff one with another centre of mass.
    """
    return Params(testbed.without("sag").disturbances, use_prior=True)


def rows_of(reported: Predicted, names: tuple[str, ...]) -> Floats:
    """Return rows that choose some unknowns from all."""
    return np.eye(len(reported.names))[[reported.names.index(name) for name in names]]


def bound_of(
    testbed: Testbed, duration: float, reported: Predicted, com: Floats, before: Matrix3
) -> MeasurementBound:
    """Return a bound; ``com`` maps all unknowns to the centre of mass, of the prior ``before``."""
    unseen = bool(np.any(np.abs(com[:, reported.hidden]) > 0))
    moments = rows_of(reported, INERTIA)
    return MeasurementBound(
        duration,
        before if unseen else com @ reported.covariance @ com.T,
        moments @ reported.covariance @ moments.T,
        not np.any(moments[:, reported.hidden]),
        reported.peak_tilt,
        cautions(reported, testbed, unseen),
    )


def cautions(reported: Predicted, testbed: Testbed, unseen: bool) -> tuple[Reason, ...]:
    """Return unobservable quantities, and whether the platform would pass its tilt limit."""
    found = one_reason(RecordCaution.COM_UNOBSERVABLE) if unseen else ()
    if reported.peak_tilt > testbed.tilt_limit:
        numbers = {"tilt": reported.peak_tilt, "limit": testbed.tilt_limit}
        found += one_reason(RecordCaution.SWINGS_BEYOND_LIMIT, **numbers)
    return found
