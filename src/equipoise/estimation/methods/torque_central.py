"""The torque balance by central differences."""

from equipoise.estimation.regression.formulations.torque import central, torque
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "torque_central",
        "torque balance, slopes by central differences",
        "least squares",
        "da Silva 2021 Eq. 12, sign of Eq. 15 corrected",
    ),
    Linear(torque(central)),
)
