"""Correlations of an estimate's parameters."""

import numpy as np

from equipoise.app.text.charts import Heatmap
from equipoise.model.arrays import Square
from equipoise.model.estimate import BODY, Estimate

MOST = 16  # parameters, chosen: what fits the width of a page
TITLE = "Correlation of the parameters"
NOTE = (
    "Near 1 or -1, the record shows only a combination of the two parameters: another manoeuvre "
    "separates them."
)
LEFT_OUT = " Not shown: {} parameters with smaller correlations."


def correlations_of(estimate: Estimate | None) -> tuple[Heatmap, ...]:
    """Return the correlations of inertia, centre of mass, and what correlates most with them.

    Nothing without an estimate, or where it has fewer than two parameters with an sd.
    """
    if estimate is None:
        return ()
    known = [k for k, p in enumerate(estimate.parameters)
             if p.observable and np.isfinite(p.sd) and p.sd > 0]  # fmt: skip
    if len(known) < 2:
        return ()
    every = correlation_of(estimate.covariance[np.ix_(known, known)])
    names = [estimate.parameters[k].name for k in known]
    shown = _chosen(names, every)
    values = every[np.ix_(shown, shown)]
    rows = tuple(tuple(round(float(v), 3) for v in row) for row in values)
    left_out = len(known) - len(shown)
    note = NOTE + (LEFT_OUT.format(left_out) if left_out else "")
    return (Heatmap(TITLE, tuple(names[k] for k in shown), rows, note),)


def correlation_of(covariance: Square) -> Square:
    """Return P_ij / sqrt(P_ii P_jj)."""
    sd = np.sqrt(np.diag(covariance))
    return np.clip(covariance / np.outer(sd, sd), -1.0, 1.0)


def _chosen(names: list[str], every: Square) -> list[int]:
    """Return which parameters are shown, in their order: those of the body come before others."""
    body = [k for k, name in enumerate(names) if name in BODY]
    others = [k for k in range(len(names)) if k not in body]
    strength = np.max(np.abs(every[:, body]), axis=1) if body else np.zeros(len(names))
    others.sort(key=lambda k: -float(strength[k]))
    return sorted(body) + sorted(others[: MOST - len(body)])
