"""The simplified model summed from the start of each piece."""

from equipoise.estimation.regression.formulations.simplified import integrated
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "simplified",
        "Euler without gyroscopic term and products, summed, free constants",
        "least squares",
        "da Silva 2021 Eqs. 8-9, integrated with an offset",
        "a camera or a gyro; tilt better known with a camera; inertia, taken from the "
        "testbed (its sd is counted)",
        "J; com along gravity without tilt; com better than J is known",
        "free",
        ("term", "hold"),
    ),
    Linear(integrated, least_squares, knows_inertia=True),
)
