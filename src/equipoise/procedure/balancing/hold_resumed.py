"""A hold that goes on after an interruption, from what was known when it was interrupted.

Meanwhile, for a time T, the centre of mass went on drifting as the tracker has it, and nobody
measured:

    r <- r + v T,    P_rr <- P_rr + T (P_rv + P_vr) + T^2 P_vv + (q_r^2 T + q_v^2 T^3 / 3) E,
    P_rv <- P_rv + T P_vv + q_v^2 T^2 / 2 E,    P_vv <- P_vv + q_v^2 T E

and it may be warmer or cooler by some kelvins. It sags as it did. Attitude and rate are taken from
fresh rows. Masses must stand where they stood.

Cannot see what else was done to the platform meanwhile: a hand that touched it, a part added.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.known_inputs import inputs_of
from equipoise.estimation.tracker.known_sag import with_sag
from equipoise.estimation.tracker.predict_correct import COM, DRIFTING, RATE_OF_COM, WARM
from equipoise.estimation.tracker.stored_covariance import SAG_ROW
from equipoise.estimation.tracker.warmth import Warmth
from equipoise.model.arrays import Floats, Ints, Matrix3, Square, Vector3
from equipoise.model.bench import Bench
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed
from equipoise.procedure.balancing.hold import DRIFT_WALK, Held, params_for
from equipoise.procedure.balancing.hold_posterior import COM_WALK
from equipoise.procedure.steps.sampler import last_row, no_attitude

FIRST = 1.0  # s, chosen: for an attitude, of every camera
WARMER = 2.0  # K, chosen: one sd of what a laboratory changes meanwhile
ROWS = (*DRIFTING, *range(WARM.start, WARM.stop))  # com, J, drift, warmth


@dataclass(frozen=True, slots=True, eq=False)
class Kept:
    """What a hold knows that outlasts it, masses at home."""

    com: Vector3  # m
    inertia_P: Matrix3  # kg m^2
    drift: Vector3  # m/s
    thermal: Vector3  # m/K
    covariance: Square  # (15, 15) of com, J (xx yy zz xy xz yz), drift, thermal; (20, 20) with sag
    torque: Floats | None  # (19,) coefficients
    displacement: Floats  # m, where masses stood
    sag: Floats | None = None  # (5,) m, coefficients of C


def kept_of(held: Held) -> Kept:
    """Return what outlasts a hold."""
    state = held.state
    return Kept(state.com, state.inertia_P, state.drift, state.thermal,
                state.covariance[every_of(state)], held.params.torque, held.displacement,
                state.sag)  # fmt: skip


def every_of(state: tracker.State) -> tuple[Ints, ...]:
    """Return where in a covariance that is which outlasts a hold."""
    rows = np.array([*ROWS, *range(SAG_ROW, len(state.covariance))])
    return np.ix_(rows, rows)


def resumed(bench: Bench, kept: Kept, gap: float) -> Held:
    """Return where a hold goes on, ``gap`` seconds after it was interrupted.

    Raises InputError without an attitude.
    """
    fresh = bench.read(FIRST)
    if fresh.attitude is None or not len(fresh.attitude):
        raise no_attitude(FIRST)
    body = tracker.Posterior(kept.com, kept.inertia_P, kept.covariance[:9, :9],
                             Warmth(kept.thermal, np.zeros((3, 12))))  # fmt: skip
    t = float(fresh.attitude.t[-1])
    state = tracker.first_state(t, fresh.attitude.values[-1], bench.testbed, body)
    if kept.sag is not None:
        state = with_sag(state, kept.sag, np.zeros((len(kept.sag), len(kept.sag))))
    covariance = state.covariance.copy()
    covariance[every_of(state)] = kept.covariance
    state = replace(state, drift=kept.drift, covariance=covariance, inputs=inputs_of(None, fresh))
    displacement = last_row(fresh.masses, kept.displacement)
    check_standing(displacement, kept, bench.testbed)
    return Held(unattended(state, gap), params_for(kept.torque), displacement, displacement)


def check_standing(displacement: Floats, kept: Kept, testbed: Testbed) -> None:
    """Raise InputError for masses that do not stand where they stood."""
    for mass, now, then in zip(testbed.masses, displacement, kept.displacement, strict=True):
        if abs(now - then) > max(mass.resolution, mass.accuracy):
            found = f"at {now:.6f} m; it stood at {then:.6f} m when the hold was interrupted"
            raise InputError(f"mass {mass.name}", found, "the mass where it stood")


def unattended(state: tracker.State, gap: float) -> tracker.State:
    """Return a state after ``gap`` seconds without a measurement, its time unchanged."""
    P, E = state.covariance.copy(), np.eye(3)
    v = P[:, RATE_OF_COM].copy()
    P[COM, :] += gap * v.T
    P[:, COM] += gap * P[:, RATE_OF_COM]
    P[COM, COM] += (COM_WALK**2 * gap + DRIFT_WALK**2 * gap**3 / 3) * E
    P[COM, RATE_OF_COM] += 0.5 * DRIFT_WALK**2 * gap**2 * E
    P[RATE_OF_COM, COM] += 0.5 * DRIFT_WALK**2 * gap**2 * E
    P[RATE_OF_COM, RATE_OF_COM] += DRIFT_WALK**2 * gap * E
    P[COM, COM] += WARMER**2 * np.outer(state.thermal, state.thermal)
    return replace(state, com=state.com + gap * state.drift, covariance=P)
