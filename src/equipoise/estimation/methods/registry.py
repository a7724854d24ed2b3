"""The only list of methods: terminal, tests, studies and documents take it from here."""

from equipoise.estimation.method import Method
from equipoise.estimation.methods import (
    ekf_6,
    ekf_9,
    ekf_12,
    equilibrium,
    kf_simplified,
    momentum_body,
    momentum_laboratory,
    tracker,
    trajectory,
    ukf_4,
    ukf_6,
    ukf_9,
    ukf_12,
)

WHOLE = (trajectory, equilibrium, tracker)
LINEAR = (momentum_body, momentum_laboratory)
FILTERS = (kf_simplified, ekf_6, ekf_9, ekf_12, ukf_4, ukf_6, ukf_9, ukf_12)

METHODS: dict[str, Method] = {
    module.METHOD.card.name: module.METHOD for module in (*WHOLE, *LINEAR, *FILTERS)
}
