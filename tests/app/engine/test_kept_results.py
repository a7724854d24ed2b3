"""Results that a killed run has kept: none is lost, none counts twice, none is of another run."""

import numpy as np
import pytest

from equipoise.app.engine.kept_results import KeptResults
from equipoise.app.engine.pool import HERE
from equipoise.app.engine.record_text import text_of, value_of
from equipoise.app.engine.spread import spread_over
from equipoise.model.errors import InputError
from equipoise.model.reasons.reason import one_reason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.verdict import Verdict, VerdictOutcome
from equipoise.study.compare_laws import Refusal
from equipoise.study.law_run import LawRun
from tests.support.killed_run import compared_with_undisturbed
from tests.support.many_pieces import kept_in, key, pair, pieces_in
from tests.support.synthetic_runs import made_up


def test_a_run_that_is_killed_goes_on_where_it_was(tmp_path):
    """Its workers end with it; what it kept is not computed again, all else once."""
    found = compared_with_undisturbed(tmp_path)
    assert 0 < found.kept < found.count == 10_000
    assert (found.lost, found.doubled) == (0, 0)
    assert found.equal
    assert len(kept_in(tmp_path).found(pieces_in(tmp_path, "third.txt"))) == found.count


FEW = [("nowhere", k) for k in range(40)]


def pair_of(piece):
    return pair(piece[1])


def run_of(kept, pieces=FEW):
    """The results of a run here, and which pieces it computed."""
    done = []

    def work(piece):
        done.append(piece[1])
        return pair_of(piece)

    return list(spread_over(HERE, kept=kept)(work, pieces)), done


def test_a_file_that_is_cut_off_counts_as_not_there(tmp_path):
    """Of a whole and a half file and one of nonsense, the first counts; the others are named."""
    said = []
    whole, done = run_of(kept_in(tmp_path), FEW[:20])
    run_of(kept_in(tmp_path), FEW)
    files = sorted((tmp_path / "kept").glob("results-*.parquet"))
    assert done == list(range(20))
    files[0].write_bytes(files[0].read_bytes()[:-9])
    (tmp_path / "kept" / "results-00000000.parquet").write_bytes(b"nonsense")
    again, computed_again = run_of(kept_in(tmp_path, said.append))
    assert again == [pair(k) for k in range(40)]
    assert again[:20] == whole
    assert 0 < len(computed_again) < 40
    assert len(said) == 2
    assert all("its results are computed again" in each for each in said)
    assert run_of(kept_in(tmp_path, said.append))[1] == []


def test_more_runs_of_the_same_question_take_in_those_of_before(tmp_path):
    run_of(kept_in(tmp_path), FEW[:25])
    found, done = run_of(kept_in(tmp_path), FEW)
    assert done == list(range(25, 40))
    assert found == [pair(k) for k in range(40)]


def test_files_of_two_computers_may_be_put_together(tmp_path):
    """A result that both have counts once."""
    run_of(kept_in(tmp_path / "a"), FEW[:25])
    run_of(kept_in(tmp_path / "b"), FEW[15:])
    for file in (tmp_path / "b" / "kept").glob("results-*.parquet"):
        file.rename(tmp_path / "a" / "kept" / file.name)
    found, done = run_of(kept_in(tmp_path / "a"), FEW)
    assert (found, done) == ([pair(k) for k in range(40)], [])


def test_results_of_another_question_are_refused_and_never_counted(tmp_path):
    """The difference is named; files that were copied from such a folder do not count."""
    question = {"duration": 30.0, "options": {"hold": ("com_x",)}}

    def kept(name, **changed):
        return KeptResults(tmp_path / name, question | changed, key, print)

    run_of(kept("one"))
    with pytest.raises(InputError, match=r"another study \(duration: 30.0 there, 31"):
        kept("one", duration=31.0)
    with pytest.raises(InputError, match="options hold: com_x there, com_y here"):
        kept("one", options={"hold": ("com_y",)})
    other = kept("two", duration=31.0)
    for file in (tmp_path / "one").glob("results-*.parquet"):
        file.rename(tmp_path / "two" / file.name)
    assert other.found(FEW) == {}


def test_an_error_leaves_what_was_done_on_the_disk(tmp_path):
    def work(piece):
        if piece[1] == 30:
            raise ZeroDivisionError
        return pair_of(piece)

    with pytest.raises(ZeroDivisionError):
        list(spread_over(HERE, kept=kept_in(tmp_path))(work, FEW))
    assert {0, 1, 2} <= set(kept_in(tmp_path).found(FEW)) <= set(range(30))


# --- Records as text ---------------------------------------------------------------------------

SAID = Verdict(one_reason(VerdictReason.SOME_RUNS_FAILED, "3", count=5, failed=1))
LAW = LawRun("pid", 3, np.array([1e-6, -0.0, 5e-324]), 0.1 + 0.2, None, 1e-3, np.float64(90.0),
             1 / 3, False, SAID)  # fmt: skip
METHOD = made_up([1.0, np.nan, -np.inf], [1.0, 2.0, 3.0], [1.0] * 3, method="tracker", seed=7)


@pytest.mark.parametrize("record", [LAW, METHOD, Refusal("pid", "läuft nicht \x1b[0m")])
def test_a_result_is_read_back_to_the_last_bit(record):
    again = value_of(text_of(record))
    assert type(again) is type(record)
    for name in type(record).__slots__:
        was, found = getattr(record, name), getattr(again, name)
        assert type(found) is type(was)
        if isinstance(was, np.ndarray):
            assert (found.dtype, found.shape) == (was.dtype, was.shape)
            assert found.tobytes() == was.tobytes()
    assert text_of(again) == text_of(record)


def test_a_verdict_that_is_read_back_says_the_same():
    again = value_of(text_of(LAW)).verdict
    assert again.outcome is SAID.outcome
    assert isinstance(again.outcome, VerdictOutcome)
    assert again.sentence == SAID.sentence


@pytest.mark.parametrize(
    "text",
    [
        '{"record":["os:stat_result",{}]}',
        '{"record":["equipoise.model.errors:InputError",{}]}',
        '{"record":["equipoise.study.compare_laws:Refusal",{"law":"pid"}]}',
        '{"enum":["equipoise.study.compare_laws:Refusal","law"]}',
        '{"partial":[{"named":"os:system"},["true"],{}]}',
        '{"named":"os:system"}',
    ],
)
def test_a_text_makes_nothing_but_records_of_this_program(text):
    with pytest.raises(ValueError, match=r"."):
        value_of(text)


def test_what_is_no_record_is_not_kept():
    with pytest.raises(TypeError, match="object cannot be kept"):
        text_of(object())
