"""Lee's averaged integral as printed."""

from equipoise.estimation.regression.formulations.averaged import as_printed
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import Linear, method

METHOD = method(
    balance(
        "averaged_printed",
        "averaged integral, mean of rates before each time, first rate as measured",
        "least squares",
        "Lee Eqs. 5-7 with errata L1-L3",
    ),
    Linear(as_printed),
)
