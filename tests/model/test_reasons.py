"""Codes and their sentences: complete, distinct, each of use, and none read by a program."""

import ast
import importlib
import json
import pickle
import pkgutil
import re
import string
from pathlib import Path

import pytest

from equipoise.model import reasons
from equipoise.model.outcome import (
    HAPPENED,
    Outcome,
    OutcomeCode,
    Trust,
    code_of,
    outcome,
    trust_of,
)
from equipoise.model.reasons.data_reasons import Unexplained
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.reason import UNITS, Code, Quantity, Reason, distinct, one_reason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.units import DEG
from equipoise.model.verdict import OUTCOMES, Verdict, VerdictOutcome

PACKAGE = Path(reasons.__file__).parents[2]
PRIVATE = (
    "told", "tell", "tells", "seen", "see", "sees", "felt", "believed", "belief", "heard", "asked",
    "asking", "telling", "apart", "beforehand", "lone", "strangers", "far", "looked", "looks",
    "candour",
)  # fmt: skip
ALLOWED = ("cannot tell", "they look like")  # of a verdict's outcome; of appearance
WORDS, MEAN = 25, 18  # in one sentence, numbers and units of one letter aside
LISTS = {"names", "both", "choices", "rest"}


def enumerations():
    """Return every enumeration of codes in the room."""
    for found in pkgutil.iter_modules(reasons.__path__, f"{reasons.__name__}."):
        module = importlib.import_module(found.name)
        for thing in vars(module).values():
            own = isinstance(thing, type) and thing.__module__ == found.name
            if own and issubclass(thing, Code) and thing is not Code:
                yield thing


CODES = [code for each in enumerations() for code in each]


def fields(code):
    """Return the places of a template: name, and format."""
    return [(name, spec) for _, name, spec, _ in string.Formatter().parse(code.template) if name]


def example(code):
    """Return a reason with all that its template needs."""
    names = [name for name, _ in fields(code)]
    parameters = [
        f"x{k}" for k in range(1 + max((int(n) for n in names if n.isdigit()), default=0))
    ]
    for _, spec in fields(code):
        if named := re.match(r"\{(\d)\} ", spec):  # a parameter names the unit
            parameters[int(named[1])] = "um"
    numbers = {n: 1.25 for n in names if not n.isdigit() and n not in LISTS}
    return Reason(code, tuple(parameters), numbers)


def plain_words(text):
    """Return the words of a sentence, those of phrases that are allowed left out."""
    plain = text.lower()
    for phrase in ALLOWED:
        plain = plain.replace(phrase, "")
    return set(re.findall(r"[a-z]+", plain))


def test_every_code_has_a_sentence_of_the_fields_words():
    texts = {code: example(code).sentence for code in CODES}
    assert [code for code, text in texts.items() if not text.strip() or "{" in text] == []
    private = {code: plain_words(text) & set(PRIVATE) for code, text in texts.items()}
    assert {code: words for code, words in private.items() if words} == {}


def test_no_sentence_is_too_long():
    parts = [part for code in CODES for part in re.split(r"(?<=[.?]) ", example(code).sentence)]
    lengths = {part: len(re.findall(r"[A-Za-z][A-Za-z'-]+", part)) for part in parts}
    assert [part for part, length in lengths.items() if length > WORDS] == []
    assert sum(lengths.values()) / len(lengths) < MEAN


def test_numbers_of_sentences_have_units_that_are_known():
    for code in CODES:
        for name, spec in fields(code):
            if name.isdigit() or name in LISTS:
                assert spec == "", code
            else:
                unit = spec.rpartition(" ")[0]
                assert unit in UNITS or re.fullmatch(r"\{\d\}", unit), code


def test_a_parameter_may_name_the_unit_of_a_number():
    code = Unexplained.TERM_WOULD_WIDEN
    sentence = Reason(code, ("com_x", "sag", "um"), {"sd": 2.2e-6}).sentence
    assert sentence.endswith("would raise its standard deviation to 2.2 um.")


def test_a_codes_word_belongs_to_one_enumeration_only():
    words = [str(code) for code in CODES]
    assert sorted({word for word in words if words.count(word) > 1}) == []


def used_in(path):
    """Return the codes that a module names, as (enumeration, name), whatever it calls them."""
    tree, called = ast.parse(path.read_text(encoding="utf-8")), dict[str, str]()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(reasons.__name__):
            called |= {alias.asname or alias.name: alias.name for alias in node.names}
    return {
        (called[node.value.id], node.attr)
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute)
        and isinstance(node.value, ast.Name)
        and node.value.id in called
    }


def test_every_code_comes_about_somewhere():
    """By name, outside the room that declares it and outside what only sorts codes."""
    sorting = {PACKAGE / "model" / "outcome.py", PACKAGE / "model" / "verdict.py"}
    made = set[tuple[str, str]]()
    for path in PACKAGE.rglob("*.py"):
        if path.parent.name != "reasons" and path not in sorting:
            made |= used_in(path)
    assert [code for code in CODES if (type(code).__name__, code.name) not in made] == []


def test_every_estimate_reason_is_the_cause_of_one_outcome_at_most():
    causes = [code for each in HAPPENED.values() for code in each]
    assert len(causes) == len(set(causes))
    assert {code_of([Reason(code)]) for code in EstimateReason} == set(OutcomeCode)
    assert {trust_of([Reason(code)]) for code in EstimateReason} == set(Trust)


@pytest.mark.parametrize(
    ("codes", "trust", "happened"),
    [
        ((EstimateReason.LINEAR,), "trustworthy", "estimated"),
        ((EstimateReason.LINEAR, EstimateReason.RESIDUAL_LARGE), "widened", "estimated"),
        (
            (EstimateReason.RESIDUAL_LARGE, EstimateReason.BIAS_BY_NOISE),
            "not_trustworthy",
            "estimated",
        ),
        ((EstimateReason.RATIOS_ONLY, EstimateReason.EXPLAINED_RATE), "trustworthy", "scale_open"),
        (
            (EstimateReason.BIAS_BY_NOISE, EstimateReason.IMPOSSIBLE_INERTIA),
            "not_usable",
            "impossible",
        ),
        ((EstimateReason.NO_CAMERA,), "not_usable", "not_estimated"),
    ],
)
def test_the_worst_reason_decides_of_an_estimate(codes, trust, happened):
    found = Outcome(tuple(Reason(code) for code in codes))
    assert (found.trust, found.code) == (trust, happened)
    assert found.usable == (trust != "not_usable")
    assert found.warns == (trust in ("not_trustworthy", "not_usable"))


def test_an_outcome_without_numbers_of_use_is_not_usable_and_every_other_is():
    with_numbers = {"estimated", "part_unobservable", "scale_open"}
    for code in EstimateReason:
        found = outcome(code)
        assert found.usable == (found.code in with_numbers), code


def test_a_sentence_that_warns_belongs_to_an_outcome_that_warns():
    """And the other way round for those that can be used: words and level never disagree."""
    warning = ("not trustworthy", "do not trust")
    for code in EstimateReason:
        found = outcome(code)
        if any(words in code.template for words in warning):
            assert found.warns, code
        assert not (found.usable and found.warns) or any(w in code.template for w in warning), code


@pytest.mark.parametrize(
    ("codes", "expected"),
    [
        ((VerdictReason.TORQUE_MET,), VerdictOutcome.PASSED),
        ((VerdictReason.TORQUE_MET, VerdictReason.OFFSET_UNDECIDED), VerdictOutcome.UNDECIDED),
        ((VerdictReason.OFFSET_UNDECIDED, VerdictReason.TORQUE_EXCEEDED), VerdictOutcome.FAILED),
        ((VerdictReason.TILTED,), VerdictOutcome.HALTED),
        ((), VerdictOutcome.UNDECIDED),
    ],
)
def test_the_worst_reason_decides_of_a_verdict(codes, expected):
    verdict = Verdict(tuple(Reason(code) for code in codes))
    assert verdict.outcome is expected
    assert verdict.passed == (expected is VerdictOutcome.PASSED)


def test_a_verdicts_first_word_is_its_outcome():
    words = {"Passed": "passed", "Failed": "failed", "Cannot tell": "undecided",
             "Stopped": "halted"}  # fmt: skip
    causes = {code: result for result, each in OUTCOMES.items() for code in each}
    for code in VerdictReason:
        for word, result in words.items():
            if code.template.startswith(word):
                assert causes[code] == result, code


@pytest.mark.parametrize(
    ("value", "spec", "text"),
    [
        (0.5 * DEG, "deg .3g", "0.5"),
        (2.5e-6, "um .1f", "2.5"),
        (1.234e-3, "uN m plain", "1234"),
        (9.87e-6, "uN m plain", "9.87"),
        (0.25, "% .0f", "25"),
        (90.0, "min .3g", "1.5"),
        (0.125, ".1%", "12.5%"),
    ],
)
def test_a_quantity_shows_the_unit_that_it_is_requested_for(value, spec, text):
    assert format(Quantity(value), spec) == text


def test_a_reason_survives_another_process_and_json_holds_its_code():
    (reason,) = one_reason(Interlock.MISMATCH, "x", at=0.003, goal=0.005)
    again = pickle.loads(pickle.dumps(reason))
    assert again == reason
    assert again.code is Interlock.MISMATCH
    assert json.dumps(reason.code) == '"mismatch"'
    assert again.sentence == "mass x is at 3.00 mm; its commanded position is 5.00 mm"


def test_distinct_reasons_keep_their_order():
    one, other = Reason(Interlock.SILENCE, ("a",)), Reason(Interlock.SILENCE, ("b",))
    assert distinct([one, other, one]) == (one, other)
