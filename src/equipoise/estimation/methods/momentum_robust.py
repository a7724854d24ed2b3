"""The momentum integral in body axes by least squares with Huber's weights."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.robust import robust
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "momentum_robust",
        "momentum integral in body axes, free constants",
        "least squares with Huber's weights",
        "Huber 1964 on da Silva 2021 Eqs. 16-21",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(body_axes, robust),
)
