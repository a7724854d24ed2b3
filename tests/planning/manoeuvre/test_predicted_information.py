"""The predicted covariance of a manoeuvre is that of a fit of its recording, and of the bench."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from equipoise.estimation.information import fisher_information
from equipoise.estimation.information.reference_motion import Followed
from equipoise.estimation.output_error.trajectory import Params
from equipoise.io.testbed.presets import read_preset
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.manoeuvre import Manoeuvre, SquareWave
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import Gyro
from equipoise.planning.manoeuvre.noiseless_record import imagined
from equipoise.planning.manoeuvre.predicted_information import Known, at_truth, posed, predicted

BODY = (*INERTIA, *COM)
X = np.array([1.0, 0.0, 0.0])
PAPER = Manoeuvre(
    120.0, np.radians(4.0), X, np.array([-0.010, -0.004, 0.011]),
    ((60.0, {"x1": -0.010, "y1": -0.010, "z1": -0.050}),),
)  # fmt: skip
WHEELED = Manoeuvre(
    60.0, np.radians(3.0), X, np.zeros(3), ((20.0, {"coarse_z": -0.030}),),
    (SquareWave("rw_x", 0.001, 40.0), SquareWave("rw_z", 0.002, 30.0)),
)  # fmt: skip


@cache
def sputnix():
    return read_preset("sputnix")


@cache
def table():
    return read_preset("reference-table")


@pytest.mark.parametrize(
    ("testbed", "manoeuvre"), [(sputnix(), PAPER), (table(), WHEELED)], ids=["camera", "wheels"]
)
def test_it_is_what_observe_says_of_the_recording(testbed, manoeuvre):
    """`observe` fits the noiseless rows first, and ends at the truth: sd within 1e-3."""
    params = Params(testbed.disturbances)
    said = predicted(testbed, testbed.body, manoeuvre, params)
    observed = fisher_information.information_by(
        imagined(testbed, testbed.body, manoeuvre).recording, testbed, params
    )
    assert said.names == observed.names
    np.testing.assert_allclose(said.sd, observed.sd, rtol=1e-3)


def swung(x: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Attitudes of SciPy's integrator for x = first turn, first rate, com in 10 um; J is known."""
    body = sputnix().body

    def slope(_, y):
        g = Rotation.from_quat(y[:4]).inv().apply([0.0, 0.0, -sputnix().gravity])
        w = y[4:]
        moment = body.mass * np.cross(1e-5 * x[6:], g)
        spin = np.linalg.solve(body.inertia_P, moment - np.cross(w, body.inertia_P @ w))
        x_, y_, z_, w_ = y[:4]
        q = 0.5 * np.array([
            w_ * w[0] + y_ * w[2] - z_ * w[1], w_ * w[1] + z_ * w[0] - x_ * w[2],
            w_ * w[2] + x_ * w[1] - y_ * w[0], -x_ * w[0] - y_ * w[1] - z_ * w[2],
        ])  # fmt: skip
        return np.concatenate([q, spin])

    lean = Rotation.from_rotvec([0.0, np.radians(4.0), 0.0])  # body x sinks
    first = (lean * Rotation.from_rotvec(x[:3])).as_quat()
    start = np.concatenate([first, x[3:6]])
    return (
        solve_ivp(slope, (0.0, t[-1]), start, t_eval=t, method="DOP853", rtol=1e-9, atol=1e-11)
        .y[:4]
        .T
    )


def test_it_is_the_inverse_information_of_another_integrator():
    """J held, camera level: finite differences of SciPy's motion, camera of 0.2 deg at 5 Hz."""
    camera = replace(sputnix().attitude, plumb_sd=0.0)
    testbed = replace(sputnix(), attitude=camera, masses=())
    m = replace(PAPER, moves=(), duration=20.0)
    said = predicted(testbed, testbed.body, m, Params(hold=INERTIA))
    t = np.arange(101) / 5.0
    at = np.concatenate([np.zeros(3), m.rate, testbed.body.com * 1e5])
    columns = []
    for k in range(9):
        ahead, behind = (swung(at + s * 1e-4 * np.eye(9)[k], t) for s in (1, -1))
        turned = (Rotation.from_quat(behind).inv() * Rotation.from_quat(ahead)).as_rotvec()
        columns.append(turned.ravel() / 2e-4 / camera.noise)
    S = np.column_stack(columns)
    sd = np.sqrt(np.diag(np.linalg.inv(S.T @ S)))[6:] * 1e-5
    np.testing.assert_allclose(said.sd_of(COM), sd, rtol=2e-3)


def test_the_drift_of_a_rate_from_white_noise_is_known_as_the_rule_says():
    """sigma(w') = sqrt(12) N T^-3/2 for noise N per root Hz: as in com_x of a level platform.

    Hanging at rest on its side it cannot; so by hand: tau = J w' = m g r gives sigma(r) within the
    first second, while the swing of 35 s has not begun.
    """
    gyro = Gyro(2000.0, 1e-4, 0.0)
    body = MassProperties(14.0, np.array([0.0, 0.0, -1e-9]), np.diag([0.3, 0.3, 0.4]))
    testbed = replace(sputnix(), body=body, attitude=None, gyro=gyro, masses=())
    m = Manoeuvre(1.0, 0.0, X, np.zeros(3))
    params = Params(hold=(*INERTIA, "com_z"))
    said = predicted(testbed, body, m, params)
    density = gyro.noise / np.sqrt(gyro.rate)
    slope = np.sqrt(12.0) * density
    sd = 0.3 * slope / (14.0 * testbed.gravity)
    # the initial attitude is unobservable without a camera: its prior is wide, its pull m g z small
    assert said.sd_of(("com_x",))[0] == pytest.approx(sd, rel=0.05)


def test_it_is_what_observe_says_along_the_same_motion():
    said = predicted(sputnix(), sputnix().body, PAPER, Params())
    body, record = sputnix().body, imagined(sputnix(), sputnix().body, PAPER)
    fitted = at_truth(posed(record, sputnix(), Params(), None), record, body, PAPER, None)
    observed = fisher_information.information_along(Followed(fitted, sputnix(), Params(), ()))
    np.testing.assert_array_equal(said.sd, observed.sd)
    assert said.peak_tilt == pytest.approx(observed.tilt[1], rel=1e-3)


def test_unobservable_parameters_have_infinite_sd_and_are_named():
    said = predicted(sputnix(), sputnix().body, replace(PAPER, moves=()), Params())
    assert np.all(np.isinf(said.sd_of(BODY)))
    assert any(reason.code == "scale" for reason in said.unobservable)
    held = predicted(sputnix(), sputnix().body, PAPER, Params(hold=INERTIA))
    assert np.all(held.sd_of(INERTIA) == 0.0)


def test_what_is_known_counts_as_one_more_recording():
    """Known: the information of a first run like it. Then every sd is 2^-1/2 of one run's.

    But for what hanging masses add, which depends on the lag and so a little on all else: 1e-4.
    """
    alone = predicted(sputnix(), sputnix().body, PAPER, Params())
    where = [alone.names.index(name) for name in BODY]
    first = np.linalg.inv(alone.covariance[np.ix_(where, where)])
    both = predicted(sputnix(), sputnix().body, PAPER, Params(), Known(BODY, first))
    np.testing.assert_allclose(both.sd_of(BODY), alone.sd_of(BODY) / np.sqrt(2), rtol=1e-4)
