"""Tracker: multiplicative extended Kalman filter of attitude, rate, mass properties and gyro bias.

    error state  x = [ dth, dw, dr, dJ, db, dv, dk ]  (body axes; r, J with the masses at home)
                 and dc where the platform sags: the five coefficients of C, r + C n  (``sag``)
    prediction   the propagator; Phi from its sensitivities to first attitude, rate, moment, J;
                 r' = v: the centre of mass drifts, where the state's covariance says that it may;
                 r <- r + k dT
    z_q = log( q_pred^-1 (x) q_meas ),  H = [E 0 0 0 0 0],  R = sd_q^2 E
    z_w = w_meas - w_pred - b,          H = [0 E 0 0 E 0],  R = sd_w^2 E
    q+  = q_pred (x) exp( dth+ )

Ivanov 2021 section 5 with errata I7-I11: the error is the whole rotation vector, so no block
carries a factor 2 or 1/2; the gyroscopic block is J^-1 ([Jw x] - [w x] J); R is the variance of
the angle.
A commanded move enters the prediction with the covariance of where masses stop (fed), or is left
out so that the estimate has to find the new centre of mass by itself (ignored; paper Fig. 13).

The inertia is part of the state with its own sd, since an error of 2 % in it would be ten stated
sd in r_z: as the swing shows J and r only by their ratio, r is never known better than J until a
known move separates them. An sd of 0 takes the inertia as known.

r is the centre of mass as warm as it is; k is what a kelvin moves it by. T is the recorded
temperature or follows the recorded switch of a lamp that the testbed states (``lamp_warmth``), so
that a lamp that goes on is no surprise. k begins as the estimate before has it, or as large as on
benches. The time constant is taken as stated: what it is wrong by is left to the walk of r.

Cannot see r along gravity until the platform has tilted, nor the scale of (J, r) before a move.

What it does about what it does not know:

    inertia     rows are passed again where the estimate has moved (``relinearisation``), and the
                direction that free motion cannot show stays as it is (``linearisation_point``)
    contacts    found in the innovations, corrected and reported (``contact_test``)
    noise       its level is learnt from the innovations (``noise_level``); a row beyond all
                bounds is not used (``Track.not_used``)
    gaps        the filter starts anew from a row whose attitude it could not predict
                (``measurement_update``)
"""

from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics import sensitivities
from equipoise.dynamics.lamp_warmth import temperature_until
from equipoise.dynamics.propagation import rigid_body, stacked
from equipoise.dynamics.regressor import DRIFT
from equipoise.estimation.tracker.kernel_records import EVENTS, Model, Place, Written
from equipoise.estimation.tracker.known_inputs import inputs_kept, inputs_of, with_inputs
from equipoise.estimation.tracker.measurement_update import GATE
from equipoise.estimation.tracker.measurements import rows_of
from equipoise.estimation.tracker.predict_correct import BODY, COM, WARM
from equipoise.estimation.tracker.relinearisation import Memory, follow
from equipoise.estimation.tracker.stored_covariance import SIZE
from equipoise.estimation.tracker.warmth import Warmth, unknown_warmth, warmth_of
from equipoise.maths.chi_square import chi_square_limit
from equipoise.maths.linalg import element_sizes, pack_symmetric, unpack_symmetric
from equipoise.model.arrays import (
    Floats,
    Matrix3,
    Quaternion,
    Series,
    Series1,
    Series3,
    Series4,
    Square,
    Vector3,
)
from equipoise.model.defects import nothing
from equipoise.model.estimate import INERTIA, Estimate
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

Moves = Literal["fed", "ignored"]
Kind = Literal["impulse", "step", "either", "lost"]
KINDS: tuple[Kind, ...] = ("impulse", "step", "either", "lost")
UNTOLD = 2e-6  # m/sqrt(s), chosen: walk of a centre of mass that may jump unannounced
WHERE = np.cumsum([4, 3, 3, 6, 3, 3, 3])  # where the parts of an estimate written as one array end;
# of a platform that sags its coefficients follow
QUIET = 7200.0  # s, chosen: how often chance alone is called a contact; it costs what was known


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """Options of the tracker."""

    moves: Moves = "fed"
    com_walk: float = 5e-8  # m/sqrt(s): 0.05 um, thermal drift; chosen within 0.01 to 0.1
    torque_walk: float = 1e-6  # N m sqrt(s): air and bearing torques on a platform of some kg
    bias_walk: float = 1e-7  # rad/s/sqrt(s)
    drift_walk: float = 0.0  # m/s/sqrt(s), of the rate at which the centre of mass drifts
    torque: Floats | None = None  # (19,) known coefficients; drift and warmth are not taken


@dataclass(frozen=True, slots=True, eq=False)
class Posterior:
    """Mass properties with the masses at home, and how well they are known."""

    com: Vector3  # m
    inertia_P: Matrix3  # kg m^2
    covariance: Square  # (9, 9) of com and of J as xx yy zz xy xz yz
    warmth: Warmth = field(default_factory=unknown_warmth)


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The estimate of the tracker, at one time."""

    t: float  # s
    q: Quaternion
    rate: Vector3  # rad/s
    com: Vector3  # m, masses at home
    inertia_P: Matrix3  # kg m^2, masses at home
    bias: Vector3  # rad/s
    covariance: Square  # (24, 24) of dth, dw, dr, dJ, db, dv, dk; (29, 29) with dc
    memory: Memory | None = None  # of the rows before; None: this is where tracking begins
    drift: Vector3 = field(default_factory=nothing)  # m/s, of com
    thermal: Vector3 = field(default_factory=nothing)  # m/K
    inputs: Recording | None = None  # masses, momentum, lamp and the like, as later rows need them
    sag: Floats | None = None  # (5,) m, coefficients of C; None: all that is known of it is certain

    @property
    def noise_levels(self) -> Floats:
        """Return how many times as loud as stated camera and gyro are, of one sd."""
        return np.ones(2) if self.memory is None else np.sqrt(self.memory.levels[:, 0])

    @property
    def posterior(self) -> Posterior:
        """Return the estimate of the body."""
        P = self.covariance
        warmth = Warmth(self.thermal, np.hstack([P[WARM, BODY], P[WARM, WARM]]))
        return Posterior(self.com, self.inertia_P, P[BODY, BODY], warmth)


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """Something that free motion does not explain; what is not of its kind is 0."""

    t: float  # s, the row before it
    kind: Kind  # "lost": the attitude was not known any more and was taken anew
    weight: float  # l: twice the log of the likelihood ratio
    impulse: Vector3  # N m s, body axes
    impulse_sd: Vector3
    shift: Vector3  # m, of the centre of mass, body axes
    shift_sd: Vector3


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """The estimate after each row, and the innovation of the row."""

    t: Series1  # s
    q: Series4
    rate: Series3  # rad/s
    com: Series3  # m, masses at home; with moves ignored: as they stand
    inertia: Series  # (n, 6) kg m^2, xx yy zz xy xz yz
    bias: Series3
    drift: Series3  # m/s, of com
    thermal: Series3  # m/K
    sag: Series  # (n, 5) m; (n, 0) where it is not estimated
    sd: Series  # (n, 24) of dth, dw, dr, dJ, db, dv, dk; (n, 29) with dc
    surprise: Series1  # squared innovation over its covariance, 3 degrees of freedom
    contacts: tuple[Contact, ...]
    end: State

    @property
    def not_used(self) -> Series1:
        """Return the times (s) of rows that are too odd to be used."""
        return self.t[self.surprise > GATE]

    @property
    def com_sd(self) -> Series3:
        """Return the sd of the centre of mass, m."""
        return self.sd[:, COM]

    @property
    def rate_sd(self) -> Series3:
        """Return the sd of the rate, rad/s."""
        return self.sd[:, 3:6]


def posterior_of(testbed: Testbed, estimate: Estimate | None = None) -> Posterior:
    """Return the prior of the testbed, with the inertia of an estimate that observed it."""
    inertia_sd = testbed.inertia_sd * element_sizes(testbed.body.inertia_P)
    variance = np.concatenate([testbed.com_sd, inertia_sd]) ** 2
    covariance, inertia_P = np.diag(variance), testbed.body.inertia_P
    if estimate is not None and estimate.sees(INERTIA):
        covariance[3:, 3:], inertia_P = estimate.covariance_of(INERTIA), estimate.inertia_P
    return Posterior(testbed.body.com, inertia_P, covariance, warmth_of(estimate, ()))


def first_state(
    t: float, q: Quaternion, testbed: Testbed, posterior: Posterior | None = None
) -> State:
    """Return a state from one attitude: at rest within 0.1 rad/s, the body by its prior."""
    posterior = posterior or posterior_of(testbed)
    covariance = np.zeros((SIZE, SIZE))
    noise = testbed.attitude.noise if testbed.attitude else 0.1
    bias = testbed.gyro.bias_sd if testbed.gyro else 0.0
    spread = [noise**2] * 3 + [0.1**2] * 3 + [0.0] * 9 + [bias**2] * 3 + [0.0] * 6
    covariance[np.diag_indices(SIZE)] = spread
    covariance[BODY, BODY], warmth = posterior.covariance, posterior.warmth
    covariance[WARM, BODY], covariance[WARM, WARM] = np.split(warmth.covariance, [9], axis=1)
    covariance[BODY, WARM] = covariance[WARM, BODY].T
    return State(t, q, np.zeros(3), posterior.com, posterior.inertia_P, np.zeros(3), covariance,
                 thermal=warmth.thermal)  # fmt: skip


def contact_alarm(testbed: Testbed, recording: Recording) -> float:
    """Return the l that calls a contact: chance does so once in two hours.

    After each row two kinds are tested, with 3 degrees of freedom, at a dozen onsets that are so
    alike that rows and kinds alone are counted; neighbouring rows are alike too.
    """
    sensors = ((recording.attitude, testbed.attitude), (recording.rate, testbed.gyro))
    rows = sum(
        sensor.rate for observed, sensor in sensors if observed is not None and sensor is not None
    )
    return chi_square_limit(3, 1 / (max(rows, 1.0) * QUIET * 2))


def model_of(recording: Recording, testbed: Testbed, params: Params, state: State) -> Model:
    """Return what does not change along the rows."""
    body = MassProperties(testbed.body.mass, state.com, state.inertia_P)
    walk = params.com_walk if params.moves == "fed" else max(params.com_walk, UNTOLD)
    bias_walk = params.bias_walk if recording.rate is not None and len(recording.rate) else 0.0
    sd = [s.noise if s else 1.0 for s in (testbed.attitude, testbed.gyro)]
    return Model(
        rigid_body(body, testbed.gravity, steady(params.torque)),
        stacked(mass_maps(testbed.masses)), filter_columns(), np.array(sd),
        np.repeat([0.0, params.torque_walk, walk, 0.0, 0.0, bias_walk, params.drift_walk, 0.0], 3),
        contact_alarm(testbed, recording),
    )  # fmt: skip


def steady(torque: Floats | None) -> Floats | None:
    """Return torque coefficients without drift and warmth, which the tracker follows by itself."""
    return None if torque is None else np.where(np.arange(len(torque)) < DRIFT, torque, 0.0)


def track(recording: Recording, testbed: Testbed, params: Params, state: State) -> Track:
    """Return the estimate after every row later than the state; to go on, call from its end."""
    sag = np.zeros(0) if state.sag is None else state.sag
    posterior = np.concatenate([state.q, state.rate, state.com, pack_symmetric(state.inertia_P),
                             state.bias, state.drift, state.thermal, sag])  # fmt: skip
    speed, fed = float(np.linalg.norm(state.rate)), params.moves == "fed"
    inputs = inputs_of(state.inputs, recording)
    until = state.t if not recording.rows else recording.span[1]
    warmed = temperature_until(inputs, testbed, until)
    whole = replace(with_inputs(recording, inputs), temperature=warmed)
    fresh = rows_of(whole, testbed, fed, state.t, speed)
    model = model_of(recording, testbed, params, state)
    memory, here, written = follow(model, state.memory, Place(posterior, state.covariance), fresh)
    q, w, com, J, b, v, k, sag = np.split(here.posterior, WHERE)
    now = float(fresh.t[-1])
    end = State(now, q, w, com, unpack_symmetric(J), b, here.covariance, memory, v, k,
                inputs_kept(inputs, now), None if state.sag is None else sag)  # fmt: skip
    return track_of(written, end)


def track_of(written: Written, end: State) -> Track:
    """Return what the walk has written."""
    out, kept = written.out, 1 + len(end.covariance)
    at = np.split(out, [1, *(1 + WHERE), 1 + kept, out.shape[1] - 1], axis=1)
    t, q, w, com, J, b, v, k, sag, sd, surprise = at
    found = tuple(contact_of(event, end) for event in written.events[: written.done[EVENTS]])
    return Track(t[:, 0], q, w, com, J, b, v, k, sag, sd, surprise[:, 0], found, end)


def contact_of(event: Floats, end: State) -> Contact:
    """Return an event as written."""
    jump, jump_sd, step, step_sd = np.split(event[3:], 4)
    J = end.inertia_P
    impulse_sd = np.sqrt(np.diag(J @ np.diag(jump_sd**2) @ J))
    kind = KINDS[int(event[1])]
    return Contact(float(event[0]), kind, float(event[2]), J @ jump, impulse_sd, step, step_sd)


def filter_columns() -> sensitivities.Columns:
    """Return the sensitivities that make the transition matrix."""
    kinds = [sensitivities.TURN, sensitivities.RATE, sensitivities.MOMENT]
    return sensitivities.Columns(
        np.array([*np.repeat(kinds, 3), *[sensitivities.INERTIA] * 6], dtype=np.int64),
        np.array([*np.tile([0, 1, 2], 3), *range(6)], dtype=np.int64),
    )
