"""What da Silva et al. (2021) say of methods and laws, Tables 2 and 3, as measured ratios.

The review has pros and cons in words. Each that two rows of a table decide is a ratio here, of the
best of a family to the best of another; below one it is as the review says.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from equipoise.study.compare_laws import LawSummary
from equipoise.study.compare_methods import MethodSummary
from equipoise.study.papers.paper_row import Agreement, PaperRow
from equipoise.study.review_tables import LawRow, MethodRow, law_rows, method_rows

LSM, KF, EKF, UKF = "LSM [15]", "KF [28]", "EKF [33]", "UKF [7]"
UNDER, FULLY = "underactuated [7,9]", "fully actuated [27,33]"


@dataclass(frozen=True, slots=True)
class Claim:
    """A quantity of which the review says that the first row has less than the second."""

    what: str
    less: str  # row
    more: str  # row
    field: str  # of the row


OF_METHODS = (
    Claim("memory: the Kalman filter's to that of least squares", KF, LSM, "memory"),
    Claim("error: the extended Kalman filter's to the linear one's", EKF, KF, "accuracy"),
    Claim("effort: the extended Kalman filter's to the unscented one's", EKF, UKF, "time"),
    Claim("error: the unscented filter's to the linear one's", UKF, KF, "accuracy"),
)
OF_LAWS = (Claim("torque: fully actuated to underactuated", FULLY, UNDER, "torque"),)


def method_claims(methods: Sequence[MethodSummary]) -> tuple[PaperRow, ...]:
    """Return the claims of Table 2."""
    rows = {row.printed.name: row for row in method_rows(methods)}
    return tuple(ratio_row("Table 2", claim, rows) for claim in OF_METHODS)


def law_claims(laws: Sequence[LawSummary]) -> tuple[PaperRow, ...]:
    """Return the claims of Table 3."""
    rows = {row.printed.name: row for row in law_rows(laws)}
    return tuple(ratio_row("Table 3", claim, rows) for claim in OF_LAWS)


def ratio_row(place: str, claim: Claim, rows: Mapping[str, MethodRow | LawRow]) -> PaperRow:
    """Return a claim with its ratio, best to best."""
    ratio = best(rows[claim.less], claim.field) / best(rows[claim.more], claim.field)
    agreement = Agreement.AGREES if ratio < 1.0 else Agreement.DIFFERS
    return PaperRow(place, claim.what, "", (1.0,), (ratio,), agreement,
                    "below one, the review says")  # fmt: skip


def best(row: MethodRow | LawRow, field: str) -> float:
    """Return the best of a row in some respect."""
    return float(getattr(row, field).best)
