"""The torque balance by recursive least squares."""

from equipoise.estimation.regression.formulations.torque import savitzky_golay, torque
from equipoise.estimation.regression.linear_method import recursion
from equipoise.estimation.regression.solvers.recursion import Plan, of_slopes
from equipoise.model.method_card import Card

METHOD = recursion(
    Card(
        "torque_recursive",
        "torque balance, slopes by a Savitzky-Golay filter of 0.51 s",
        "recursive least squares",
        "da Silva 2021 Eqs. 12 and 22-25 in matrix form (erratum R10)",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    torque(savitzky_golay),
    Plan(of_slopes),
)
