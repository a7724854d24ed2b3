"""One observation: what a recording can show at best, and what each filter can see of it."""

from collections.abc import Sequence
from dataclasses import dataclass

from equipoise.estimation.information.filter_observability import FilterView, filters_along
from equipoise.estimation.information.fisher_information import Observability, information_along
from equipoise.estimation.information.reference_motion import followed
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.trajectory import params_of
from equipoise.model.presentation import Shown
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.clean_record import sound


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Observation(Shown):
    """What a recording can show: the Cramer-Rao bound of each parameter, and filter by filter."""

    testbed: Testbed
    recording: Recording
    bounds: Observability
    filters: Sequence[FilterView]


def run(recording: Recording, testbed: Testbed, options: Options) -> Observation:
    """Return what a recording that fits the testbed can show; nothing is estimated."""
    clean, as_recorded = sound(recording, testbed)
    motion = followed(clean, as_recorded, params_of(testbed, options))
    return Observation(testbed, recording, information_along(motion), filters_along(motion))
