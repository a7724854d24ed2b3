"""The momentum integral in body axes by least squares."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "momentum_body",
        "momentum integral in body axes, free constants",
        "least squares",
        "da Silva 2021 Eqs. 16-21, t0 terms restored; Kim and Agrawal 2009",
    ),
    Linear(body_axes),
)
