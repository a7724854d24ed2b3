"""The momentum integral in body axes by weighted least squares."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.weighted import weighted

METHOD = method(
    balance(
        "momentum_weighted",
        "momentum integral in body axes, free constants",
        "weighted least squares",
        "da Silva 2021 Eq. 17; weights from the residuals",
    ),
    Linear(body_axes, weighted),
)
