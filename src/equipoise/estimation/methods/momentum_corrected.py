"""The momentum integral in body axes by least squares less the bias of a noisy regressor."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.corrected import corrected

METHOD = method(
    balance(
        "momentum_corrected",
        "momentum integral in body axes, free constants",
        "least squares with the bias of a noisy regressor removed",
        "Fuller 1987 section 2.2 on da Silva 2021 Eqs. 16-21",
    ),
    Linear(body_axes, corrected, needs_noise=True),
)
