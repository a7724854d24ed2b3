"""How an estimate ended. Poor data is an outcome, not an error.

An outcome is made of reasons. What happened and how far to rely on the numbers follow from them,
here and nowhere else; the sentence is for people alone.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum

from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.implausible_reasons import ImplausibleReason
from equipoise.model.reasons.mass_budget_reasons import MassBudgetReason
from equipoise.model.reasons.mode_reasons import ModeReason
from equipoise.model.reasons.reason import Code, Number, Reason, Reasoned, one_reason
from equipoise.model.reasons.table_reasons import TableReason


class Trust(StrEnum):
    """How far an estimate may be relied on, from best to worst."""

    TRUSTWORTHY = "trustworthy"
    WIDENED = "widened"  # its intervals are wider than the stated noise makes them
    NOT_TRUSTWORTHY = "not_trustworthy"  # values may be used, intervals may not
    NOT_USABLE = "not_usable"


class OutcomeCode(StrEnum):
    """What happened; of several, the last of this list counts."""

    ESTIMATED = "estimated"
    PART_UNOBSERVABLE = "part_unobservable"  # some intervals are infinite
    SCALE_OPEN = "scale_open"  # ratios of inertia and centre of mass alone
    NOISE_TOO_LARGE = "noise_too_large"
    MODEL_REJECTED = "model_rejected"  # the record is not what the model makes
    IMPOSSIBLE = "impossible"  # no body can have the inertia found
    NOT_CONVERGED = "not_converged"
    NOT_ESTIMATED = "not_estimated"  # the record lacks what the method needs


WITH_NUMBERS = (OutcomeCode.ESTIMATED, OutcomeCode.PART_UNOBSERVABLE, OutcomeCode.SCALE_OPEN)
HAPPENED: Mapping[OutcomeCode, tuple[Code, ...]] = {  # where it is not ESTIMATED
    OutcomeCode.PART_UNOBSERVABLE: (Why.PART_UNOBSERVABLE, Why.DRIFT_UNOBSERVABLE),
    OutcomeCode.SCALE_OPEN: (Why.RATIOS_ONLY, Why.LINEAR_RATIOS),
    OutcomeCode.NOISE_TOO_LARGE: (Why.REGRESSOR_NOISE_TOO_LARGE,),
    OutcomeCode.MODEL_REJECTED: (
        Why.UNEXPLAINED_ATTITUDE,
        Why.UNEXPLAINED_RATE,
        TableReason.UNEXPLAINED_ON_TABLE,
        Why.TOO_MANY_EVENTS,
        Why.LAY_ON_STOP,
        Why.UNKNOWN_TORQUE,
        Why.RESIDUAL_TOO_LARGE,
        Why.FILTER_INNOVATIONS_TOO_LARGE,
        Why.TRACKER_INNOVATIONS_TOO_LARGE,
        Why.TOO_MANY_ROWS_REJECTED,
        Why.GYRO_MIRRORED,
        Why.RUNS_DISAGREE,
    ),
    OutcomeCode.IMPOSSIBLE: (Why.IMPOSSIBLE_INERTIA, Why.FILTER_DIVERGED),
    OutcomeCode.NOT_CONVERGED: (
        Why.NOT_CONVERGED,
        Why.MOTION_NOT_FOUND,
        Why.BUDGET_TOO_SMALL,
    ),
    OutcomeCode.NOT_ESTIMATED: (
        Why.TOO_FEW_RESTS,
        Why.RESTS_TOO_ROUGH,
        Why.NO_MASS_MOVES,
        Why.TOO_FEW_ROWS,
        Why.TOO_FEW_ROWS_WITHOUT_GAP,
        Why.TOO_FEW_ROWS_FOR_FILTER,
        Why.HARDLY_MOVED,
        Why.NO_CAMERA,
        TableReason.NO_POSITION,
        TableReason.BEARING_MOVES,
        Why.NO_ATTITUDE,
        Why.NO_GYRO,
        Why.NO_KNOWN_INPUT,
        Why.INERTIA_TOO_UNCERTAIN,
        Why.TOO_FEW_RUNS,
    ),
}
WIDENED = (Why.COLOURED_RESIDUAL, Why.RESIDUAL_LARGE, Why.RUNS_SCATTERED)
NOT_TRUSTWORTHY = (
    Why.BIAS_BY_NOISE,
    Why.BIAS_BY_SMOOTHING,
    Why.BIAS_BY_MODEL,
    Why.GYROSCOPIC_TORQUE_LEFT_OUT,
    Why.SWINGS_AT_REST,
    Why.RESTS_DISAGREE,
    Why.CROSS_CHECKS_DISAGREE,
    MassBudgetReason.SWINGS_CONTRADICT,
    Why.SENSOR_IMPLAUSIBLE,
    Why.BUDGET_SPENT,
    ModeReason.MASS_SWINGS,
    ImplausibleReason.INERTIA_OF_NO_BODY,
    ImplausibleReason.SWINGS_WITH_COM_ABOVE,
)
KINDS = (Why, ImplausibleReason, MassBudgetReason, ModeReason, TableReason)
CODES: Mapping[str, Code] = {str(code): code for kind in KINDS for code in kind}  # by their words


def code_of(reasons: Iterable[Reason]) -> OutcomeCode:
    """Return what happened."""
    codes = {reason.code for reason in reasons}
    found = [code for code, causes in HAPPENED.items() if codes & set(causes)]
    return found[-1] if found else OutcomeCode.ESTIMATED


def trust_of(reasons: Iterable[Reason]) -> Trust:
    """Return how far numbers with these reasons may be relied on."""
    codes = {reason.code for reason in reasons}
    if any(codes & set(HAPPENED.get(code, ())) for code in OutcomeCode if code not in WITH_NUMBERS):
        return Trust.NOT_USABLE
    if codes & set(NOT_TRUSTWORTHY):
        return Trust.NOT_TRUSTWORTHY
    return Trust.WIDENED if codes & set(WIDENED) else Trust.TRUSTWORTHY


@dataclass(frozen=True, slots=True)
class Outcome(Reasoned):
    """Why an estimate came out as it did, the main reason first."""

    reasons: tuple[Reason, ...]

    @property
    def code(self) -> OutcomeCode:
        """What happened."""
        return code_of(self.reasons)

    @property
    def trust(self) -> Trust:
        """How far the numbers may be relied on."""
        return trust_of(self.reasons)

    @property
    def usable(self) -> bool:
        """Whether the numbers may be used."""
        return self.trust is not Trust.NOT_USABLE

    @property
    def warns(self) -> bool:
        """Whether intervals, or numbers as well, are not to be relied on."""
        return self.trust in (Trust.NOT_TRUSTWORTHY, Trust.NOT_USABLE)


def outcome(code: Code, *parameters: str, **numbers: Number) -> Outcome:
    """Return the outcome of one reason; numbers are in SI."""
    return Outcome(one_reason(code, *parameters, **numbers))
