"""The momentum integral in body axes by least squares among bodies that can exist, log-Cholesky."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.physically_consistent import possible

METHOD = method(
    balance(
        "momentum_possible",
        "momentum integral in body axes, free constants",
        "least squares over physically consistent inertia, log-Cholesky",
        "Wensing 2018; Rucker and Wensing 2022; Keim 2006",
    ),
    Linear(body_axes, possible),
)
