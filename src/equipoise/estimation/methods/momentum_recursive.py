"""The momentum integral by recursive least squares."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, unfiltered

METHOD = recursion(
    balance(
        "momentum_recursive",
        "momentum integral in body axes, free constants",
        "recursive least squares",
        "da Silva 2021 Eqs. 16-25 in matrix form (erratum R10)",
    ),
    body_axes,
    Plan(unfiltered),
)
