"""The torque balance behind two tracking differentiators."""

from equipoise.estimation.regression.formulations.torque import torque
from equipoise.estimation.regression.formulations.tracked import tracking
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "torque_tracking",
        "torque balance, slopes behind two tracking differentiators",
        "least squares",
        "Xu 2015; Han 2009 for the differentiator",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(torque(tracking), least_squares),
)
