"""The momentum integral in laboratory axes by least squares."""

from equipoise.estimation.regression.formulations.momentum import laboratory_axes
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "momentum_laboratory",
        "momentum integral in laboratory axes, where no gyroscopic term is left",
        "least squares",
        "design of this package; after Kim and Agrawal 2009",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(laboratory_axes, least_squares),
)
