"""The momentum integral in laboratory axes by least squares."""

from equipoise.estimation.regression.formulations.momentum import laboratory_axes
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "momentum_laboratory",
        "momentum integral in laboratory axes, without a gyroscopic term",
        "least squares",
        "design of this package; after Kim and Agrawal 2009",
    ),
    Linear(laboratory_axes),
)
