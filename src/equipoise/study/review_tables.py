"""The review's Tables 2 and 3 as measured tables: its rows, what it says, and what was measured.

Its tables have pros and cons in words, its Table 1 the results that laboratories report. What is
measured here is what those words are about:

    convergence       time until com stays within a tenth of the first error (``method_run``)
    effort, memory    time of the processor, and the peak of memory, for one record
    accuracy          RMSE / bound of com
    mismodelling      bias / bound of com
    robustness        runs that failed, and runs that were confidently wrong

A row spans several methods or laws: from the best of them to the worst. Rows that the review does
not have are added below its own.

Source: da Silva et al., A review of balancing methods for satellite simulators, Acta Astronautica
2021, Tables 1 to 3; numbers in brackets are its references.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from equipoise.study.compare_laws import LawSummary
from equipoise.study.compare_methods import MethodSummary, Share
from equipoise.study.method_families import Family


class Span(NamedTuple):
    """From the best to the worst of several; nan where none is stated."""

    best: float
    worst: float


@dataclass(frozen=True, slots=True)
class Printed:
    """A row of the review: what it calls it, and what it says, in our words."""

    name: str
    says: str
    reported: str = ""  # results of hardware, Table 1


@dataclass(frozen=True, slots=True)
class MethodRow:
    """A family of Table 2, measured."""

    printed: Printed
    methods: tuple[str, ...]
    accuracy: Span
    bias: Span
    time: Span  # s
    memory: Span  # bytes
    settled: Span  # s
    failed: Share  # of all runs
    wrong: Share


@dataclass(frozen=True, slots=True)
class LawRow:
    """A kind of Table 3, measured; None where no law of the kind was run."""

    printed: Printed
    laws: tuple[str, ...]
    torque: Span  # N m, medians
    aside: Span  # m
    height: Span  # m
    time: Span  # s
    halted: Share
    false_passes: Share


NOT_THERE = "not in its table"
TABLE_2: dict[Family, Printed] = {
    "least squares": Printed(
        "LSM [15]", "converges fast; costs effort and memory; biased by mismodelling"
    ),
    "Kalman filter": Printed("KF [28]", "recursive, little memory; biased by mismodelling"),
    "extended Kalman filter": Printed(
        "EKF [33]",
        ("recursive, more accurate than linear ones; Jacobians; biased by a simplified J"),
    ),
    "unscented Kalman filter": Printed(
        "UKF [7]", "recursive, robust, no Jacobians; the most costly filter"
    ),
    "recursive": Printed("RLS (3.1.3)", NOT_THERE),
    "whole record": Printed("maximum likelihood", NOT_THERE),
}
TABLE_3: dict[Printed, tuple[str, ...]] = {
    Printed("manual [10,19,26]", "no devices; takes an expert and hours", "10 000 uN m [19,26]"): (
        "by_hand",
    ),
    Printed(
        "underactuated [7,9]",
        ("faster than by hand, masses alone; two steps, height is sensitive to mismodelling"),
        "below 50 uN m or 1 um [9]",
    ): ("underactuated", "underactuated_integral", "planar_magnetic"),
    Printed(
        "fully actuated [27,33]",
        ("faster than by hand, one step, possibly the best; needs torques about all axes"),
        "none",
    ): ("fully_actuated",),
    Printed(
        "least squares, iterated [8,16,18,19]",
        "Table 1 alone",
        "35 [8] and 2000 uN m [18]; 5 [16] and 61 um [19]",
    ): ("measure_and_move",),
    Printed("PID and L1 adaptive [22,23]", "section 4 and Table 1", "0.5 um [22,23]"): (
        "pid",
        "l1_adaptive",
    ),
    Printed("others", NOT_THERE): (
        "coarse_fine",
        "ivanov_25s",
        "impulse_feedback",
        "slew_and_measure",
        "momentum_buildup",
        "parameter_adaptive",
    ),
}


def span(values: Sequence[float | None]) -> Span:
    """Return the least and the greatest of what is stated."""
    reported = [value for value in values if value is not None and not np.isnan(value)]
    return Span(min(reported), max(reported)) if reported else Span(np.nan, np.nan)


def method_rows(methods: Sequence[MethodSummary]) -> list[MethodRow]:
    """Return Table 2, measured: a row for each family that was run."""
    rows = [(p, [m for m in methods if m.family == family]) for family, p in TABLE_2.items()]
    return [method_row(printed, found) for printed, found in rows if found]


def method_row(printed: Printed, found: Sequence[MethodSummary]) -> MethodRow:
    """Return a row of Table 2."""
    runs = sum(m.runs for m in found)
    return MethodRow(
        printed,
        tuple(m.method for m in found),
        accuracy=span([m.com.rmse for m in found]),
        bias=span([m.com.bias for m in found]),
        time=span([m.time for m in found]),
        memory=span([m.memory for m in found]),
        settled=span([m.settled for m in found]),
        failed=Share(sum(m.failed for m in found), runs),
        wrong=Share(sum(m.confident_wrong for m in found), runs),
    )


def law_rows(laws: Sequence[LawSummary]) -> list[LawRow]:
    """Return Table 3, measured; its own rows stay when none of their laws was run."""
    rows = [(p, [law for law in laws if law.law in names]) for p, names in TABLE_3.items()]
    return [law_row(p, found) for p, found in rows if found or p.reported]


def law_row(printed: Printed, found: Sequence[LawSummary]) -> LawRow:
    """Return a row of Table 3."""
    runs = sum(law.runs for law in found)
    return LawRow(
        printed,
        tuple(law.law for law in found),
        torque=span([law.left.median for law in found]),
        aside=span([law.aside.median for law in found]),
        height=span([law.height.median for law in found]),
        time=span([law.time.median for law in found]),
        halted=Share(sum(law.halted for law in found), runs),
        false_passes=Share(sum(law.false_passes for law in found), runs),
    )
