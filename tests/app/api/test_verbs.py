"""A verb gives what its command prints with --json, and takes records and paths alike."""

import json
from pathlib import Path

import numpy as np
import pytest

import equipoise as eq
from equipoise.model.errors import InputError
from tests.app.api.conftest import LINEAR

COMMANDS = {
    "identify": "identify {file} --testbed sputnix --method " + LINEAR,
    "assess": "assess {file} --testbed sputnix --require-torque 1e-2",
    "observe": "observe {file} --testbed sputnix",
    "design": "design sputnix --record-s 60",
    "balance": "balance sputnix --seed 1 --max-moves 1",
    "plan": "plan reference-table --duration-s 8 --trials 2 --seed 2 --workers 1",
    "methods": "methods",
    "laws": "laws",
}


@pytest.mark.usefixtures("few_platforms")
@pytest.mark.parametrize("verb", COMMANDS)
def test_a_verb_gives_the_numbers_of_its_command(verb, returned, equipoise, strict_json):
    words = COMMANDS[verb].format(file=returned.recording).split()
    printed = strict_json(equipoise(*words, "--json").out)
    ours = json.loads(json.dumps(returned.results[verb].to_dict()))
    assert but_for_the_clock(ours) == but_for_the_clock(printed)


def but_for_the_clock(document):
    """Return a document without the time at which it was made: one is made after the other."""
    document.get("provenance", {}).pop("made at", None)
    return document


def test_compare_judges_the_runs_that_its_command_judges(returned, equipoise, strict_json):
    """Times and memory differ from run to run; errors do not."""
    words = f"compare sputnix --methods --only {LINEAR} --runs 1 --duration-s 30 --workers 1"
    (printed,) = strict_json(equipoise(*words.split(), "--json").out)["methods"]
    (ours,) = json.loads(json.dumps(returned.results["compare"].to_dict()))["methods"]
    for key in ("method", "bias", "sd", "rmse"):
        assert ours[key] == printed[key]


def test_simulate_writes_what_its_command_writes(returned, equipoise):
    words = [
        "simulate",
        "sputnix",
        "--duration-s",
        "30",
        "--seed",
        "1",
        "--out",
        "again.csv",
        "--move",
    ]
    assert equipoise(*words, "15: z1=-50").code == 0
    assert returned.recording.read_bytes() == Path("again.csv").read_bytes()


def test_a_series_is_what_its_command_writes_and_begins_with_the_run_of_its_seed(
    returned, equipoise
):
    words = ["simulate", "sputnix", "--duration-s", "30", "--move", "15: z1=-50", "--out", "runs"]
    assert equipoise(*words, "--series", "3").code == 0
    files = sorted(Path("runs").iterdir())
    assert [file.name for file in files] == ["run_01.csv", "run_02.csv", "run_03.csv"]
    assert files[0].read_bytes() == returned.recording.read_bytes()
    ours = [run.recording for run in returned.results["identify several"].runs]
    for file, recording in zip(files, ours, strict=True):
        assert np.array_equal(eq.read_recording(file).attitude.values, recording.attitude.values)


def test_several_recordings_give_the_numbers_of_the_command(returned, equipoise, strict_json):
    words = ["simulate", "sputnix", "--duration-s", "30", "--move", "15: z1=-50", "--out", "runs"]
    equipoise(*words, "--series", "3")
    files = sorted(Path("runs").iterdir())
    printed = strict_json(equipoise("identify", *files, "--testbed", "sputnix", "--json").out)
    ours = json.loads(json.dumps(returned.results["identify several"].to_dict()))
    for key in ("verdict", "scatter"):
        assert ours[key] == printed[key]
    assert ours["estimate"]["parameters"] == printed["estimate"]["parameters"]
    assert [run["used"] for run in printed["runs"]] == [True] * 3


def test_calibrate_gives_the_numbers_of_its_command(returned, equipoise, strict_json):
    words = f"calibrate {returned.recording} --testbed sputnix --reference z1 --json"
    printed = strict_json(equipoise(*words.split()).out)
    found = eq.calibrate(returned.recording, "sputnix", reference=["z1"])
    assert json.loads(json.dumps(found.to_dict())) == printed


def test_a_record_and_its_file_give_the_same(returned):
    by_path = returned.results["identify"]
    by_record = eq.identify(by_path.recording, by_path.testbed, method=LINEAR)
    assert but_for_the_clock(by_record.to_dict()) == but_for_the_clock(by_path.to_dict())


def test_each_step_is_passed_on_and_stays_in_the_result(returned):
    steps = []
    done = eq.identify(returned.recording, "sputnix", method=LINEAR, on_step=steps.append)
    assert steps == list(done.steps)
    assert [step.kind for step in steps] == ["measurement", "estimate"]


def test_a_bench_is_balanced_as_a_simulated_platform_of_its_seed_is(returned):
    bench = eq.SimulatedBench(eq.preset("sputnix"), seed=1)
    done = eq.balance(bench, target=(0.0, 0.0, -100.0 / 1e6), max_moves=1)
    balanced = returned.results["balance"].to_dict()
    assert but_for_the_clock(done.to_dict()) == but_for_the_clock(balanced)


def test_a_part_of_a_recording_stays_that_part(returned):
    part = eq.read_recording(returned.recording, start=5.0, end=20.0)
    assert part.span == (5.0, 20.0)
    done = eq.identify(part, "sputnix", method=LINEAR)
    assert done.recording.span == (5.0, 20.0)


def test_a_plan_can_be_simulated_without_a_file(returned):
    plan = returned.results["plan"].plan
    recording = eq.simulate("reference-table", plan=plan, seed=3)
    assert recording.span[1] == pytest.approx(plan.manoeuvre.duration, abs=0.2)  # s, one frame


def test_lists_are_measured_up_by_name():
    assert eq.methods()["trajectory"].name == "trajectory"
    assert "measure_and_move" in list(eq.laws())
    with pytest.raises(InputError, match="did you mean 'trajectory'"):
        eq.methods()["trajectori"]


@pytest.mark.parametrize(
    ("call", "names"),
    [
        (lambda: eq.preset("sputnik"), "sputnix"),
        (lambda: eq.simulate("sputnix", duration=-1.0), "duration"),
        (lambda: eq.design("sputnix", surroundings={"warmth": 1.0}), "surroundings"),
        (lambda: eq.compare("sputnix"), "methods"),
        (lambda: eq.balance("sputnix", law="pidd"), "law"),
        (lambda: eq.read_recording("run.csv", dialect="ros", columns="map.toml"), "columns"),
    ],
)
def test_wrong_use_names_the_argument(call, names):
    with pytest.raises(InputError, match=names):
        call()


def test_a_bench_that_is_not_there_is_refused():
    with pytest.raises(InputError, match="no hardware"), eq.open_bench("kau"):
        pass


def test_moves_are_metres(returned):
    masses = returned.results["Recording"].masses
    assert masses is not None
    assert np.abs(masses.values).max() == pytest.approx(0.050, abs=1e-3)  # m, its stops scatter
