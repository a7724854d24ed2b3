"""Rest positions under known shifts of the masses: see ``rest_positions``."""

from equipoise.estimation.method_contract import Method
from equipoise.estimation.regression import rest_positions
from equipoise.model.method_card import Card

METHOD = Method(
    Card(
        "equilibrium",
        "equilibrium points: com hangs below P whenever the platform rests",
        "least squares on directions",
        "long known; named in da Silva 2021 section 3",
        "a camera, and two moves to resting points that are not collinear",
        (
            "inertia; anything from a single resting point; not applicable near balance, "
            "where the platform does not come to rest"
        ),
        "rests",
    ),
    rest_positions.estimate,
)
