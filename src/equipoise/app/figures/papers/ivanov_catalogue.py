"""Figures 4 to 13 of Ivanov et al., by the paper's numbers; names, captions, drawings."""

from collections.abc import Iterator, Sequence

from equipoise.app.figures.catalogue import Picture, of_fit, of_move, of_tracking
from equipoise.app.figures.estimate import run_boxes
from equipoise.app.figures.estimate.run_boxes import Boxed
from equipoise.app.figures.papers import moved_attitude
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import BODY, COM, INERTIA
from equipoise.study.papers import ivanov
from equipoise.study.papers.ivanov import (
    MOVE,
    MOVED_AT,
    SESSION,
    THIRD,
    Fitted,
    changes,
    motions,
    segment,
    true_body,
)
from equipoise.study.papers.ivanov_run import IvanovRun

QUATERNION = (
    "Attitude quaternion (body to laboratory, scalar first) as the camera measures it{what}. "
    "Circles: loads are moved, in brackets by how many mm along x, y and z."
)
BOXES = (
    "Over {count} experiments (dots): median, quartiles and range of the rest within 1.5 times "
    "their distance. Dashed: the simulated truth, which is the paper's own fit."
)


def pictures_of(done: IvanovRun) -> Iterator[Picture]:
    """Yield Figs. 4 to 13."""
    yield from session_pictures(done)
    first, tracked = done.fits[0], done.tracked
    predicted = motions(first)
    if predicted is not None:
        yield from of_fit(first.recording, predicted)
    yield box_picture(done.fits)
    moves = changes(((MOVED_AT, MOVE),))
    drawn = moved_attitude.draw(tracked.recording, moves)
    yield Picture("figure10_attitude", QUATERNION.format(what=", as the tracker gets it"), drawn)
    yield from of_tracking(tracked.recording, tracked.courses, None)
    yield from of_move(tracked.recording, tracked.courses, tracked.truth)


def session_pictures(done: IvanovRun) -> Iterator[Picture]:
    """Yield Figs. 4 and 5."""
    moves = changes(SESSION)
    drawn = moved_attitude.draw(done.session, moves)
    yield Picture("figure04_session", QUATERNION.format(what=" in the whole session"), drawn)
    third = [move for move in moves if move[0] == THIRD]
    drawn = moved_attitude.draw(segment(done.session), third)
    yield Picture("figure05_segment", QUATERNION.format(what=" about the third move"), drawn)


def box_picture(fits: Sequence[Fitted]) -> Picture:
    """Return Fig. 9, both parts of it."""
    truth = dict(zip(COM, ivanov.COM, strict=True)) | dict(
        zip(INERTIA, pack_symmetric(true_body(fits[0].testbed).inertia_P), strict=True)
    )
    boxed = {name: boxed_of(name, fits, float(truth[name])) for name in BODY}
    caption = BOXES.format(count=len(fits))
    return Picture("figure09_experiments", caption, run_boxes.draw(boxed, "truth"))


def boxed_of(name: str, fits: Sequence[Fitted], true: float) -> Boxed:
    """Return one parameter over the experiments that show it."""
    estimates = [fit.estimate for fit in fits]
    values = [float(e.values((name,))[0]) for e in estimates if e.sees((name,))]
    unit = estimates[0].parameters[estimates[0].index(name)].unit
    return Boxed(values, unit, None, true)
