"""Lee's averaged integral, begun with a batch, then recursive."""

from equipoise.estimation.regression.formulations.averaged import centred_means
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_means
from equipoise.model.method_card import Card

METHOD = recursion(
    Card(
        "averaged_recursive",
        "averaged integral, every term over the same window, free constants",
        "least squares on the first seconds, then recursive",
        "Lee Eqs. 5-8 with errata L1-L3, L7",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    centred_means,
    Plan(of_means, batch=True),
)
