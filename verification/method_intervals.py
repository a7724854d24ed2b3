"""Do the intervals of every method hold, on the records that its card names?"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from equipoise.estimation.method_contract import Method, Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.regression import linear_method as linear_methods
from equipoise.estimation.regression.formulations.rows import Formulation, Posed, Rows
from equipoise.estimation.regression.linear_method import linear_of, posed_of
from equipoise.estimation.regression.monte_carlo_replicates import Drawn, pairs
from equipoise.model.estimate import Estimate
from equipoise.model.method_card import REGIMES, Regime
from verification.chance import share_band
from verification.method_records import Record, regime
from verification.result import Result, Row, Spread, in_turn

WANTED = (0.90, 0.99)
MOSTLY = 0.5  # of the records: a method that warns there has said so
SOME = 0.05  # fewer warnings are chance


class Held(NamedTuple):
    """One record, one method."""

    inside: tuple[bool, ...]  # of each parameter that is stated
    candid: bool  # it says that its interval is not to be trusted, or refuses


def remembered(formulation: Formulation, known: dict[tuple[int, int], Rows]) -> Formulation:
    """Return a formulation that several methods share, worked out once for each replicate."""

    def rows(posed: Posed) -> Rows:
        key = (id(formulation), id(posed))
        if key not in known:
            known[key] = formulation(posed)
        return known[key]

    return rows


def estimates(record: Record, methods: Sequence[Method]) -> list[Estimate]:
    """Return the estimates of a record; linear methods share its replicates."""
    posed = posed_of(record.recording, record.testbed, Options())
    shared = any(map(linear_of, methods))
    draws = tuple(pairs(posed, Drawn(inertia=True))) if shared else ()
    known, made = dict[tuple[int, int], Rows](), list[Estimate]()
    for method in methods:
        linear = linear_of(method)
        if linear is None:
            made.append(method.run(record.recording, record.testbed, Options()))
            continue
        part = replace(linear, formulation=remembered(linear.formulation, known))
        made.append(linear_methods.estimate(method.card, part, posed, (), draws))
    return made


def held(name: Regime, seed: int) -> dict[str, Held]:
    """Return for every method of a regime whether its intervals hold the truth of one record."""
    record = regime(name, seed)
    methods = [m for m in METHODS.values() if m.card.regime == name]
    true, found = record.truth, dict[str, Held]()
    for method, estimate in zip(methods, estimates(record, methods), strict=True):
        stated = [p for p in estimate.parameters if p.name in true and np.isfinite(p.sd) and p.sd]
        inside = tuple(bool(p.low95 <= true[p.name] <= p.high95) for p in stated)
        found[method.card.name] = Held(inside, estimate.outcome.warns)
    return found


def row_of(name: str, key: str, runs: Sequence[Held]) -> Row:
    """Return the row of a method: coverage where it does not warn, and how often it warns."""
    warned = float(np.mean([run.candid for run in runs]))
    calm = [run for run in runs if not run.candid]
    inside = [each for run in calm for each in run.inside]
    share = float(np.mean(inside)) if inside else float("nan")
    low, high = share_band(WANTED, 0.95, len(calm), len(METHODS)) if calm else WANTED
    text = f"{100 * share:.1f} % of {len(inside)}" if inside else "none stated"
    text += f"; warns on {100 * warned:.0f} % of records"
    ok = warned >= 1 - SOME if not inside else low <= share <= high or warned >= MOSTLY
    return Row(f"{key} ({name})", text, f"{100 * low:.0f} to {100 * high:.0f} %, or a warning", ok)


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Estimate one record of every regime for each seed, by every method whose card names it."""
    rows = list[Row]()
    for name in REGIMES:
        runs = spread(partial(held, name), seeds)
        rows += [row_of(name, key, [run[key] for run in runs]) for key in runs[0]]
    claim = (
        f"On {len(seeds)} MuJoCo records of the regime that a method's card names, its 95 % "
        "intervals hold the truth in 90 to 99 % of cases, or its outcome says that they are not "
        "to be trusted there, and why. Coverage is that of records without such a warning."
    )
    reported = tuple(f"{name}: {text}." for name, text in REGIMES.items())
    return Result("method_intervals", claim, tuple(rows), reported)
