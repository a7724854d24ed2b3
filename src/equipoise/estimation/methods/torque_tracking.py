"""The torque balance behind two tracking differentiators."""

from equipoise.estimation.regression.formulations.torque import torque
from equipoise.estimation.regression.formulations.tracked import tracking
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "torque_tracking",
        "torque balance, slopes behind two tracking differentiators",
        "least squares",
        "Xu 2015; Han 2009 for the differentiator",
    ),
    Linear(torque(tracking)),
)
