"""Increments of the simplified model by recursive least squares."""

from equipoise.estimation.regression.formulations.simplified import increments
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_increments
from equipoise.model.method_card import Card

METHOD = recursion(
    Card(
        "simplified_recursive",
        "Euler without gyroscopic term and products, increments",
        "recursive least squares",
        "da Silva 2021 Eqs. 8-9 and 22-25 in matrix form",
        "a camera or a gyro; tilt better known with a camera; inertia, taken from the "
        "testbed (its sd is counted)",
        "J; com along gravity without tilt; com better than J is known",
        "free",
        ("term", "hold"),
    ),
    increments,
    Plan(of_increments, by_moments=False),
    knows_inertia=True,
)
