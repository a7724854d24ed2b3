"""Lee et al.'s findings beside ours, for both slews.

They print few numbers: when the singularity is met, and that indices are "much lower than one". How
well their estimates are is in figures; here it is the largest error of a moment and of m r.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass

import numpy as np

from equipoise.estimation.method_contract import Options
from equipoise.estimation.regression.linear_method import posed_of
from equipoise.maths.linalg import element_sizes
from equipoise.model.arrays import Floats
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.testbed import Testbed
from equipoise.model.units import KG_CM, PERCENT
from equipoise.study.papers import lee
from equipoise.study.papers.lee import Manoeuvre, singular_times, true_values
from equipoise.study.papers.lee_course import DRAWN, reported_at, rows_of
from equipoise.study.papers.paper_row import Agreement, PaperRow

MOMENTS = INERTIA[:3]
Doing = Callable[[str], AbstractContextManager[None]]  # shows what is done meanwhile
SINGULAR = (10.0, 15.0)  # s, section V
NEARLY = 1.0  # s, chosen: "about"
MUCH_LOWER = 0.5  # of one, chosen
OWN, BEST = "averaged_printed", "trajectory"


@dataclass(frozen=True, slots=True, eq=False)
class LeeRun:
    """The large slew and the small one, and the paper's findings beside them."""

    seed: int
    slews: Sequence[Manoeuvre]
    rows: tuple[PaperRow, ...]


def lee_run(testbed: Testbed, seed: int, doing: Doing) -> LeeRun:
    """Return both slews of the preset kau with what was made of them."""
    done = list[Manoeuvre]()
    for start in (lee.LARGE, lee.SMALL):
        where = f"from {start[0]:g} deg of roll"
        with doing(f"slewing {where}"):
            slew = lee.slew_from(testbed, start, seed)
        with doing(f"identifying {where}"):
            done.append(lee.judged(testbed, start, slew))
    return LeeRun(seed, done, lee_rows(done))


def lee_rows(runs: Sequence[Manoeuvre]) -> tuple[PaperRow, ...]:
    """Return the rows of the large slew and of the small one."""
    large, small = runs
    return (
        singularity_row(large),
        *(error_row("Figs. 10, 11", large, method) for method in (OWN, BEST)),
        *index_rows(large),
        *(error_row("Fig. 18", small, method) for method in (OWN, BEST)),
    )


def singularity_row(large: Manoeuvre) -> PaperRow:
    """Return when the gyros of the large slew are near their singularity."""
    found = singular_times(large.slew)
    ours = () if found is None else found
    close = bool(ours) and bool(np.all(np.abs(np.subtract(ours, SINGULAR)) <= NEARLY))
    agreement = Agreement.AGREES if close else Agreement.DIFFERS
    return PaperRow("Fig. 6", "singularity of the gyros, from and to", "s", SINGULAR, ours,
                    agreement, "gains are chosen to match; none is printed")  # fmt: skip


def error_row(place: str, run: Manoeuvre, method: str) -> PaperRow:
    """Return the largest errors of moments and of m r by a method."""
    ours = (largest_error(run, method, MOMENTS), largest_error(run, method, COM))
    quantity = f"largest error of a moment and of m r, {method}, from {run.start[0]:g} deg"
    return PaperRow(place, quantity, "%", (), ours, Agreement.SHOWN,
                    "as their figures: by curves alone")  # fmt: skip


def largest_error(run: Manoeuvre, method: str, names: Sequence[str]) -> float:
    """Return the largest error of some parameters, percent of sqrt(J_ii J_jj) or of m r itself."""
    estimate, truth = run.estimates[method], true_values(run.testbed)
    sizes = dict(zip(INERTIA, element_sizes(run.testbed.body.inertia_P), strict=True))
    errors = [
        abs(estimate.values((name,))[0] - truth[name]) / sizes.get(name, abs(truth[name]))
        for name in names
    ]
    return float(max(errors)) / PERCENT


def index_rows(large: Manoeuvre) -> tuple[PaperRow, ...]:
    """Return the error indices at the end of the large slew, of the printed rows."""
    rows = rows_of(DRAWN[0], posed_of(large.slew.recording, large.testbed, Options()))
    _, total, parameter = reported_at(rows, float(rows.t[-1]))
    at = dict(zip(rows.names, parameter, strict=True))
    mass = large.testbed.body.mass / KG_CM
    units = "it has the unit of its parameter, and grows with the rows (erratum L8)"
    return (
        _index("Fig. 13", "total error index", "", np.array([total]), "far below one"),
        _index("Fig. 14", "error index of the moments", "kg m2", _of(at, MOMENTS), units),
        _index("Fig. 15", "error index of the products", "kg m2", _of(at, INERTIA[3:]), units),
        _index("Fig. 16", "error index of m r", "kg cm", mass * _of(at, COM), units),
    )


def _of(at: Mapping[str, float], names: Sequence[str]) -> Floats:
    return np.array([at[name] for name in names])


def _index(place: str, quantity: str, unit: str, ours: Floats, why: str) -> PaperRow:
    agreement = Agreement.AGREES if bool(np.all(ours < MUCH_LOWER)) else Agreement.DIFFERS
    return PaperRow(place, f"{quantity}, much lower than", unit, (1.0,),
                    tuple(map(float, ours)), agreement, why)  # fmt: skip
