"""What is recommended follows from the numbers, and says which ones."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.study.compare_laws import Comparison, middle
from equipoise.study.compare_laws import summary as law_summary
from equipoise.study.compare_methods import Ratios, Share, summary
from equipoise.study.recommend import advised_law, advised_method, least_share
from tests.study.test_compare_laws import NEAR, UP
from tests.study.test_compare_laws import made_up as made_up_law
from tests.support.synthetic_runs import made_up

GOOD = {"refused": 0, "unusable": 0, "broke": 0, "warned": 0, "confident_wrong": 0,
        "trusted": 40, "runs": 40, "coverage": Share(342, 360)}  # fmt: skip


def reported(method, ratio, time=1.0, stated=(120, 120), **more):
    com = Ratios(ratio, 0.1, Share(*stated))
    return replace(summary([made_up(method=method)]), com=com, time=time, **(GOOD | more))


def test_chance_leaves_16_of_20_at_least():
    """Of 20 draws of 95 %: at most 15 in 0.26 % of cases, at most 16 in 1.6 %."""
    assert least_share(20) == pytest.approx(16 / 20)
    assert least_share(0) == 1.0


def test_the_least_error_is_recommended_with_its_numbers():
    said = advised_method([reported("tracker", 1.3), reported("trajectory", 1.04)], "com")
    assert said.name == "trajectory"
    assert "RMSE 1 times the bound" in said.sentence
    assert "95 % of 360" in said.sentence
    assert "no failure in 40 runs" in said.sentence


@pytest.mark.parametrize(("ratio", "named"), [(1.49, True), (1.51, False)])
def test_the_quickest_within_one_and_a_half_times_is_named_too(ratio, named):
    methods = [
        reported("trajectory", 1.0, 2.0),
        reported("tracker", ratio, 0.1),
        reported("ekf_9", 1.2, 1.0),
    ]
    said = advised_method(methods, "com")
    assert said.name == "trajectory"
    assert ("tracker" in said.sentence) is named
    assert ("ekf_9" in said.sentence) is not named


def test_nothing_is_added_when_the_best_is_the_quickest():
    said = advised_method([reported("trajectory", 1.0, 0.1), reported("tracker", 1.1, 0.2)], "com")
    assert "Quicker" not in said.sentence


WANTING = {
    "fails": ({"unusable": 1}, "fails in 1 of 40 runs"),
    "broke": ({"broke": 2}, "fails in 2 of 40 runs"),
    "part": ({"stated": (80, 120)}, "states 80 of 120 values"),
    "wrong": ({"confident_wrong": 1}, "is off by more than 5 sd in 1 of 40 runs"),
    "warned": ({"warned": 5, "trusted": 35}, "warns about its intervals in 5 of 40 runs"),
    "too narrow": ({"coverage": Share(300, 360)}, "intervals with a coverage of 83 %"),
}


@pytest.mark.parametrize(("more", "reason"), WANTING.values(), ids=WANTING.keys())
def test_a_method_that_is_not_honest_is_passed_over(more, reason):
    """However accurate it is; without another, none is recommended and the sentence says why."""
    liar = reported("smoother", 0.5, **more)
    assert advised_method([liar, reported("trajectory", 2.0)], "com").name == "trajectory"
    alone = advised_method([liar], "com")
    assert alone.name is None
    assert reason in alone.sentence


def test_chance_is_that_of_runs_not_of_intervals():
    """83 % of 180 intervals is no chance for independent ones; of 20 runs, at least 80 % is."""
    few = reported("tracker", 1.0, runs=20, trusted=20, coverage=Share(150, 180))
    assert advised_method([few], "com").name == "tracker"


def test_a_warning_in_one_run_of_ten_is_borne():
    borne = reported("tracker", 1.0, warned=4, trusted=36)
    assert advised_method([borne], "com").name == "tracker"


def test_inertia_is_advised_by_its_own_errors():
    poor, near = (Ratios(ratio, 0.1, Share(240, 240)) for ratio in (5.0, 1.0))
    methods = [replace(reported("tracker", 1.0), inertia=poor),
               replace(reported("trajectory", 5.0), inertia=near)]  # fmt: skip
    assert advised_method(methods, "com").name == "tracker"
    assert advised_method(methods, "inertia").name == "trajectory"


def test_intervals_that_are_too_wide_are_honest():
    assert (
        advised_method([reported("tracker", 1.0, coverage=Share(360, 360))], "com").name
        == "tracker"
    )


def test_nobody_who_states_it_is_no_recommendation():
    silent = replace(reported("tracker", np.nan), com=Ratios(np.nan, np.nan, Share(0, 120)))
    said = advised_method([silent], "com")
    assert said.name is None
    assert "none states it" in said.sentence


@pytest.mark.parametrize(("runs", "few"), [(6, True), (19, True), (20, False)])
def test_too_few_runs_are_reported(runs, few):
    method = reported("tracker", 1.0, runs=runs, trusted=runs)
    assert (f"{runs} runs are few" in advised_method([method], "com").sentence) is few
    assert "few" not in advised_method([reported("tracker", 1.0)], "com").sentence


# --- laws --------------------------------------------------------------------------------------


def compared(*laws):
    """A comparison of laws of 20 runs each: name, torque left, halted, passed wrongly."""
    bed, required = read_preset("reference-table"), 1e-5
    one = law_summary([made_up_law()], UP, required, NEAR)
    reported_of = tuple(
        replace(one, law=law, runs=20, halted=halted, false_passes=false,
                within=20 if torque <= required else 9, torque=middle(np.array([torque])))
        for law, torque, halted, false in laws
    )  # fmt: skip
    return Comparison(bed, range(20), 0.3, required, middle(np.array([1e-3])), reported_of, (), ())


def test_the_least_torque_among_laws_that_reach_it_is_taken():
    said = advised_law(compared(("pid", 8e-6, 0, 0), ("l1_adaptive", 4e-6, 0, 0)))
    assert said.name == "l1_adaptive"
    assert "4 uN m left" in said.sentence
    assert "10 uN m was required" in said.sentence


@pytest.mark.parametrize(("within", "taken"), [(18, False), (19, True)])
def test_a_law_may_leave_more_in_one_run_of_twenty(within, taken):
    found = compared(("pid", 8e-6, 0, 0))
    found = replace(found, laws=(replace(found.laws[0], within=within),))
    assert (advised_law(found).name == "pid") is taken


def test_fewer_halts_count_more_than_less_torque():
    found = compared(("pid", 8e-6, 0, 0), ("l1_adaptive", 4e-6, 1, 0))
    assert advised_law(found).name == "pid"


def test_a_law_whose_verdict_passed_what_is_wrong_is_never_taken():
    found = compared(("pid", 4e-6, 0, 1))
    assert advised_law(found).name is None
    assert advised_law(compared(("pid", 4e-6, 0, 1), ("l1_adaptive", 8e-6, 3, 0))).name is not None


def test_when_no_law_reaches_the_torque_the_nearest_is_named():
    found = compared(("pid", 4e-5, 0, 0), ("l1_adaptive", 2e-5, 0, 0))
    said = advised_law(found)
    assert said.name is None
    assert "The nearest: l1_adaptive" in said.sentence
    assert "9 of 20" in said.sentence
