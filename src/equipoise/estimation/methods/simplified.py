"""The simplified model summed from the start of each piece."""

from equipoise.estimation.regression.formulations.simplified import integrated
from equipoise.estimation.regression.linear_cards import simplified_model
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    simplified_model(
        "simplified",
        "Euler without gyroscopic term and products, summed, free constants",
        "least squares",
        "da Silva 2021 Eqs. 8-9, integrated with an offset",
    ),
    Linear(integrated, knows_inertia=True),
)
