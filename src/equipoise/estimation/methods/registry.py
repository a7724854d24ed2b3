"""The only list of methods: terminal, tests, studies and documents take it from here."""

from equipoise.estimation.method import Method
from equipoise.estimation.methods import (
    averaged_recursive,
    equilibrium,
    etd_rls,
    momentum_body,
    momentum_laboratory,
    momentum_recursive,
    simplified_recursive,
    td_td_rls,
    torque_recursive,
    tracker,
    trajectory,
)

WHOLE = (trajectory, equilibrium, tracker)
LINEAR = (momentum_body, momentum_laboratory)
REGRESSIONS = (
    torque_recursive,
    momentum_recursive,
    averaged_recursive,
    td_td_rls,
    etd_rls,
    simplified_recursive,
)

METHODS: dict[str, Method] = {
    module.METHOD.card.name: module.METHOD for module in (*WHOLE, *LINEAR, *REGRESSIONS)
}
