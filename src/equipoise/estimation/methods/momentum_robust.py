"""The momentum integral in body axes by least squares with Huber's weights."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.robust import robust

METHOD = method(
    balance(
        "momentum_robust",
        "momentum integral in body axes, free constants",
        "least squares with Huber's weights",
        "Huber 1964 on da Silva 2021 Eqs. 16-21",
    ),
    Linear(body_axes, robust),
)
