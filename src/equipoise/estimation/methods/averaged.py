"""Lee's averaged integral with every term averaged alike."""

from equipoise.estimation.regression.formulations.averaged import centred_means
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "averaged",
        "averaged integral, every term over the same window, free constants",
        "least squares",
        "Lee Eqs. 5-7 with errata L1-L3, L7",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(centred_means, least_squares),
)
