"""The momentum integral in body axes by least squares among bodies that can exist, log-Cholesky."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.physically_consistent import possible
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "momentum_possible",
        "momentum integral in body axes, free constants",
        "least squares among bodies that can exist, log-Cholesky",
        "Wensing 2018; Rucker and Wensing 2022; Keim 2006",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(body_axes, possible),
)
