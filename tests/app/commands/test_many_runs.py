"""`--on`, `--workers` and `--resume`: kept results count, and pieces may come from anywhere."""

import pickle
from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.runs.balance_series import run_series
from equipoise.app.runs.balancing import Goal, Limits
from equipoise.estimation.output_error.trajectory import Params
from equipoise.io.testbed.presets import read_preset
from equipoise.planning.manoeuvre.manoeuvre_space import Space
from equipoise.planning.manoeuvre.plan import Trials, Wish, planned
from equipoise.planning.manoeuvre.scenario import stated_prior
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.sizing import sized
from equipoise.procedure.identification.identify import IdentifyOptions
from equipoise.procedure.identification.identify_runs import identify_runs
from tests.support.platform_runs import platform_runs

METHODS = ("compare", "sputnix", "--methods", "--only", "tracker", "--duration-s", 20,
           "--workers", 1, "--json", "--resume", "kept")  # fmt: skip
LAWS = ("compare", "reference-table", "--laws", "--only", "pid", "--max-time-s", 40, "--runs", 1,
        "--workers", 1, "--json", "--resume", "kept")  # fmt: skip


def elsewhere(work, pieces):
    """Do pieces as another process does: work and results are pickled, the last comes first."""
    results = [pickle.dumps(pickle.loads(pickle.dumps(work))(piece)) for piece in pieces[::-1]]
    return map(pickle.loads, results[::-1])


# --- Kept results ------------------------------------------------------------------------------


def but_for_costs(document):
    """A comparison without what depends on the machine."""
    return [{k: v for k, v in method.items() if k not in ("time_s", "memory_bytes")}
            for method in document["methods"]]  # fmt: skip


def test_what_was_compared_is_not_computed_again(equipoise, strict_json, monkeypatch):
    """Three runs, of which two are kept, are those that nobody disturbed; then nothing is done."""
    undisturbed = strict_json(equipoise(*METHODS[:-2], "--runs", 3).out)
    equipoise(*METHODS, "--runs", 2)
    found = equipoise(*METHODS, "--runs", 3)
    assert but_for_costs(strict_json(found.out)) == but_for_costs(undisturbed)
    monkeypatch.setattr("equipoise.app.runs.comparison.compared_methods", only_kept)
    assert equipoise(*METHODS, "--runs", 3).out == found.out


def only_kept(tasks, spread):
    """Compare, and fail where a run would be computed."""
    from equipoise.study.compare_methods import compared_methods

    def work(_task):
        raise AssertionError("computed again")

    return compared_methods(tasks, lambda _work, pieces: spread(work, pieces))


def test_laws_are_kept_too_and_another_question_is_refused(equipoise):
    first = equipoise(*LAWS)
    assert equipoise(*LAWS).out == first.out
    refused = equipoise(*LAWS, "--tilt-deg", 10)
    assert refused.code == 2
    assert "another study (tilt: 0.349" in refused.err
    assert "the same study, or another folder" in refused.err


def test_results_in_a_file_of_another_kind_are_named(equipoise, tmp_path):
    (tmp_path / "kept").write_text("a file")
    refused = equipoise(*LAWS)
    assert (refused.code, refused.out) == (2, "")
    assert "kept" in refused.err


# --- Engines that commands refuse ----------------------------------------------------------------

WRONG = {
    "unknown": (["compare", "sputnix", "--laws", "--on", "slurm"], "one of local, dask-local"),
    "no port": (["plan", "sputnix", "--on", "dask://somewhere"], "dask://HOST:PORT, such as"),
    "no worker": (["design", "sputnix", "--workers", "0"], "--workers"),
    "one balancing": (["balance", "sputnix", "--workers", "2"], "--series, whose runs"),
    "one on a cluster": (["balance", "sputnix", "--on", "dask-local"], "--on: found one piece"),
    "one recording": (
        ["identify", "a.csv", "--testbed", "sputnix", "--workers", "2"],
        "several recordings",
    ),
}


@pytest.mark.parametrize(("words", "wanted"), WRONG.values(), ids=WRONG.keys())
def test_an_engine_that_cannot_be_is_refused(equipoise, words, wanted):
    done = equipoise(*words)
    assert (done.code, done.out) == (2, "")
    assert wanted in " ".join(done.err.split())


# --- The same numbers, wherever pieces are computed ----------------------------------------------


def test_a_plan_is_the_same_wherever_its_trials_are():
    testbed = replace(read_preset("sputnix"), com_sd=np.full(3, 5e-6))
    where = Space(testbed, 30.0, 1, testbed.tilt_limit, 0.17, {})
    wish = Wish("both", "A", Params(), stated_prior(testbed))
    shares = []
    here, there = (planned(where, wish, 2, each) for each in
                   (Trials(24), Trials(24, elsewhere, shares.append)))  # fmt: skip
    assert (here.moves, here.tilt, here.low_side.tolist()) == (
        there.moves, there.tilt, there.low_side.tolist())  # fmt: skip
    assert shares[-1] == 1.0


def test_a_design_is_the_same_wherever_its_budgets_are():
    case = Case(read_preset("nanosat"), np.zeros(3), 0.3, 60.0, 1)
    here, there = (sized(case, (60.0, 30.0), None, spread) for spread in (map, elsewhere))
    assert [each.torque for each in here.budgets] == [each.torque for each in there.budgets]
    assert here.budgets[0].torque != here.budgets[1].torque
    assert [each.name for each in here.better] == [each.name for each in there.better]


def test_a_series_is_the_same_wherever_its_runs_are():
    testbed, limits = read_preset("sputnix"), Limits(max_moves=1, max_time=20.0)
    goal = Goal(np.array([0.0, 0.0, -1e-4]), np.array([2e-6, 2e-6, 3e-6]))
    here, there = (run_series(testbed, goal, limits, (2, 5), spread) for spread in (map, elsewhere))
    assert here.verdict.sentence == there.verdict.sentence
    for one, other in zip(here.runs, there.runs, strict=True):
        assert one.estimate is not None
        assert other.estimate is not None
        assert one.estimate.covariance.tobytes() == other.estimate.covariance.tobytes()
    assert here.runs[0].estimate.covariance.tobytes() != here.runs[1].estimate.covariance.tobytes()


def test_several_recordings_are_fitted_the_same_wherever_each_is():
    runs = platform_runs(3, (False, False), duration=20.0)
    here, there = (
        list(identify_runs(runs.recordings, runs.testbed, IdentifyOptions(), spread))
        for spread in (map, elsewhere)
    )
    assert len(here) == len(there) == 3
    for one, other in zip(here, there, strict=True):
        assert one.reasons == other.reasons
        assert one.estimate.covariance.tobytes() == other.estimate.covariance.tobytes()
