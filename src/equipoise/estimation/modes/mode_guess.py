"""A first guess of a mode from the line that it makes in what a fit leaves.

The line says the frequency w_k at which mode and platform move together, and the direction u of the
residual rate. With a share k = d.J^-1 d of the inertia and a damping, both of a coarse grid,

    d = c J u,      W = w_k (1 - k)^(1/2)

and the residual is linear in how the mode moves at the beginning,

    dw = -J^-1 d e',       e = e_driven + e_0 e_1 + e'_0 e_2

so that least squares give both. The pair of the grid that leaves least is a guess; the descent
begins with the best small share as well, since a great one may hold it at a false optimum.
"""

import itertools
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.modes.modal_response import Ground, ground_of, inertia_of, response
from equipoise.estimation.modes.residual_line import Line
from equipoise.maths.sampled.running_integral import by_parabolas
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Matrix3, Series1, Series3
from equipoise.model.modes import FreeMode, Mode, freed, held
from equipoise.model.testbed import Testbed

SHARES = (0.001, 0.01, 0.03, 0.1, 0.3)  # of the inertia about the line's axis, chosen
LITTLE = 2  # of them, chosen: so small that its motion changes nothing of the platform's
DAMPINGS = (0.0005, 0.003, 0.01, 0.03)  # of the critical one, chosen
TURN = 0.01  # rad, chosen: of a mode, the unit in which it begins


class Residual(NamedTuple):
    """The rows in which a line stands out."""

    t: Series1
    left: Series3  # rad/s of the gyro, rad of the camera
    of_rate: bool


def residual_of(model: RecordModel) -> Residual:
    """Return what a fit leaves of the gyro's rows, or of a camera's where there is no gyro."""
    fitted, recording = model.fitted, model.fitted.problem.recording
    observed = fitted.problem.observed
    if recording.rate is not None:
        return Residual(recording.rate.t, fitted.at.left_w * observed.rate_sd, True)
    assert recording.attitude is not None
    return Residual(recording.attitude.t, fitted.at.left_q * observed.attitude_sd, False)


def mode_of(line: Line, inertia: Matrix3, share: float, damping: float) -> Mode:
    """Return a mode at rest of a line, with a share of the inertia and a damping."""
    along = inertia @ line.axis
    size = (share / float(line.axis @ along)) ** 0.5
    return held(FreeMode(line.frequency, damping, size * along), inertia)


def effect(ground: Ground, mode: Mode, testbed: Testbed, rows: Residual) -> Floats:
    """Return what a mode does to rows, (3 n,)."""
    found = response(ground, [mode], testbed)
    rate: Floats = -found.velocity * (ground.inverse @ mode.coupling)
    shown = read_at(rows.t, found.t, rate if rows.of_rate else by_parabolas(found.t, rate))
    return np.ravel(shown if rows.of_rate else shown - shown.mean(axis=0))


def begun_best(ground: Ground, mode: Mode, testbed: Testbed, rows: Residual) -> tuple[float, Mode]:
    """Return the mode with the beginning that leaves least of rows, and the square that is left."""
    unit = TURN * mode.inertia**0.5
    pairs = ((0.0, 0.0), (unit, 0.0), (0.0, unit * mode.angular_frequency))
    tried = [effect(ground, begun_with(mode, *pair), testbed, rows) for pair in pairs]
    columns = np.column_stack([tried[1] - tried[0], tried[2] - tried[0]])
    aim = np.ravel(rows.left) - tried[0]
    amounts = np.linalg.lstsq(columns, aim, rcond=None)[0].astype(np.float64, copy=False)
    left: Floats = aim - columns @ amounts
    deflection, velocity = (a * p for a, p in zip(amounts, (pairs[1][0], pairs[2][1]), strict=True))
    return float(left @ left), begun_with(mode, float(deflection), float(velocity))


def begun_with(mode: Mode, deflection: float, velocity: float) -> Mode:
    """Return the mode with another beginning."""
    return Mode(mode.frequency, mode.damping, mode.coupling, mode.moment, deflection, velocity)


def guesses(model: RecordModel, line: Line) -> tuple[FreeMode, ...]:
    """Return the mode that explains a line best, and the best of those that take part little.

    What a small share leaves open a great one may wrongly fix: the motion that drives a mode and
    how it begins are then alike, and the descent from one of them may end beside the optimum.
    """
    ground = ground_of(model, 2.0 * float(np.pi) * line.frequency)
    rows, inertia = residual_of(model), inertia_of(model)

    def best_of(shares: Sequence[float]) -> tuple[float, Mode]:
        modes = [mode_of(line, inertia, *pair) for pair in itertools.product(shares, DAMPINGS)]
        found = [begun_best(ground, mode, model.testbed, rows) for mode in modes]
        return min(found, key=lambda pair: pair[0])

    little, much = best_of(SHARES[:LITTLE]), best_of(SHARES[LITTLE:])
    best = [little[1]] if little[0] <= much[0] else [little[1], much[1]]
    return tuple(freed(mode, inertia) for mode in best)
