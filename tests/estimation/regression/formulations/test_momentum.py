"""The momentum integral as an estimator: both axes agree, nearly on the truth."""

from functools import cache

import numpy as np
import pytest

from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.regression.linear_method import FEWEST
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.recording import window
from tests.support.builders import COM, INERTIA, move_at, noisy, platform, recording

pytestmark = pytest.mark.usefixtures("few_draws")

TESTBED = platform(accuracy=1e-4, gyro=True)


@cache
def observed(moved: bool = True, seed: int = 1):
    """Two minutes of camera (0.2 deg) and gyro (0.1 mrad/s), with a move or free."""
    return noisy(recording(120.0, move_at(60.0, 120.0) if moved else None, 5.0, 20.0), seed)


def estimate(observed_, testbed, axes):
    return METHODS[f"momentum_{axes}"].run(observed_, testbed, Options())


def sd_of(found, names) -> np.ndarray:
    return np.sqrt(np.diag(found.covariance_of(names)))


def test_body_and_laboratory_axes_agree():
    """Same rows, other weights: within 2 of their sd of each other, on every parameter."""
    body, laboratory = (estimate(observed(), TESTBED, axes) for axes in ("body", "laboratory"))
    names = (*COM_NAMES, *INERTIA_NAMES)
    off = np.abs(body.values(names) - laboratory.values(names))
    assert np.all(off < 2 * sd_of(laboratory, names))


@pytest.mark.parametrize("axes", ["body", "laboratory"])
@pytest.mark.parametrize("seed", [1, 3, 4])
def test_a_gyro_and_a_move_show_the_truth(axes, seed):
    """Centre of mass and inertia within 3 sd, the bias of noisy rates among them."""
    found = estimate(observed(seed=seed), TESTBED, axes)
    assert np.all(np.abs(found.com - COM) < 3 * sd_of(found, COM_NAMES))
    off = np.abs(found.values(INERTIA_NAMES) - INERTIA)
    assert np.all(off < 3 * sd_of(found, INERTIA_NAMES))


@pytest.mark.parametrize("axes", ["body", "laboratory"])
def test_free_motion_gives_ratios_only(axes):
    """No parameter has a finite interval; com over J_zz is right to 5 % of its length."""
    found = estimate(observed(moved=False), TESTBED, axes)
    assert all(np.isinf(p.sd) and not p.observable for p in found.parameters)
    assert found.unobservable[0].code == "scale"
    ratios = {p.name: p for p in found.ratios}
    com = np.array([ratios[f"{name}/inertia_P_zz"].value for name in COM_NAMES])
    assert np.linalg.norm(com - COM / INERTIA[2]) < 0.05 * np.linalg.norm(COM / INERTIA[2])
    assert all(np.isfinite(p.sd) and p.sd > 0 for p in found.ratios)


def test_too_few_rows_are_an_outcome():
    """Half a second of a gyro are eleven rows: nothing to fit, and it says so."""
    found = estimate(window(observed(), 0.0, 0.5), TESTBED, "laboratory")
    assert not found.outcome.usable
    (reason,) = found.outcome.reasons
    assert (reason.code, reason.numbers) == ("too_few_rows_without_gap", {"rows": FEWEST - 1})
