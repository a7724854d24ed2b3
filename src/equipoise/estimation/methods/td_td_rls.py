"""The torque balance behind two tracking differentiators, recursively."""

from equipoise.estimation.regression.formulations.torque import torque
from equipoise.estimation.regression.formulations.tracked import tracking
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_tracking

METHOD = recursion(
    balance(
        "td_td_rls",
        "torque balance, slopes behind two tracking differentiators",
        "recursive least squares",
        "Xu 2015 (TD-TD-RLS); Han 2009 for the differentiator",
    ),
    torque(tracking),
    Plan(of_tracking),
)
