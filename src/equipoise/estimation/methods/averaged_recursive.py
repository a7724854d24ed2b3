"""Lee's averaged integral, begun with a batch, then recursive."""

from equipoise.estimation.regression.formulations.averaged import centred_means
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_means

METHOD = recursion(
    balance(
        "averaged_recursive",
        "averaged integral, every term over the same window, free constants",
        "least squares on the first seconds, then recursive",
        "Lee Eqs. 5-8 with errata L1-L3, L7",
    ),
    centred_means,
    Plan(of_means, batch=True),
)
