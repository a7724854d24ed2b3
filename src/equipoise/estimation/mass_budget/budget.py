"""Mass, centre of mass and inertia from parts and swings, with sd, shares and checks."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from equipoise.estimation.mass_budget.combine import Posterior, combined
from equipoise.estimation.mass_budget.oscillations import measured
from equipoise.estimation.mass_budget.part_moments import INERTIA, about_C, about_P, total
from equipoise.maths.chi_square import chi_square_chance
from equipoise.maths.complex_step import jacobian
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model import estimate as names
from equipoise.model.arrays import Bools, Complexes, Floats
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.mass_budget import (
    CENTRAL,
    MASS,
    MassBudget,
    Oscillation,
    OscillationCheck,
    PartsList,
    Share,
)
from equipoise.model.mass_properties import MassProperties, smallest_second_moment
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.mass_budget_reasons import MassBudgetReason
from equipoise.model.reasons.reason import Reason
from equipoise.model.version import __version__

RARE = 1e-3  # chosen: of chance, below which swings and parts contradict each other
ROUNDING = 1e-9  # chosen: of the trace, below which a second moment is rounding
SHOWS = 1e-6  # chosen: the share of a null direction that makes a parameter unobservable
NAMES = (MASS, *names.COM, *names.INERTIA)
UNITS = ("kg", *["m"] * 3, *["kg m2"] * 6)


def mass_budget(stated: PartsList) -> MassBudget:
    """Return mass properties from parts and swings.

    Raises InputError for a swing by gravity whose axis goes through the centre of mass.
    """
    p0, covariance, each = total(stated.parts)
    is_open = any(part.shape == "unknown" for part in stated.parts)
    posterior = combined(p0, covariance, stated.oscillations, is_open)
    return MassBudget(
        stated,
        estimate_of(stated, posterior),
        parameters(posterior, about_C, CENTRAL, UNITS[INERTIA]),
        tuple(sorted(shares(stated, p0, each), key=lambda share: -share.of_inertia)),
        tuple(check(swing, posterior.p) for swing in stated.oscillations),
    )


def estimate_of(stated: PartsList, posterior: Posterior) -> Estimate:
    """Return mass, centre of mass and inertia about P, and how far to trust them."""
    found = parameters(posterior, about_P, NAMES, UNITS)
    slopes = jacobian(about_P, posterior.p)
    is_shown = all(p.observable for p in found)
    possible = not is_shown or exists(body_of(found))
    return Estimate(
        "parts_and_swings" if stated.oscillations else "parts",
        Outcome(tuple(reasons(stated, posterior, is_shown, possible))),
        found,
        slopes @ posterior.covariance @ slopes.T,
        possible=possible,
        provenance={"version": __version__, "source": stated.source},
    )


def body_of(found: Sequence[Parameter]) -> MassProperties:
    """Return the body of mass, centre of mass and inertia about P."""
    values = np.array([p.value for p in found])
    return MassProperties(float(values[0]), values[1:4], unpack_symmetric(values[INERTIA]))


def exists(body: MassProperties) -> bool:
    """Say whether a body can have this inertia, a flat one among them."""
    inertia_C = body.inertia_C
    return smallest_second_moment(inertia_C) >= -ROUNDING * float(np.trace(inertia_C))


def parameters(
    posterior: Posterior,
    view: Callable[[Complexes], Complexes],
    of: Sequence[str],
    units: Sequence[str],
) -> tuple[Parameter, ...]:
    """Return numbers that follow from the moments, with their sd."""
    slopes = jacobian(view, posterior.p)
    values = view(posterior.p.astype(complex)).real
    sd = np.sqrt(np.einsum("ij,jk,ik->i", slopes, posterior.covariance, slopes))
    sd = np.where(observable(slopes, posterior.open), sd, np.inf)
    return tuple(
        Parameter(name, unit, float(value), float(spread), bool(np.isfinite(spread)))
        for name, unit, value, spread in zip(of, units, values, sd, strict=True)
    )


def observable(slopes: Floats, null: Floats) -> Bools:
    """Say which numbers no null direction moves."""
    moved = np.abs(slopes @ null) / np.linalg.norm(null, axis=0)
    return np.all(moved < SHOWS, axis=1)


def reasons(
    stated: PartsList, posterior: Posterior, is_shown: bool, possible: bool
) -> Iterator[Reason]:
    """Yield what the estimate is made of, and what speaks against it."""
    yield Reason(MassBudgetReason.PARTS_SUMMED, (), {"count": len(stated.parts)})
    if stated.oscillations:
        yield agreement(stated.oscillations, posterior)
    if not is_shown:
        yield Reason(Why.PART_UNOBSERVABLE)
    if not possible:
        yield Reason(Why.IMPOSSIBLE_INERTIA)


def agreement(swings: Sequence[Oscillation], posterior: Posterior) -> Reason:
    """Return whether swings and parts agree, and the swing that is most off."""
    off = [check(swing, posterior.p) for swing in swings]
    worst = max(off, key=lambda each: abs(each.off))
    numbers = {"count": len(swings), "off": abs(worst.off)}
    chance = 1.0
    if posterior.freedom > 0:
        chance = chi_square_chance(posterior.freedom, posterior.squares)
    if chance < RARE:
        return Reason(
            MassBudgetReason.SWINGS_CONTRADICT, (worst.name,), numbers | {"chance": chance}
        )
    return Reason(MassBudgetReason.SWINGS_COMBINED, (worst.name,), numbers)


def check(swing: Oscillation, p: Floats) -> OscillationCheck:
    """Return what a swing measured beside what all of it says."""
    found = measured(swing, p)
    return OscillationCheck(
        swing.name, found.moment, found.sd, found.moment + found.left, -found.left / found.sd
    )


def shares(stated: PartsList, p: Floats, each: Floats) -> Iterator[Share]:
    """Yield what each part contributes to the variances of what the parts sum to."""
    slopes = jacobian(about_P, p)
    variances = np.einsum("ij,kjl,il->ki", slopes, each, slopes)
    groups = np.column_stack(
        [variances[:, 0], variances[:, 1:4].sum(axis=1), variances[:, INERTIA].sum(axis=1)]
    )
    whole = groups.sum(axis=0)
    for part, own in zip(stated.parts, groups / np.where(whole > 0, whole, 1.0), strict=True):
        yield Share(part.name, part.mass, *map(float, own))
