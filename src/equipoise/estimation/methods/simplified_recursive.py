"""Increments of the simplified model by recursive least squares."""

from equipoise.estimation.regression.formulations.simplified import increments
from equipoise.estimation.regression.linear_cards import simplified_model
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_increments

METHOD = recursion(
    simplified_model(
        "simplified_recursive",
        "Euler without gyroscopic term and products, increments",
        "recursive least squares",
        "da Silva 2021 Eqs. 8-9 and 22-25 in matrix form",
    ),
    increments,
    Plan(of_increments, by_moments=False),
    knows_inertia=True,
)
