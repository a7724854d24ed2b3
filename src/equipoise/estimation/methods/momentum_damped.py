"""The momentum integral in body axes by classical Levenberg-Marquardt."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.levenberg_marquardt import damped
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "momentum_damped",
        "momentum integral in body axes, free constants",
        "classical Levenberg-Marquardt",
        "da Silva 2021 section 3.1.4",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(body_axes, damped),
)
