"""What the tracker knows of elastic sag: a state that has its coefficients, and how well."""

from dataclasses import replace

import numpy as np

from equipoise.estimation.tracker.stored_covariance import SAG_ROW, SIZE, WITH_SAG
from equipoise.estimation.tracker.tracker import State
from equipoise.model.arrays import Floats, Square

SAG = slice(SAG_ROW, WITH_SAG)  # in the error state


def with_sag(state: State, sag: Floats, covariance: Square) -> State:
    """Return a state of a stiff platform with the coefficients (m) of a sag, independent of it."""
    whole = np.zeros((WITH_SAG, WITH_SAG))
    whole[:SIZE, :SIZE], whole[SAG, SAG] = state.covariance, covariance
    return replace(state, sag=sag, covariance=whole)
