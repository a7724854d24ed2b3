"""Identify: mass properties from a recording."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import overload

from equipoise.app.arguments import inputs
from equipoise.app.arguments.options import BUDGET_S
from equipoise.app.runs.recordings import identification, joint_identification
from equipoise.app.runs.recordings.identification import Identification
from equipoise.app.runs.recordings.joint_identification import JointIdentification
from equipoise.app.runs.recordings.plausible_record import Gate
from equipoise.app.runs.waiting import passing_on
from equipoise.model.errors import InputError
from equipoise.model.step import Step
from equipoise.procedure.identification.identify import IdentifyOptions

Recordings = list[inputs.AnyRecording] | tuple[inputs.AnyRecording, ...]


@overload
def identify(
    recording: inputs.AnyRecording,
    testbed: inputs.AnyTestbed,
    *,
    method: str = "auto",
    terms: Sequence[str] = (),
    hold: Sequence[str] = (),
    use_prior: bool = False,
    robust: bool = False,
    force: bool = False,
    budget_s: float = BUDGET_S,
    plan: inputs.AnyPlan | None = None,
    on_step: Callable[[Step], None] | None = None,
) -> Identification: ...


@overload
def identify(
    recording: Recordings,
    testbed: inputs.AnyTestbed,
    *,
    method: str = "auto",
    terms: Sequence[str] = (),
    hold: Sequence[str] = (),
    use_prior: bool = False,
    robust: bool = False,
    force: bool = False,
    budget_s: float = BUDGET_S,
    plan: None = None,
    on_step: Callable[[Step], None] | None = None,
) -> JointIdentification: ...


def identify(
    recording: inputs.AnyRecording | Recordings,
    testbed: inputs.AnyTestbed,
    *,
    method: str = "auto",
    terms: Sequence[str] = (),
    hold: Sequence[str] = (),
    use_prior: bool = False,
    robust: bool = False,
    force: bool = False,
    budget_s: float = BUDGET_S,
    plan: inputs.AnyPlan | None = None,
    on_step: Callable[[Step], None] | None = None,
) -> Identification | JointIdentification:
    """Estimate centre of mass (m) and inertia about P (kg m^2), and say what cannot be observed.

    The result has ``estimate``, ``steps``, ``findings`` and ``recording``. Whether the estimate is
    usable is its ``outcome``; poor data raise nothing. Of several recordings of one platform, in a
    list or tuple, it is their joint ``estimate``, with ``runs`` and the ``verdict`` on whether they
    agree.

    Parameters
    ----------
    recording
        Recording, or its file; or a list of them, which are fitted jointly.
    testbed
        Testbed, its file, or a preset's name.
    method
        auto, or one of ``methods()``.
    terms
        Torques to estimate too: viscous, quadratic, constant, swirl, sag or drift.
    hold
        Parameters to keep at the testbed's value, such as inertia_P_zz.
    use_prior
        Use the testbed's inertia and centre of mass with their sd; this fixes an open scale.
    robust
        Give outliers less weight.
    force
        Fit a record that cannot be what it says it is, such as one with a gyro in another unit.
    budget_s
        Processor time that a search may take, s; it ends then with the best that it has found.
    plan
        Plan that the recording was made by, or its file; its predictions are compared.
    on_step
        Called with each step as it is done.

    Raises
    ------
    InputError
        For files that cannot be read, unknown names, and a recording that does not fit the testbed.
    Implausible
        For a record that no estimate can stand, with what mends it; not if ``force`` is set.
    """
    bed = inputs.testbed_from(testbed)
    requested = inputs.options_from(terms, hold, use_prior, robust)
    budget = inputs.budget_from(budget_s)
    planned = None if plan is None else inputs.plan_from(plan, bed)
    options = IdentifyOptions(method, requested.terms, requested.hold, use_prior, robust, budget)
    if isinstance(recording, list | tuple):
        if plan is not None:
            raise InputError(
                "plan", "several recordings", "the recording that was made by the plan"
            )
        several = [inputs.recording_from(each, bed) for each in recording]
        return joint_identification.run(several, bed, options, passing_on(on_step), Gate(force))
    rows = inputs.recording_from(recording, bed)
    done = identification.run(rows, bed, options, passing_on(on_step), Gate(force))
    return replace(done, plan=planned)
