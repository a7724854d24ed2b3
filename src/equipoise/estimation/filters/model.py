"""The model of a filter: one description from which every published one is cut.

    H' = -w x H + m r x g_B + m_d x g_B + tau,    H = J(d) w + h,    r' = J' = 0 but for walks
    error state  x = [ dth | dw | dc | dJ | ds ],    r = axes c

dth (rad, body axes) is there when the attitude is a state; otherwise the attitude is an input and
g_B with it. dw is the rate (rad/s), dc the centre of mass (m) in the axes of the filter, dJ the
inertia about P (xx yy zz xy xz yz), both with the masses at home. mu = m r with m known: a state r
is a state mu but for the unit.

The first ``reported`` elements are estimated. What stands behind them is considered (Schmidt): its
covariance and its correlation with the rest are carried along, its gain is nought. So a filter that
takes J as known knows how well: with P in blocks of the estimated x and the considered p,

    Phi = [ A  B ; 0  E ],    K = [ K_x ; 0 ],    P+ = (E - K H) P (E - K H)^T + K R K^T

holds for any gain, and P_xx is the covariance of the estimate that this gain makes. Where the
testbed's ``inertia_sd`` is nought nothing stands behind, and the filter is the published one to
the letter. Else the row of r in P_xp is its sensitivity to J: as free motion shows J and r by their
ratio, the sd of r ends no smaller than about inertia_sd times r.

    kf_simplified   w r | J s     J diagonal, no gyroscopic torque; s: see ``jacobian``
    ekf_6  ukf_6    w r | J
    ekf_9  ukf_9    dth w r | J   the camera's own rows
    ekf_12 ukf_12   w r J
    ukf_4           w c_1 | c_2 c_3 J   c_1 along the testbed's up axis

Walks (one sd): a torque moves the rate by J^-1 q_tau sqrt(dt), r moves by q_r sqrt(dt), J does not.
"""

from typing import NamedTuple, cast

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.propagation import rigid_body, stacked
from equipoise.dynamics.rigid_body import Body
from equipoise.estimation.tracker.tracker import posterior_of
from equipoise.maths.linalg import pack_symmetric, skew
from equipoise.model.arrays import Floats, Matrix3, Six, Square, Vector3, Vector6
from equipoise.model.testbed import Testbed

FIRST_RATE = 0.1  # rad/s, chosen: one sd of the rate before the first row, as the tracker has it
FLAT = 1e-9  # chosen: the sine below which an up axis is one of the body's


class Kind(NamedTuple):
    """Which filter: what is a state, what is estimated of it, and how it is carried ahead."""

    attitude: bool  # a state, measured by a camera; else an input, and a gyro measures w
    estimated: int  # leading elements of the error state that are estimated
    gyroscopic: bool = True  # False: the simplified model
    unscented: bool = False
    upright: bool = False  # com in axes of which the first is the testbed's up


class Walks(NamedTuple):
    """What moves by itself, of one sd."""

    torque: float = 1e-6  # N m sqrt(s), chosen as for the tracker
    com: float = 5e-8  # m/sqrt(s), chosen as for the tracker: thermal drift


class Model(NamedTuple):
    """What does not change along the rows, as the kernels see it."""

    body: Body  # com and J in it are not used: those of the estimate are
    maps: Floats  # (k, 18) of the masses
    axes: Matrix3  # r = axes c
    left_out: Six  # kg m^2, the elements of the testbed's J that the model does without
    attitude: bool
    gyroscopic: bool
    unscented: bool
    estimated: int
    noise: float  # variance of a row, an axis: rad^2 or (rad/s)^2
    torque_walk: float  # N m sqrt(s)
    com_walk: float  # m/sqrt(s)


def inertia_in(testbed: Testbed, kind: Kind) -> Vector6:
    """Return the inertia (kg m^2, xx yy zz xy xz yz) that a filter begins with."""
    six = pack_symmetric(testbed.body.inertia_P)
    return six if kind.gyroscopic else six * np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])


def axes_of(kind: Kind, up: Vector3) -> Matrix3:
    """Return the axes (columns) of the centre of mass: the body's, or up and two across it."""
    if not kind.upright:
        return np.eye(3)
    side = skew(up) @ np.eye(3)[int(np.argmin(np.abs(up)))]
    side = side / float(np.linalg.norm(side))
    return np.column_stack([up, side, skew(up) @ side])


def model_of(kind: Kind, testbed: Testbed, noise: float, walks: Walks) -> Model:
    """Return the model; ``noise`` is the variance of a row, rad^2 or (rad/s)^2."""
    six = pack_symmetric(testbed.body.inertia_P)
    left_out = tuple(float(x) for x in six - inertia_in(testbed, kind))
    return Model(
        rigid_body(testbed.body, testbed.gravity),
        stacked(mass_maps(testbed.masses)), axes_of(kind, testbed.up), cast("Six", left_out),
        kind.attitude, kind.gyroscopic, kind.unscented, kind.estimated, noise, *walks,
    )  # fmt: skip


def initial_state(kind: Kind, testbed: Testbed) -> Floats:
    """Return q, H, com (m), J as one array (16); q and H are set at the first row."""
    return np.concatenate(
        [[1.0, 0, 0, 0], np.zeros(3), testbed.body.com, inertia_in(testbed, kind)]
    )


def first_covariance(kind: Kind, model: Model, testbed: Testbed) -> Square:
    """Return the covariance before the first row, without what is known and not estimated."""
    body = posterior_of(testbed).covariance
    body[:3, :3] = model.axes.T @ body[:3, :3] @ model.axes
    o = 3 if kind.attitude else 0
    size = o + 12 if kind.gyroscopic else o + 13
    covariance = np.zeros((size, size))
    covariance[o + 3 : o + 12, o + 3 : o + 12] = body
    covariance[o + 12 :, o + 12 :] = 1.0
    unsure = np.flatnonzero(np.diag(covariance) > 0)
    n = max(kind.estimated, int(unsure.max(initial=0)) + 1)
    return np.ascontiguousarray(covariance[:n, :n])


def column_of(kind: Kind, up: Vector3) -> tuple[str, float] | None:
    """Return the name of the one component that is reported and its sign; None: all three are."""
    if not kind.upright:
        return None
    k = int(np.argmax(np.abs(up)))
    along = abs(float(up[k])) > 1 - FLAT
    return (f"com_{'xyz'[k]}", float(np.sign(up[k]))) if along else ("com_up", 1.0)
