"""Every verdict that can pass goes through the one rule, and has a trial against the truth."""

import ast
from pathlib import Path

import pytest

from equipoise.model.criterion import CRITERIA, Interval, VerdictOutcome, decided, jointly
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.verdict import OUTCOMES
from tests.support import thorough
from verification import verdict_trials, verdicts

SOURCE = Path(__file__).parents[2] / "src/equipoise"
NOT_A_CLAIM = {
    VerdictReason.NOTHING_REQUIRED,  # there was nothing to prove
    VerdictReason.RUNS_AGREE,  # nothing contradicts: a test of fit proves no limit
    VerdictReason.EVERY_RUN_PASSED,  # a count of verdicts, each of which went through the rule
}
PASSING = {code for code in OUTCOMES[VerdictOutcome.PASSED] if code not in NOT_A_CLAIM}


def verdict_codes_in(path: Path) -> set[str]:
    """Names of verdicts' codes in a module."""
    text = path.read_text("utf-8")
    if "VerdictReason" not in text:
        return set()
    tree = ast.parse(text)
    called = {
        alias.asname or alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
        if alias.name == "VerdictReason"
    }
    return {
        node.attr
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute)
        and isinstance(node.value, ast.Name)
        and node.value.id in called
    }


@pytest.mark.parametrize(
    ("low", "high", "outcome"),
    [
        (0.2, 1.0, "passed"),  # the upper bound is the limit
        (0.2, 1.01, "undecided"),
        (1.0, 1.2, "undecided"),  # the lower bound is the limit
        (1.01, 1.2, "failed"),
        (float("nan"), float("nan"), "undecided"),
    ],
)
def test_bounds_decide(low, high, outcome):
    assert decided(Interval(low, high), 1.0) == outcome


@pytest.mark.parametrize(
    ("worst", "outcome"),
    [((0.1, 0.9), "passed"), ((0.5, 1.1), "undecided"), ((1.1, 1.3), "failed")],
)
def test_claims_that_hold_together_are_as_good_as_the_worst(worst, outcome):
    found = jointly([Interval(0.0, 0.2), Interval(*worst), Interval(0.3, 0.8)])
    assert decided(found, 1.0) == outcome


def test_every_code_that_passes_is_the_proof_of_one_criterion():
    assert sorted(each.proven for each in CRITERIA) == sorted(PASSING)


def test_no_code_that_passes_is_named_but_where_the_rule_is():
    """A verdict that passes by a comparison of its own would have to name its code."""
    names = {code.name for code in PASSING}
    naming = {
        str(path.relative_to(SOURCE))
        for path in SOURCE.rglob("*.py")
        if names & verdict_codes_in(path)
    }
    assert naming == {"model/criterion.py"}


def test_every_module_that_gives_a_verdict_has_a_trial():
    modules = {name.split(",")[0] for name in verdict_trials.TRIALS}
    assert verdict_trials.judging_modules() == modules


def test_every_criterion_has_a_trial():
    assert {trial.criterion for trial in verdict_trials.TRIALS.values()} == set(CRITERIA)


# The others take long; ``test_procedures`` has the one of balancing.
QUICK = ("procedure.balancing.balance_manually", "procedure.identification.requirement, torque")


@pytest.mark.parametrize("name", [*verdict_trials.TRIALS] if thorough.THOROUGH else QUICK)
def test_a_verdict_is_rarely_wrong_and_mostly_decides(name):
    """A few uses: as many false passes as 2.5 % leaves in all but one of 1000 such tests."""
    rows = verdicts.trial_rows(name, range(thorough.count(20, 4)))
    assert [row for row in rows if not row.ok] == []
