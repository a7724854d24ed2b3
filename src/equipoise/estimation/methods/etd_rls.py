"""Momentum integral behind an extended tracking differentiator, recursively."""

from equipoise.estimation.regression.formulations.tracked import extended
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_extended
from equipoise.model.method_card import Card

METHOD = recursion(
    Card(
        "etd_rls",
        "momentum integral behind an extended tracking differentiator",
        "recursive least squares",
        "Xu 2015 (ETD-RLS); Han 2009 for the differentiator",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    extended,
    Plan(of_extended),
)
