"""How strongly a mode shows: the chi-square of what it does to the rows of a sensor.

    S = sum_rows |J^-1 d e'|^2 / noise^2

of the gyro, or of its integral in the camera's rows where there is no gyro. With n rows it is n
times the square of what the mode does, rms, in units of the noise. ``modal_search`` states from
which S on modes are found.
"""

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.modes.modal_response import ground_of, inertia_of
from equipoise.estimation.modes.mode_guess import effect, residual_of
from equipoise.model.modes import held


def strengths(model: RecordModel) -> tuple[float, ...]:
    """Return S of each mode of a model."""
    if not model.modes:
        return ()
    fastest = 2.0 * float(np.pi) * max(mode.frequency for mode in model.modes)
    ground, rows, inertia = ground_of(model, fastest), residual_of(model), inertia_of(model)
    observed = model.fitted.problem.observed
    noise = observed.rate_sd if rows.of_rate else observed.attitude_sd
    shown = (effect(ground, held(one, inertia), model.testbed, rows) for one in model.modes)
    return tuple(float(np.sum(left**2) / noise**2) for left in shown)
