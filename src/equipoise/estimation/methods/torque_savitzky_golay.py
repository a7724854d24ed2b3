"""The torque balance by a Savitzky-Golay filter of 0.51 s."""

from equipoise.estimation.regression.formulations.torque import savitzky_golay, torque
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "torque_savitzky_golay",
        "torque balance, slopes by a Savitzky-Golay filter of 0.51 s",
        "least squares",
        "da Silva 2021 Eq. 12, sign of Eq. 15 corrected",
    ),
    Linear(torque(savitzky_golay)),
)
