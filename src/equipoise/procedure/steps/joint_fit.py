"""The knowledge of a procedure so far: the whole record, and the one fit to it."""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.sliding_masses import shift_by_travel
from equipoise.assessment.record_checks.mass_flicker import without_flicker
from equipoise.dynamics.lamp_warmth import warms
from equipoise.estimation.model_selection.survey_reasons import reasons_of_added
from equipoise.estimation.model_selection.term_support import is_supported
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.fit_estimate import conclude, leaves_more, spread_of
from equipoise.estimation.output_error.segment_jumps import UNCUT
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.parameters.fit_parameters import with_errors_of
from equipoise.estimation.search_budget import UNLIMITED, Budget, cut_short
from equipoise.model.arrays import Bools, Floats, Matrix3, Vector3
from equipoise.model.estimate import Estimate
from equipoise.model.outcome import Outcome
from equipoise.model.recording import Recording, join
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import GROUPS, among, typical_sizes, typical_torques
from equipoise.procedure.steps.process_noise import process_noise

DRIFT, THERMAL = GROUPS["drift"], GROUPS["thermal"]
CONSIDERED = (*GROUPS["viscous"], *DRIFT, *THERMAL)  # there is some of these on every bench
LONGER = 1.2  # times, chosen: nine searches from nothing in a record that grows fivefold
AS_WELL = 0.5  # of half a chi-square, chosen: what does not tell two optima apart
ANOTHER = (*GROUPS["constant"], *GROUPS["swirl"], *GROUPS["quadratic"])  # on some


@dataclass(frozen=True, slots=True, eq=False)
class Knowledge:
    """The record so far and its estimate."""

    recording: Recording
    fitted: Fitted
    estimate: Estimate
    found: tuple[str, ...] = ()  # torques that nobody declared and the record supports
    searched: float = 0.0  # s of record when the search last began from nothing

    @property
    def com(self) -> Vector3:
        """Centre of mass with the masses as they stand, m."""
        return self.estimate.values(self.standing)

    @property
    def covariance(self) -> Matrix3:
        """Covariance of ``com``, m^2."""
        return self.estimate.covariance_of(self.standing)

    @property
    def sd(self) -> Vector3:
        """Standard deviations of ``com``, m."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def standing(self) -> tuple[str, ...]:
        """Names of the centre of mass with the masses as they stand."""
        return self.estimate.standing

    @property
    def displacement(self) -> Floats:
        """Reported displacements at the end, m."""
        masses = self.recording.masses
        return np.zeros(0) if masses is None else masses.values[-1]


@dataclass(frozen=True, slots=True, eq=False)
class FitSetup:
    """A record to be fitted, and what may be in the model beside what is found."""

    recording: Recording
    testbed: Testbed
    considered: tuple[str, ...]
    allowed: Budget
    wanders: bool = False  # air plays and com walks, as the testbed states it


def as_if_stiff(testbed: Testbed) -> Testbed:
    """Return the testbed without elastic sag among what is estimated.

    At small tilts its effect is that of another centre of mass: that of a stiff platform which
    behaves alike.
    """
    return testbed.without("sag")


def as_it_sags(knowledge: Knowledge, testbed: Testbed) -> Knowledge:
    """Return the knowledge with elastic sag among what is estimated, where the testbed declares it.

    As large as benches have it: what the record's tilts do not show of it stays as uncertain, and
    nothing is hidden for that. The search begins anew, as damping and drift stood for the sag where
    it ended before.
    """
    sag, recording = testbed.in_group("sag"), knowledge.recording
    if not sag:
        return knowledge
    setup = setup_for(recording, testbed, UNLIMITED)
    known = explained(replace(setup, considered=(*setup.considered, *sag)), None)
    parameters, covariance = spread_of(known.fitted)
    return replace(
        known, estimate=replace(known.estimate, parameters=parameters, covariance=covariance)
    )


def learn(
    before: Knowledge | None,
    fresh: Recording,
    testbed: Testbed,
    allowed: Budget = UNLIMITED,
) -> Knowledge:
    """Return the knowledge with a fresh record added; the testbed's values are the prior.

    Torques that are ``considered`` are in the model, as large as benches have them: what the record
    does not show of them widens intervals. Once it supports a group, that is found, and from then
    on as open as those that the testbed declares. Warmth is among them where a temperature changed.
    Before one is, or where more than noise is left, all others are considered beside it: a steady
    torque turns a platform as if its damping were negative. Where they explain the record as well,
    none is found, and all of them widen the intervals.
    Cannot tell them from torques that are none of these.
    """
    testbed = as_if_stiff(testbed)
    fresh = replace(fresh, masses=without_flicker(fresh, testbed))
    recording = fresh if before is None else join(before.recording, fresh)
    known = explained(setup_for(recording, testbed, allowed), before)
    searched, (start, end) = 0.0 if before is None else before.searched, recording.span
    known = replace(known, searched=searched)
    return known if end - start < LONGER * searched else settled(known, testbed, allowed)


def settled(known: Knowledge, testbed: Testbed, allowed: Budget = UNLIMITED) -> Knowledge:
    """Return what to conclude from: the same, unless a search from nothing explains more now.

    What a short record supports can be a false optimum: a spin that slows by damping, with another
    inertia. It stays one as the record grows. What such a search does not support any more was not
    there.
    """
    seconds = known.recording.span[1] - known.recording.span[0]
    if not known.found or seconds <= known.searched:
        return known
    setup = setup_for(known.recording, testbed, allowed)
    other = fitted_in(setup, None, known.found)
    if not (other.fitted.converged and other.fitted.at.cost < known.fitted.at.cost - AS_WELL):
        return replace(known, searched=seconds)
    kept = shown_by(other.estimate, known.found)
    return replace(fitted_in(setup, other, kept), searched=seconds)


def setup_for(recording: Recording, testbed: Testbed, allowed: Budget) -> FitSetup:
    """Return how to fit a record as of a stiff platform; warmth counts where it did not stay so."""
    stiff = as_if_stiff(testbed)
    warm = warms(recording, stiff)
    considered = tuple(term for term in CONSIDERED if warm or term not in THERMAL)
    return FitSetup(recording, stiff, considered, allowed)


def explained(setup: FitSetup, before: Knowledge | None) -> Knowledge:
    """Return the knowledge from a record, with the torques that it needs; see ``learn``."""
    knowledge = fitted_in(setup, before, () if before is None else before.found)
    promises, left = bool(supported(knowledge, setup)), knowledge.estimate.residual
    assert left is not None
    if not (promises or leaves_more(left)):
        return knowledge
    every = replace(setup, considered=among((*setup.considered, *ANOTHER)))
    beside = fitted_in(every, knowledge, knowledge.found)
    shown = supported(beside, every)
    if shown:
        return fitted_in(setup, knowledge, among((*knowledge.found, *shown)))
    return beside if promises else knowledge


def learn_alone(fresh: Recording, testbed: Testbed, allowed: Budget = UNLIMITED) -> Knowledge:
    """Return what a record shows by itself: the testbed's priors, and its process noise."""
    testbed = as_if_stiff(testbed)
    recording = replace(fresh, masses=without_flicker(fresh, testbed))
    return fitted_in(FitSetup(recording, testbed, (), allowed, wanders=True), None, ())


def supported(knowledge: Knowledge, setup: FitSetup) -> tuple[str, ...]:
    """Return the considered terms, neither declared nor found yet, that the record supports.

    Sag is none of them: it keeps its prior, as tilts of a balancing never show all of it.
    """
    unknown = {*setup.considered} - {*setup.testbed.disturbances, *knowledge.found}
    groups = [group for name, group in GROUPS.items() if set(group) <= unknown and name != "sag"]
    return shown_by(knowledge.estimate, tuple(term for group in groups for term in group))


def shown_by(estimate: Estimate, terms: tuple[str, ...]) -> tuple[str, ...]:
    """Return those of whole groups of terms that an estimate supports."""
    groups = [group for group in GROUPS.values() if set(group) <= {*terms}]
    shown = [group for group in groups if is_supported(estimate, group, typical_sizes(group))]
    return tuple(term for group in shown for term in group)


def params_of(setup: FitSetup, found: tuple[str, ...]) -> trajectory.Params:
    """Return the options of a fit with torques that are declared, found, or else considered."""
    open_terms = {*setup.testbed.disturbances, *found}
    sds = typical_torques(among({*setup.considered} - open_terms))
    budget, terms = setup.allowed.renewed(), among({*open_terms, *setup.considered})
    jumps = process_noise(setup.testbed, setup.recording.span) if setup.wanders else UNCUT
    return trajectory.Params(terms, (), jumps, use_prior=True, torque_sds=sds, budget=budget)


def fitted_in(setup: FitSetup, before: Knowledge | None, found: tuple[str, ...]) -> Knowledge:
    """Return the knowledge from a whole record, from where the search stood ``before``."""
    recording, testbed = setup.recording, setup.testbed
    params, guess = params_of(setup, found), None
    if before is not None:
        layout = trajectory.layout_of(recording, testbed, params)
        guess = with_errors_of(before.fitted.point, before.fitted.problem.layout, layout)
    fitted = trajectory.fit(recording, testbed, params, guess)
    estimate = conclude(fitted, trajectory.METHOD, recording)
    if found and estimate.outcome.usable:
        reasons = (*estimate.outcome.reasons, *reasons_of_added(found))
        estimate = replace(estimate, outcome=Outcome(reasons))
    return Knowledge(recording, fitted, cut_short(estimate, params.budget.unfinished), found)


def without_stops(knowledge: Knowledge, testbed: Testbed, moving: Bools) -> tuple[Vector3, Matrix3]:
    """Return ``com`` and its covariance (m, m^2) less the stops' errors of masses about to move.

    They leave with the masses. The fit estimates them in part, and they are part of ``com``.
    """
    estimate = knowledge.estimate
    gain = shift_by_travel(testbed)
    rows = np.eye(len(estimate.parameters))[[estimate.index(name) for name in knowledge.standing]]
    for i in np.flatnonzero(moving):
        for error in stops_of(estimate, testbed.masses[i].name)[-1:]:
            rows[:, error] -= gain[i]
    values = np.array([parameter.value for parameter in estimate.parameters])
    return rows @ values, rows @ estimate.covariance @ rows.T


def stood(knowledge: Knowledge, testbed: Testbed) -> Floats:
    """Return by how much each mass stands off where it was sent (m), as far as it is known."""
    estimate = knowledge.estimate
    last = [stops_of(estimate, name)[-1:] for name in testbed.mass_names]
    errors = (sum(estimate.parameters[k].value for k in found) for found in last)
    return np.array([*errors], dtype=np.float64)


def stops_of(estimate: Estimate, mass: str) -> list[int]:
    """Return where the errors of a mass's stops are among the parameters, the last one last."""
    names = [parameter.name for parameter in estimate.parameters]
    return [k for k, name in enumerate(names) if name.rpartition("_")[0] == f"error_{mass}"]
