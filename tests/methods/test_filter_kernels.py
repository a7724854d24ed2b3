"""The filters' kernels are the textbook's filters: twins, limits, derivatives."""

from dataclasses import replace

import numpy as np
import pytest
from builders import (
    COM,
    GRAVITY,
    GYRO_SD,
    INERTIA,
    MASS,
    body,
    line_of,
    maps,
    move_at,
    noisy,
    platform,
    recording,
)
from scipy.linalg import expm

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.propagation import propagate
from equipoise.dynamics.regressor import WIDTH
from equipoise.dynamics.rigid_body import body_at
from equipoise.estimation.filters import driver, predict
from equipoise.estimation.filters.jacobian import change_of, write_jacobian
from equipoise.estimation.filters.model import Kind, Walks, axes_of, model_of
from equipoise.estimation.filters.predict import Drive
from equipoise.estimation.filters.rows import camera_rows, gyro_rows, taken
from equipoise.estimation.methods import (
    ekf_6,
    ekf_9,
    ekf_12,
    kf_simplified,
    ukf_4,
    ukf_6,
    ukf_9,
    ukf_12,
)
from equipoise.maths.compiled import kernel
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Samples
from tests.methods import plain_filters as plain

KINDS = {
    m.METHOD.card.name: m.KIND
    for m in (kf_simplified, ekf_6, ekf_9, ekf_12, ukf_4, ukf_6, ukf_9, ukf_12)
}
END = 30.0
PUSH = Samples(np.array([0.0, 7, 7.03, 20, END]), np.outer([1, 1, -1, 1, 2], [2e-4, -1e-4, 3e-4]))
WHEEL = Samples(np.array([0.0, 12, 18]), np.outer([1, 1, 4], [2e-4, -1e-4, 3e-4]))
WALKS = Walks(3e-6, 2e-7)


def bench(inertia_sd=0.05):
    """A platform whose guess is off: com by 0.3 sd, moments by up to 4 %."""
    testbed = platform(gyro=True)
    guess = MassProperties(
        MASS, COM + [20e-6, -30e-6, 25e-6], unpack_symmetric(INERTIA * [1.04, 0.97, 1.02, 1, 1, 1])
    )
    tilted = np.array([0.1, -0.2, 1.0]) / np.linalg.norm([0.1, -0.2, 1.0])
    return replace(testbed, body=guess, inertia_sd=inertia_sd, up=tilted)


@pytest.fixture(scope="module")
def seen():
    """A move, a torque, a wheel, and a gap of both sensors: what the filters have to know."""
    record = noisy(recording(END, move_at(10.0, END), 5.0, 20.0), 3)

    def gapped(channel):
        keep = (channel.t < 21) | (channel.t > 24)
        return Samples(channel.t[keep], channel.values[keep])

    return replace(
        record, attitude=gapped(record.attitude), rate=gapped(record.rate), torque=PUSH,
        momentum=WHEEL,
    )  # fmt: skip


def rows_of(kind, record, testbed):
    if kind.attitude:
        return camera_rows(record, testbed), testbed.attitude.noise
    return gyro_rows(record, testbed)[0], testbed.gyro.noise


@pytest.mark.parametrize("name", KINDS)
def test_kernels_are_the_plain_filters(seen, name):
    """To 1e-6 sd of every parameter after every row, and of every covariance.

    Through a move, a torque with an edge between two rows, a wheel and a gap.
    """
    kind, testbed = KINDS[name], bench()
    rows, noise = rows_of(kind, seen, testbed)
    rows = taken(rows, 0, len(rows.node)) if not kind.unscented else taken(rows, 0, 250)
    if kind.attitude:
        rows, _ = rows_of(kind, seen, testbed)
    end, passed = driver.advance(driver.begin(kind, testbed, noise, WALKS), rows)
    twin, first = plain.begun(kind, testbed, noise, WALKS, axes_of(kind, testbed.up))
    found = plain.run(twin, rows, first)
    values = np.array([[*b.com, *plain.six(b.J)] for b in found])
    sd = passed.course.sd
    shown = end.shown
    assert np.abs((values @ shown.T - passed.course.values) / sd).max() < 1e-6
    scale = np.sqrt(np.diag(end.covariance))
    apart = (found[-1].P - end.covariance) / np.outer(scale, scale)
    assert np.abs(apart).max() < 1e-6
    np.testing.assert_allclose(found[-1].H, end.belief[4:7], rtol=1e-7)


@kernel
def _jacobian(model, maps, t, known, q, w, share, F):
    """F of a platform at a share of a step."""
    rigid = predict.placed(model.body, np.array([*COM, *INERTIA]))
    here, end = body_at(rigid, maps, t, known, 0, 0.0), body_at(rigid, maps, t, known, 0, 1.0)
    now, dy, y = body_at(rigid, maps, t, known, 0, share), np.zeros(7), np.empty(7)
    H = predict.times(now.inertia, (w[0], w[1], w[2]))
    y[:4] = q
    for j in range(3):
        y[4 + j] = H[j] + now.momentum[j]
    g = predict.gravity_of(y, model.body.gravity)
    predict.slope(model, rigid, now, g, y, np.zeros((3, WIDTH)), dy)
    push = (dy[4], dy[5], dy[6])
    change = change_of(here, end, t[1] - t[0])
    write_jacobian(
        model, now, change, (w[0], w[1], w[2]), push, g, np.zeros((3, 6)), np.zeros((3, 6)), F
    )


def complex_step(testbed, kind, axes, a, b, q, w, share, dt, n):
    """Im f(x + i h e_j) / h, h = 1e-20 (review Eq. 38, three columns, divided by h)."""
    o, g = (3 if kind.attitude else 0), plain.gravity_of(q, testbed.gravity)
    six = np.array(INERTIA) if kind.gyroscopic else INERTIA * [1, 1, 1, 0, 0, 0]
    products = plain.full(np.array(INERTIA) * [0, 0, 0, 1, 1, 1])

    def slopes(x):
        x = np.append(x, np.zeros(o + 13 - n))
        com, J = COM + axes @ x[o + 3 : o + 6], plain.full(six + x[o + 6 : o + 12])
        ends = [plain.platform_at(testbed, com, J, a, b, dt, s) for s in (0, 1)]
        here = plain.platform_at(testbed, com, J, a, b, dt, share)
        change = (ends[1].J - ends[0].J) / dt, (ends[1].h - ends[0].h) / dt
        rate, weight = w + x[o : o + 3], g + (np.cross(g, x[:3]) if o else 0)
        out = plain.acceleration(here, change, rate, weight, kind.gyroscopic)
        if not kind.gyroscopic:
            whole = plain.acceleration(here._replace(J=here.J + products), change, rate, weight, True)
            out = out + x[o + 12] * (whole - out)
        return np.concatenate([x[3:6] - np.cross(w, x[:3]), out]) if o else out

    h = 1e-20
    return np.column_stack([slopes(1j * h * e).imag / h for e in np.eye(n)])


@pytest.mark.parametrize("name", KINDS)
def test_jacobian_is_the_complex_step(name):
    """To 1e-12 of each block's size: masses under way, wheel and torque changing."""
    kind, testbed = KINDS[name], bench()
    testbed = replace(testbed, body=MassProperties(MASS, COM, unpack_symmetric(INERTIA)))
    rng = np.random.default_rng(5)
    a = np.concatenate([1e-2 * rng.normal(size=3), 1e-3 * rng.normal(size=3), [0.01, -0.02, 0.03]])
    b = a + np.concatenate([1e-3 * rng.normal(size=6), [0.001, 0.002, -0.001]])
    q, w, dt = plain.exponential(np.array([0.2, -0.1, 2.0])), np.array([0.3, -0.5, 0.7]), 0.1
    n = (3 if kind.attitude else 0) + (12 if kind.gyroscopic else 13)
    rows = 6 if kind.attitude else 3
    model, F = model_of(kind, testbed, 1.0, WALKS), np.zeros((rows, n))
    if not kind.gyroscopic:
        pytest.skip("see the next test: its inertia is diagonal")
    line, known = np.array([0.0, dt]), np.vstack([a, b])
    _jacobian(model, predict_maps(testbed), line, known, q, w, 0.3, F)
    wanted = complex_step(testbed, kind, model.axes, a, b, q, w, 0.3, dt, n)
    for k in range(0, n, 3):
        block = wanted[:, k : k + 3]
        np.testing.assert_allclose(F[:, k : k + 3], block, atol=1e-12 * np.abs(block).max(), rtol=0)


def predict_maps(testbed):
    from equipoise.dynamics.propagation import stacked

    return stacked(mass_maps(testbed.masses))
