"""The momentum integral in body axes by weighted least squares."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.weighted import weighted
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "momentum_weighted",
        "momentum integral in body axes, free constants",
        "weighted least squares",
        "da Silva 2021 Eq. 17; weights by what is left",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(body_axes, weighted),
)
