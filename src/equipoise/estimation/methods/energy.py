"""The energy balance by least squares."""

from equipoise.estimation.regression.formulations.energy import energy
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "energy",
        "energy balance, one equation a time",
        "least squares",
        "Tanygin and Williams 1997; Schwartz and Hall 2004",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(energy, least_squares),
)
