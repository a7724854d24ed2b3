"""The only list of methods: terminal, tests, studies and documents take it from here."""

from equipoise.estimation.method import Method
from equipoise.estimation.methods import (
    equilibrium,
    momentum_body,
    momentum_laboratory,
    smoother,
    tracker,
    trajectory,
)

WHOLE = (trajectory, equilibrium, tracker, smoother)
LINEAR = (momentum_body, momentum_laboratory)

METHODS: dict[str, Method] = {
    module.METHOD.card.name: module.METHOD for module in (*WHOLE, *LINEAR)
}
