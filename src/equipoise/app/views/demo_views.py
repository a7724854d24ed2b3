"""The demonstration as a report: the balancing with the identification before it."""

from collections.abc import Mapping
from dataclasses import replace

from equipoise.app.figures.catalogue import Picture, of_fit, of_move, of_tracking
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.run_record import Account
from equipoise.app.runs.demonstration import GOAL, DemoCourses, Demonstration
from equipoise.app.views.balance_views import account_of as account_of_balancing
from equipoise.app.views.balance_views import pictures_of, wanted
from equipoise.model.step import Step


def account_of(shown: Demonstration, seed: int, courses: DemoCourses) -> Account:
    """Return the report."""
    account = account_of_balancing(shown.balancing, seed, courses.balanced)
    return replace(
        account,
        title="From unknown and unbalanced to identified, balanced and verified",
        chapters={"Identify": shown.identified, "Balance": shown.balancing.steps},
        estimate=shown.estimate,
        pictures=pictures(shown, courses),
        step_pictures=_pictures_of_steps(shown, courses),
    )


def _pictures_of_steps(shown: Demonstration, courses: DemoCourses) -> Mapping[Step, Picture]:
    bed, first = shown.balancing.testbed, len(shown.identified) + 1
    identified = Frame(bed, at_home=True, motions=courses.identified.steps)
    balanced = Frame(bed, wanted(GOAL), motions=courses.balanced.steps)
    return {
        **pictures_of_steps(shown.identified, identified),
        **pictures_of_steps(shown.balancing.steps, balanced, first),
    }


def pictures(shown: Demonstration, courses: DemoCourses) -> list[Picture]:
    """Return figures 6, 7, 8, 11, 12, 13, 14 and 15."""
    bed, recording, along = shown.balancing.testbed, shown.recording, courses.identified
    fit = () if along.fit is None else of_fit(recording, bed, along.fit)
    moved = () if along.tracked is None else of_move(recording, along.tracked, shown.truth)
    return [
        *fit,
        *of_tracking(courses.still, courses.tracked, shown.truth[1][0]),
        *moved,
        *pictures_of(shown.balancing, courses.balanced),
    ]
