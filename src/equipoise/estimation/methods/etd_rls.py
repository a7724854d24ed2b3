"""Momentum integral behind an extended tracking differentiator, recursively."""

from equipoise.estimation.regression.formulations.tracked import extended
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_extended

METHOD = recursion(
    balance(
        "etd_rls",
        "momentum integral behind an extended tracking differentiator",
        "recursive least squares",
        "Xu 2015 (ETD-RLS); Han 2009 for the differentiator",
    ),
    extended,
    Plan(of_extended),
)
