"""The torque balance behind two tracking differentiators, recursively."""

from equipoise.estimation.regression.formulations.torque import torque
from equipoise.estimation.regression.formulations.tracked import tracking
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_tracking
from equipoise.model.method_card import Card

METHOD = recursion(
    Card(
        "td_td_rls",
        "torque balance, slopes behind two tracking differentiators",
        "recursive least squares",
        "Xu 2015 (TD-TD-RLS); Han 2009 for the differentiator",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    torque(tracking),
    Plan(of_tracking),
)
