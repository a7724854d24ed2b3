"""Lee's averaged integral with every term averaged alike."""

from equipoise.estimation.regression.formulations.averaged import centred_means
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "averaged",
        "averaged integral, every term over the same window, free constants",
        "least squares",
        "Lee Eqs. 5-7 with errata L1-L3, L7",
    ),
    Linear(centred_means),
)
