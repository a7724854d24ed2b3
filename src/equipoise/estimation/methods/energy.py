"""The energy balance by least squares."""

from equipoise.estimation.regression.formulations.energy import energy
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "energy",
        "energy balance, one equation per sample",
        "least squares",
        "Tanygin and Williams 1997; Schwartz and Hall 2004",
    ),
    Linear(energy),
)
