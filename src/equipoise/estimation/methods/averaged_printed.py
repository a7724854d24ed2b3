"""Lee's averaged integral as printed."""

from equipoise.estimation.regression.formulations.averaged import as_printed
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "averaged_printed",
        "averaged integral, mean of rates before each time, first rate as it is",
        "least squares",
        "Lee Eqs. 5-7 with errata L1-L3",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(as_printed, least_squares),
)
