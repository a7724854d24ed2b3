"""The momentum integral in body axes by classical Levenberg-Marquardt."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.levenberg_marquardt import damped

METHOD = method(
    balance(
        "momentum_damped",
        "momentum integral in body axes, free constants",
        "classical Levenberg-Marquardt",
        "da Silva 2021 section 3.1.4",
    ),
    Linear(body_axes, damped),
)
