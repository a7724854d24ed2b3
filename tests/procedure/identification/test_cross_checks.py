"""Cross-checks of quiet records made by MuJoCo: what they say, whether they count, what follows."""

import numpy as np
import pytest

from equipoise.app.views.assess_tables import fit_row
from equipoise.estimation.method_contract import Options
from equipoise.estimation.regression.linear_method import posed_of
from equipoise.model.estimate import COM, Estimate, Parameter
from equipoise.model.event import Event
from equipoise.model.outcome import outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.units import MINUTE
from equipoise.procedure.identification import assess as assessment
from equipoise.procedure.identification.assess import AssessOptions, assess
from equipoise.procedure.identification.cross_checks import (
    CheckedFit,
    checked,
    cross_checks,
)
from equipoise.procedure.identification.swing_metrics import as_one_body, periods, swing_metrics
from equipoise.procedure.steps.clean_record import sound
from tests.support import thorough
from tests.support.quiet_records import lowered, quiet

SEEDS = range(thorough.count(30, 2))
SPIN = 42.0  # deg/s: a turn in 8.57 s
TOUCH = Event("impulse", 3.0, 0.1, np.full(3, 1e-4), 1e-10 * np.eye(3), 50.0)
EXPLAINED = outcome(EstimateReason.EXPLAINED_ATTITUDE, attitude_rms=1e-3)


def assessed(record, testbed, **requested):
    """Return the assessment of a record, and its last step."""
    procedure = assess(record, testbed, AssessOptions(**requested))
    steps = []
    while True:
        try:
            steps.append(next(procedure))
        except StopIteration as end:
            return end.value, steps[-1]


# --- Swings -------------------------------------------------------------------------------------


def swings_of(case, minute):
    """Return the heights by the swings of a minute, J as it is."""
    posed = posed_of(*as_one_body(*sound(minute, case.known)), Options())
    return periods(posed)[0]


def test_a_spin_of_42_deg_s_is_no_swing():
    """Nor is a harmonic: nothing within half of what a minute resolves, lean of the camera or not.

    And each height is the truth's along the vertical, within four of its own sd.
    """
    lines, off = np.array([1, 2, 3]) * SPIN / 360.0, []
    for seed in range(thorough.count(60, 4)):
        case = quiet(seed, SPIN)
        for minute in case.minutes:
            for each in swings_of(case, minute):
                assert np.abs(each.swing.frequency - lines).min() > 0.5 / MINUTE, seed
                true = case.known.weight * each.down @ case.platform.com
                off.append((each.moment - true) / each.sd)
    assert len(off) > len(SEEDS)
    assert np.abs(off).max() < 4.0
    assert np.mean(np.abs(off) < 1.96) > 0.9


# --- What a cross-check comes to ----------------------------------------------------------------


@pytest.fixture(scope="module")
def metrics():
    """The metrics of a minute, J as it is, and the platform."""
    case = quiet(1, SPIN)
    return swing_metrics(*sound(case.minutes[0], case.known)), case


def fit_at(case, scale=1.0, terms=(), events=()):
    """Return what a fit would say that found com to 0.1 um, ``scale`` times the truth."""
    parameters = tuple(
        Parameter(name, "m", float(x), 1e-7) for name, x in zip(COM, case.platform.com, strict=True)
    ) + tuple(Parameter(term, "", 0.0, 1.0) for term in terms)
    size = len(parameters)
    estimate = Estimate("made", EXPLAINED, parameters, 1e-14 * np.eye(size), events=events)
    return CheckedFit(estimate, scale * case.platform.com, 1e-14 * np.eye(3), case.known.weight)


def test_cross_checks_of_the_truth_count_and_agree(metrics):
    found, case = metrics
    checks = cross_checks(found, fit_at(case, terms=("viscous_z",)))
    assert {check.metric for check in checks} >= {"torque", "energy", "slow swing"}
    assert [check.metric for check in checks if check.disagrees or not check.counts] == []
    estimate = fit_at(case).estimate
    assert checked(estimate, checks) is estimate


def test_one_that_disagrees_makes_the_estimate_not_trustworthy(metrics):
    """A height 10 % off: the slow swing knows it to a percent, torque to a quarter."""
    found, case = metrics
    fit = fit_at(case, scale=1.1)
    checks = {check.metric.value: check for check in cross_checks(found, fit)}
    assert checks["slow swing"].disagrees
    assert not checks["torque"].disagrees
    after = checked(fit.estimate, tuple(checks.values())).outcome
    assert (after.trust, after.usable) == ("not_trustworthy", True)
    reason = after.reasons[-1]
    assert "slow swing" in reason.parameters
    assert reason.numbers["off"] == checks["slow swing"].found.off > 5.0
    assert after.reasons[:-1] == EXPLAINED.reasons


@pytest.mark.parametrize(
    ("model", "code", "named"),
    [
        ({"terms": ("sag_xx", "viscous_x")}, "cross_check_leaves_out", "sag_xx"),
        ({"terms": ("hanging_sag",)}, "cross_check_leaves_out", "hanging_sag"),
        (
            {"events": (TOUCH,)},
            "cross_check_across_events",
            "",
        ),
    ],
)
def test_one_that_leaves_out_what_the_fit_found_does_not_count(metrics, model, code, named):
    """However much it is off."""
    found, case = metrics
    fit = fit_at(case, scale=2.0, **model)
    checks = cross_checks(found, fit)
    assert {check.code for check in checks} == {code}
    assert not any(check.counts or check.disagrees for check in checks)
    assert named in checks[0].sentence
    assert checked(fit.estimate, checks).outcome.trust == "trustworthy"


# --- Whole assessments --------------------------------------------------------------------------


def shown(cell):
    """Return value and sd as the table shows them."""
    value, sd = cell.split(" ± ")
    return float(value), float(sd)


def test_minutes_of_one_record_agree_within_what_is_shown_and_hold_the_truth():
    """The sd of the table, which with the inertia known was 5 to 200 times too small.

    The inertia of the testbed is drawn about the truth, as its sd says, once for both minutes.
    """
    off, apiece = [], []
    for seed in SEEDS:
        case, rows = quiet(seed), []
        for minute in case.minutes:
            found, _ = assessed(minute, case.testbed)
            assert found.estimate.outcome.trust in ("trustworthy", "widened"), seed
            rows.append(np.array([shown(cell) for cell in fit_row(found).cells[1:4]]))
        off += [(row[:, 0] - 1e6 * case.platform.com) / row[:, 1] for row in rows]
        (one, sd), (other, other_sd) = rows[0].T, rows[1].T
        apiece.append((one - other) / np.hypot(sd, other_sd))
    assert np.abs(apiece).max() < 3.0
    assert np.abs(off).max() < 4.0
    assert np.mean(np.abs(off) < 1.96) > (0.92 if thorough.THOROUGH else 0.8)


def test_a_wrong_fit_that_explains_the_record_meets_no_requirement(monkeypatch):
    case = quiet(1, SPIN)
    wanted = {"require_offset": 1e-3, "require_torque": 1.0}
    right, step = assessed(case.minutes[0], case.testbed, **wanted)
    assert step.verdict.passed
    assert right.estimate.outcome.trust == "trustworthy"
    monkeypatch.setattr(assessment, "fit_of", lowered)
    wrong, step = assessed(case.minutes[0], case.testbed, **wanted)
    assert wrong.estimate.outcome.trust == "not_trustworthy"
    assert wrong.judged == ()
    assert step.verdict.outcome == "undecided"
    codes = [reason.code for reason in step.verdict.reasons]
    assert codes[0] == "estimate_unusable"
    assert codes[-1] == "cross_checks_disagree"
