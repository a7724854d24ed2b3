"""The torque balance of Kalman-filtered rates, slopes by an even Savitzky-Golay filter."""

from equipoise.estimation.regression.formulations.kalman import kalman_torque
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "torque_kalman",
        "torque balance of rates behind an EKF, slopes by an even Savitzky-Golay filter",
        "least squares",
        "Kim, Yang and Lee 2016 (EKF and SGF), as far as its abstract tells",
        "a camera or a gyro; tilt better known with a camera; a first guess of J and com with "
        "their sd",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(kalman_torque, least_squares, knows_inertia=True),
)
