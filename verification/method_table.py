"""Bias and sd of every method on the same records: the side-by-side test, and two rows more.

Records are MuJoCo's. With J known (held): a slow and a quick free swing. With J sought: a minute of
known square waves, with a fine and with a poor gyro.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import get_args

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation.method_contract import Method, Options, heeded
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.formulations.rows import Formulation, Posed, Rows
from equipoise.estimation.regression.formulations.torque import savitzky_golay, torque
from equipoise.estimation.regression.linear_method import (
    Question,
    aid_for,
    linear_of,
    posed_of,
    posed_rows,
)
from equipoise.estimation.regression.linear_method import method as linear_method
from equipoise.maths.linalg import element_sizes
from equipoise.model.estimate import COM, INERTIA
from verification.method_records import Condition, Record, condition
from verification.result import Result, Row, Spread, in_turn, triple

Array = NDArray[np.float64]
KNOWN_INERTIA = ("slow", "quick")
Triple = tuple[float, float, float]
LONG_WINDOW, FIRST_ESTIMATED = (
    "torque_savitzky_golay of 2.01 s",
    "momentum_body from the first rate",
)
# Bias and sd of com (um) as published, of 20 runs.
PUBLISHED: dict[tuple[str, str], tuple[Triple, Triple | None]] = {
    ("slow", "simplified_increments"): ((-0.48, -0.23, 5.38), (0.046, 0.044, 0.199)),
    ("slow", "simplified"): ((-0.28, -0.47, 4.78), (0.003, 0.003, 0.023)),
    ("slow", "torque_savitzky_golay"): ((0.0, 0.0, 0.0), (0.009, 0.008, 0.041)),
    ("slow", LONG_WINDOW): ((0.0, 0.0, 0.0), (0.005, 0.005, 0.038)),
    ("slow", "momentum_body"): ((0.0, 0.0, 0.0), (0.0032, 0.0034, 0.026)),
    ("slow", FIRST_ESTIMATED): ((0.0, 0.0, -0.03), (0.070, 0.066, 0.346)),
    ("slow", "energy"): ((0.0, 0.0, 0.0), (0.030, 0.027, 0.175)),
    ("quick", "simplified_increments"): ((26.0, 12.0, -132.0), None),
}
LEAST = 5e-4  # um or %, chosen: smaller biases are shown as 0
ROUNDED, SHARE = 0.02, 0.05  # um as printed; of a bias, for an attitude that is not told exactly
QUICK_SHARE = 0.30  # of a bias at 20 deg/s, where it depends on the first attitude
LIMITS = {("noisy", "momentum_corrected"): 1.0, ("noisy", "trajectory"): 0.3}  # % of J


def first_estimated(posed: Posed) -> Rows:
    """Return the momentum integral without free constants: the first row is free of noise."""
    rows = body_axes(posed)
    return replace(rows, A=rows.A - rows.A[0], b=rows.b - rows.b[0], piece=None)


def variant(key: str, formulation: Formulation) -> Method:
    """Return a method of the registry with another formulation."""
    method = METHODS[key]
    linear = linear_of(method)
    assert linear is not None
    return linear_method(method.card, replace(linear, formulation=formulation))


def compared() -> dict[str, Method]:
    """Return all methods, and two forms that are published beside them and not recommended."""
    return METHODS | {
        LONG_WINDOW: variant(
            "torque_savitzky_golay", torque(partial(savitzky_golay, seconds=2.01))
        ),
        FIRST_ESTIMATED: variant("momentum_body", first_estimated),
    }


def values_by(method: Method, record: Record, hold: tuple[str, ...]) -> dict[str, float]:
    """Return what a method finds; of a linear one without its intervals, which take longer."""
    options = heeded(method.card, Options(hold=hold))
    linear = linear_of(method)
    if linear is None:
        estimate = method.run(record.recording, record.testbed, options)
        return {p.name: p.value for p in estimate.parameters}
    posed = posed_of(record.recording, record.testbed, options)
    rows, fixed = posed_rows(linear, posed, options.hold)
    aid = aid_for(Question(linear, posed, rows, fixed, ()))
    return dict(zip(rows.names, map(float, linear.solver(rows, aid)), strict=True))


def found(name: Condition, seed: int) -> dict[str, dict[str, float]]:
    """Return the errors of every method on one record: um of com, % of sqrt(J_ii J_jj) of J."""
    record = condition(name, seed)
    hold, true = INERTIA if name in KNOWN_INERTIA else (), record.truth
    per = dict(zip(INERTIA, 100 / element_sizes(record.inertia_P), strict=True))
    per |= dict.fromkeys(COM, 1e6)
    return {
        key: {
            k: (value - true[k]) * per[k]
            for k, value in values_by(method, record, hold).items()
            if k in per and k not in hold
        }
        for key, method in compared().items()
    }


def table(runs: Sequence[dict[str, dict[str, float]]], key: str, names: Sequence[str]) -> Array:
    """Return the errors (runs, names) of a method; nan where it finds nothing."""
    return np.array([[run[key].get(name, np.nan) for name in names] for run in runs])


def shown(values: Array) -> str:
    """Return three numbers as text, none of them smaller than a reader cares for."""
    return triple(np.where(np.abs(values) < LEAST, 0.0, values), ".3g")


def spread_text(errors: Array) -> str:
    """Return bias and sd as text."""
    return f"{shown(errors.mean(axis=0))}, sd {triple(errors.std(axis=0), '.2g')}"


def as_published(name: str, key: str, errors: Array) -> tuple[str, bool]:
    """Return what was published, and whether the bias agrees within chance."""
    bias, sd = PUBLISHED[name, key]
    share = QUICK_SHARE if name == "quick" else SHARE
    chance = 4 * errors.std(axis=0) * np.sqrt(1 / len(errors) + 1 / 20)
    off = np.abs(errors.mean(axis=0) - bias)
    reported = triple(bias, ".3g") + (f", sd {triple(sd, '.2g')}" if sd else "") + " as published"
    return reported, bool(np.all(off <= chance + share * np.abs(bias) + ROUNDED))


def rows_of(name: Condition, runs: Sequence[dict[str, dict[str, float]]]) -> list[Row]:
    """Return the rows of one condition."""
    made = list[Row]()
    for key in runs[0]:
        com = table(runs, key, COM)
        observed = ~np.isnan(com).any(axis=0)
        if observed.any():
            reported, ok = (
                ("", True) if (name, key) not in PUBLISHED else as_published(name, key, com)
            )
            made.append(Row(f"{name}: {key}, com (um)", spread_text(com), reported, ok))
        moments = table(runs, key, INERTIA)
        if name not in KNOWN_INERTIA and not np.isnan(moments).any() and np.any(moments):
            made.append(inertia_row(name, key, moments))
    return made


def inertia_row(name: str, key: str, errors: Array) -> Row:
    """Return the row of J: moments, and the product that is worst."""
    bias, worst = errors.mean(axis=0), np.abs(errors.mean(axis=0)).max()
    limit = LIMITS.get((name, key))
    text = f"{spread_text(errors[:, :3])}; products at most {np.abs(bias[3:]).max():.2g}"
    reported = "" if limit is None else f"every bias at most {limit:g}"
    return Row(f"{name}: {key}, J (%)", text, reported, limit is None or bool(worst <= limit))


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Run every method on every condition."""
    rows = list[Row]()
    for name in get_args(Condition):
        rows += rows_of(name, spread(partial(found, name), seeds))
    claim = (
        f"Bias and sd of every method on {len(seeds)} records of each of four conditions: 14.307 "
        "kg, 60 s, 100 Hz, camera 0.05 deg; slow: 3 deg/s of spin, quick: 20 deg/s, J held; "
        "driven: square waves of 10 mN m, J sought; noisy: the same with a gyro of 0.05 instead "
        "of 0.005 deg/s/sqrt(Hz). J in % of sqrt(J_ii J_jj)."
    )
    notes = (
        "The published test tells a tilt of 8 deg but not about which axis; roll and pitch of 5.1 "
        "deg give its biases. At 20 deg/s the bias of the simplified model depends on the heading "
        "while the platform turns seven times, and agrees in sign and size only.",
        "Attitudes are led by the gyro and held by the camera, which the published test does not "
        "do: so are sd that are smaller.",
        "ukf_4 seeks com_z alone and knows com across it to 100 um here, beside which the record "
        "says nothing of com_z: what stands for its bias is the error of the testbed, which it "
        "keeps, with the testbed's sd (docs/derivations.md, the filter of the height).",
        "A plain momentum integral is biased by less here than published (5 to 16 %): noise of "
        "0.5 deg/s is set against triangles of rate of several deg/s.",
    )
    return Result("method_table", claim, tuple(rows), notes)
