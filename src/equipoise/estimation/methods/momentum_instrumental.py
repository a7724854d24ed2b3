"""The momentum integral in body axes by instrumental variables."""

from equipoise.estimation.regression.formulations.split import split
from equipoise.estimation.regression.linear_method import Linear, method
from equipoise.estimation.regression.solvers.instrumental import instrumental
from equipoise.model.method_card import Card

METHOD = method(
    Card(
        "momentum_instrumental",
        "momentum integral in body axes, from every second sample",
        "instrumental variables: the samples between",
        "Young 2011; Reiersol 1945, on da Silva 2021 Eqs. 16-21",
        "a camera or a gyro; tilt better known with a camera",
        "scale of J and com without a known change; J_zz and products without spin "
        "about more than one axis",
        "driven",
        ("term", "hold"),
    ),
    Linear(split, instrumental),
)
