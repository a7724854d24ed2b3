"""The torque balance of Kalman-filtered rates, slopes by an even Savitzky-Golay filter."""

from equipoise.estimation.regression.formulations.kalman import kalman_torque
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "torque_kalman",
        "torque balance of rates behind an EKF, slopes by an even Savitzky-Golay filter",
        "least squares",
        "Kim, Yang and Lee 2016 (EKF and SGF), from its abstract",
        "; an initial J and com with their sd",
    ),
    Linear(kalman_torque, knows_inertia=True),
)
