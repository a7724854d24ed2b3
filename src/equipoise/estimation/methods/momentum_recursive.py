"""The momentum integral by recursive least squares."""

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, unfiltered
from equipoise.model.method_card import Card

METHOD = recursion(
    Card(
        "momentum_recursive",
        "momentum integral in body axes, free constants",
        "recursive least squares",
        "da Silva 2021 Eqs. 16-25 in matrix form (erratum R10)",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    body_axes,
    Plan(unfiltered),
)
