"""The simplified model as printed: increments of rates by least squares."""

from equipoise.estimation.regression.formulations.simplified import increments
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "simplified_increments",
        "Euler without gyroscopic term and products, increments",
        "least squares",
        "Young 1998; da Silva 2021 Eqs. 8-9",
        "a camera or a gyro; tilt better known with a camera; inertia, taken from the "
        "testbed (its sd is counted)",
        "J; com along gravity without tilt; com better than J is known",
        "free",
        ("term", "hold"),
    ),
    Linear(increments, least_squares, knows_inertia=True),
)
