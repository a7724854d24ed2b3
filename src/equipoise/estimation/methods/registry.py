"""The only list of methods: terminal, tests, studies and documents take it from here."""

from equipoise.estimation.method import Method
from equipoise.estimation.methods import (
    averaged,
    averaged_printed,
    energy,
    equilibrium,
    momentum_body,
    momentum_corrected,
    momentum_damped,
    momentum_instrumental,
    momentum_laboratory,
    momentum_possible,
    momentum_robust,
    momentum_segments,
    momentum_weighted,
    simplified,
    simplified_increments,
    torque_central,
    torque_savitzky_golay,
    tracker,
    trajectory,
)

WHOLE = (trajectory, equilibrium, tracker)
LINEAR = (
    simplified_increments,
    simplified,
    torque_central,
    torque_savitzky_golay,
    momentum_body,
    momentum_laboratory,
    momentum_segments,
    averaged_printed,
    averaged,
    energy,
    momentum_weighted,
    momentum_robust,
    momentum_corrected,
    momentum_instrumental,
    momentum_damped,
    momentum_possible,
)

METHODS: dict[str, Method] = {
    module.METHOD.card.name: module.METHOD for module in (*WHOLE, *LINEAR)
}
