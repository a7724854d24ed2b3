"""The only list of methods: terminal, tests, studies and documents take it from here."""

from equipoise.estimation.method_contract import Method
from equipoise.estimation.methods import (
    averaged,
    averaged_printed,
    averaged_recursive,
    ekf_6,
    ekf_9,
    ekf_12,
    energy,
    equilibrium,
    etd_rls,
    kf_simplified,
    momentum_body,
    momentum_corrected,
    momentum_damped,
    momentum_instrumental,
    momentum_laboratory,
    momentum_possible,
    momentum_recursive,
    momentum_robust,
    momentum_segments,
    momentum_weighted,
    simplified,
    simplified_increments,
    simplified_recursive,
    smoother,
    td_td_rls,
    torque_central,
    torque_kalman,
    torque_recursive,
    torque_savitzky_golay,
    torque_tracking,
    tracker,
    trajectory,
    ukf_4,
    ukf_6,
    ukf_9,
    ukf_12,
)

WHOLE = (
    trajectory,
    smoother,
    equilibrium,
    tracker,
)
LINEAR = (
    simplified_increments,
    simplified,
    torque_central,
    torque_savitzky_golay,
    torque_tracking,
    torque_kalman,
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
REGRESSIONS = (
    simplified_recursive,
    torque_recursive,
    momentum_recursive,
    averaged_recursive,
    td_td_rls,
    etd_rls,
)
FILTERS = (
    kf_simplified,
    ekf_6,
    ekf_9,
    ekf_12,
    ukf_4,
    ukf_6,
    ukf_9,
    ukf_12,
)

METHODS: dict[str, Method] = {
    module.METHOD.card.name: module.METHOD for module in (*WHOLE, *LINEAR, *REGRESSIONS, *FILTERS)
}
