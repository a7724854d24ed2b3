"""What the tracker knows of the centre of mass during a hold, now and a little later."""

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.predict_correct import COM, RATE_OF_COM
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.move import Move
from equipoise.model.testbed import Testbed
from equipoise.procedure.balancing.hold_verdict import Measured
from equipoise.procedure.steps.planned_move import stops_covariance

COM_WALK = 5e-8  # m/sqrt(s), chosen: beside the drift, as of a tracker that knows of none


def standing(state: tracker.State, testbed: Testbed, displacement: Floats) -> Measured:
    """Return the posterior of the centre of mass with the masses as they stand."""
    com = state.com + shift_by(testbed, displacement)
    return Measured(com, state.covariance[COM, COM])


def before_moving(
    now: Measured, testbed: Testbed, displacement: Floats, goal: Floats
) -> tuple[Vector3, Matrix3]:
    """Return the centre of mass (m, m^2) less the stops' errors of masses about to move to a goal.

    The tracker does not estimate single stops, so only their accuracy is known.
    """
    leaving = (goal != displacement) & (displacement != 0)  # at home a mass has no error
    return now.com, now.covariance + stops_covariance(testbed, leaving)


def shifted(measured: Measured, testbed: Testbed, way: Floats) -> Measured:
    """Return the posterior after masses have gone a way (m), less the errors of their stops."""
    return Measured(measured.com + shift_by(testbed, way), measured.covariance)


def ahead(now: Measured, state: tracker.State, lapse: float) -> Measured:
    """Return the posterior a while (s) later, if no mass moves: it drifts at v, and walks.

    r + v t,    P_rr + t (P_rv + P_vr) + t^2 P_vv + q_r^2 t E
    """
    both = state.covariance[COM, RATE_OF_COM]
    grown = lapse * (both + both.T) + lapse**2 * state.covariance[RATE_OF_COM, RATE_OF_COM]
    walked = COM_WALK**2 * lapse * np.eye(3)
    return Measured(now.com + lapse * state.drift, now.covariance + grown + walked)


def moved_on(move: Move, now: Measured, later: Measured) -> Measured:
    """Return the posterior of a while later behind a move that is made now."""
    grown = later.covariance - now.covariance
    return Measured(move.predicted_com + later.com - now.com, move.predicted_covariance + grown)
