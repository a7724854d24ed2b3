"""The momentum integral restarted every 20 s."""

from equipoise.estimation.regression.formulations.momentum import segments
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "momentum_segments",
        "momentum integral in body axes, restarted every 20 s",
        "least squares",
        "da Silva 2021 Eqs. 16-21; restarts after Kim and Agrawal 2009",
    ),
    Linear(segments),
)
