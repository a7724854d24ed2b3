"""Rest positions under known shifts of the masses: see ``rest_positions``."""

from equipoise.estimation.method_contract import Method
from equipoise.estimation.regression import rest_positions
from equipoise.model.method_card import Card

METHOD = Method(
    Card(
        "equilibrium",
        "equilibrium points: com hangs under P at every rest of the masses",
        "least squares on directions",
        "long known; da Silva 2021 section 3 names it",
        "a camera, and two moves to rests that are not in line",
        "inertia; anything from a single rest; useless near balance, where nothing rests",
        "rests",
    ),
    rest_positions.estimate,
)
