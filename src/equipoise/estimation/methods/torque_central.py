"""The torque balance by central differences."""

from equipoise.estimation.regression.formulations.torque import central, torque
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "torque_central",
        "torque balance, slopes by central differences",
        "least squares",
        "da Silva 2021 Eq. 12, sign of Eq. 15 corrected",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(torque(central), least_squares),
)
