"""The torque of gravity on a platform, from its motion and a known inertia alone.

    torque    D[ W(w) p_J + int w x W(w) p_J ] - D[ known side ]  =  D[ int m r x g_B ]
    energy    1/2 w^T J w - known work                            =  m r . g_B + constant

That is the side of a formulation's rows (``formulations.torque``, ``formulations.energy``) that
needs no centre of mass; whatever else turns the platform is in it too. Drawing the stated errors
once more (``replicates``) says what of it is noise:

    rms^2 = mean x_0^2 - noise^2,    noise^2 = mean over draws of (mean x_k^2) - mean x_0^2

as x_0 has the noise once and x_k has it twice. White noise of N rad/s/sqrt(Hz) leaves a cubic
through T seconds a torque of 2.5 sqrt(12) N J T^-3/2 (of a line 1 in place of 2.5).

Cannot see a torque that is quicker than the window of D, nor one below the noise.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.estimation.regression.formulations.rows import Formulation, Posed, values_of
from equipoise.model.arrays import Series, Series1
from equipoise.model.estimate import INERTIA
from equipoise.model.noise_corrected_series import NoiseCorrectedSeries

Draws = Sequence[tuple[Posed, Posed]]


def side_of(formulation: Formulation, posed: Posed) -> tuple[Series1, Series]:
    """Return times and the side of the rows that a known inertia gives."""
    rows, known = formulation(posed), values_of(posed.testbed)
    J = [rows.names.index(name) for name in INERTIA]
    inertia = np.array([known[name] for name in INERTIA])
    return rows.t, rows.A[:, :, J] @ inertia - rows.b


def mean_square(values: Series) -> float:
    """Return the mean square of a vector's length."""
    return float(np.mean(np.square(values))) * values.shape[1]


def residual_torque(
    formulation: Formulation, posed: Posed, draws: Draws, about_mean: bool = False
) -> NoiseCorrectedSeries:
    """Return the residual; ``about_mean`` for what is known up to a constant, as energy is."""

    def side(of: Posed) -> Series:
        values = side_of(formulation, of)[1]
        return values - values.mean(axis=0) if about_mean else values

    t, values = side_of(formulation, posed)[0], side(posed)
    here = mean_square(values)
    again = np.array([mean_square(side(each)) for pair in draws for each in pair])
    noise = max(float(again.mean()) - here, 0.0)
    square, spread = here - noise, float(again.std())
    rms = max(square, 0.0) ** 0.5
    floor = max(rms, spread**0.5, 1e-300)
    squares: Series1 = (values**2).sum(axis=1)
    return NoiseCorrectedSeries(
        t, values, noise**0.5, rms, spread / (2 * floor), float(squares.max()) ** 0.5
    )
