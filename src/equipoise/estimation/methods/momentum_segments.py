"""The momentum integral restarted every 20 s."""

from equipoise.estimation.regression.formulations.momentum import segments
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "momentum_segments",
        "momentum integral in body axes, restarted every 20 s",
        "least squares",
        "da Silva 2021 Eqs. 16-21; restarts after Kim and Agrawal 2009",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(segments, least_squares),
)
