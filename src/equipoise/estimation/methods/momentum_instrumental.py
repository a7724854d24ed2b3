"""The momentum integral in body axes by instrumental variables."""

from equipoise.estimation.regression.formulations.split import split
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.instrumental import instrumental

METHOD = method(
    balance(
        "momentum_instrumental",
        "momentum integral in body axes, from every second sample",
        "instrumental variables: the samples between",
        "Young 2011; Reiersol 1945, on da Silva 2021 Eqs. 16-21",
    ),
    Linear(split, instrumental),
)
