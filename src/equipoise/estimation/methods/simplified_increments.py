"""The simplified model as printed: increments of rates by least squares."""

from equipoise.estimation.regression.formulations.simplified import increments
from equipoise.estimation.regression.linear_cards import simplified_model
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    simplified_model(
        "simplified_increments",
        "Euler without gyroscopic term and products, increments",
        "least squares",
        "Young 1998; da Silva 2021 Eqs. 8-9",
    ),
    Linear(increments, knows_inertia=True),
)
