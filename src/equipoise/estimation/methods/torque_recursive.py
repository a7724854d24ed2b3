"""The torque balance by recursive least squares."""

from equipoise.estimation.regression.formulations.torque import savitzky_golay, torque
from equipoise.estimation.regression.linear_cards import balance
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_slopes

METHOD = recursion(
    balance(
        "torque_recursive",
        "torque balance, slopes by a Savitzky-Golay filter of 0.51 s",
        "recursive least squares",
        "da Silva 2021 Eqs. 12 and 22-25 in matrix form (erratum R10)",
    ),
    torque(savitzky_golay),
    Plan(of_slopes),
)
