"""--json prints one document, strict JSON, with the schema's keys and SI units."""

import numpy as np
import pytest

from equipoise.app.text.json_document import finite

PARAMETER = {"name", "unit", "value", "sd", "low95", "high95", "observable"}


def test_an_estimate(equipoise, record_file, strict_json):
    done = equipoise("identify", record_file, "--testbed", "sputnix", "--json")
    document = strict_json(done.out)
    assert done.code == 0
    assert document["schema"] == "equipoise/estimate/1"
    assert document["method"] == "trajectory"
    assert document["outcome"]["usable"]
    assert document["outcome"]["code"] == "estimated"
    assert document["outcome"]["trust"] in ("trustworthy", "widened")
    codes = [reason["code"] for reason in document["outcome"]["reasons"]]
    assert codes[0] in ("explained_attitude", "explained_rate")
    assert all(set(p) == PARAMETER for p in document["parameters"])
    n = len(document["parameters"])
    assert np.shape(document["covariance"]) == (n, n)
    by_name = {p["name"]: p for p in document["parameters"]}
    assert 1e-6 < abs(by_name["com_z"]["value"]) < 1e-3  # m, not um
    assert by_name["inertia_P_xx"]["unit"] == "kg m2"
    assert document["provenance"]["sha256"]
    assert 0 < document["residual"]["held_out_rms"] < 0.1  # rad
    assert "identifying" in done.err


def test_an_unobservable_parameter_is_null_and_ratios_are_given_beside_it(
    equipoise, record_file, strict_json
):
    """Before the move the scale is open."""
    words = ["--testbed", "sputnix", "--to-s", "60", "--json"]
    document = strict_json(equipoise("identify", record_file, *words).out)
    com = next(p for p in document["parameters"] if p["name"] == "com_z")
    assert (com["sd"], com["low95"], com["observable"]) == (None, None, False)
    assert document["ratios"]
    assert any(reason["code"] == "scale" for reason in document["unobservable"])


def test_a_balancing_run(equipoise, strict_json):
    done = equipoise("balance", "sputnix", "--json", "--seed", "3")
    document = strict_json(done.out)
    assert document["schema"] == "equipoise/balance/2"
    assert done.code == (0 if document["verdict"]["passed"] else 1)
    assert document["verdict"]["outcome"] in ("passed", "failed", "undecided")
    assert all(step["code"] == step["reasons"][0]["code"] for step in document["steps"])
    assert len(document["verdict"]["com_m"]) == len(document["verdict"]["sd_m"]) == 3
    assert len(document["truth"]["com_m"]) == 3
    assert np.shape(document["truth"]["inertia_P_kg_m2"]) == (3, 3)
    assert document["steps"][0]["kind"] == "measurement"
    assert document["steps"][-1]["verdict"] == document["verdict"]
    assert np.abs(np.array(document["verdict"]["com_m"]) - [0, 0, -100e-6]).max() < 10e-6  # m
    moves = [step["move"] for step in document["steps"] if "move" in step]
    assert 0 < moves[0]["travel_m"] < 1
    assert all(abs(at) <= 0.05 for at in moves[0]["targets_m"].values())  # m, the rails' ends
    assert np.all(np.diag(moves[0]["predicted_covariance_m2"]) < (100e-6) ** 2)
    times = [step["time_s"] for step in document["steps"]]
    assert times == sorted(times)


def test_a_recording(equipoise, record_file, strict_json):
    document = strict_json(equipoise("inspect", record_file, "--json").out)
    assert document["schema"] == "equipoise/recording/1"
    assert document["rows"]["attitude"] == 601
    assert document["span_s"] == [0, 120]
    assert any("x1 moves" in finding["sentence"] for finding in document["findings"])


def test_a_part_of_a_recording(equipoise, record_file, strict_json):
    """Every command that reads a record can leave its ends out: 10 to 40 s are 151 rows at 5 Hz."""
    part = ("--from-s", "10", "--to-s", "40", "--json")
    measured = strict_json(equipoise("inspect", record_file, *part).out)
    assert (measured["rows"]["attitude"], measured["span_s"]) == (151, [10, 40])
    observed = strict_json(equipoise("observe", record_file, "--testbed", "sputnix", *part).out)
    # The move is at 60 s.
    assert any(reason["code"] == "scale" for reason in observed["unobservable"])


def test_what_a_recording_can_show(equipoise, record_file, strict_json):
    """Bounds in SI beside what the testbed states; filters with their ranks."""
    done = equipoise("observe", record_file, "--testbed", "sputnix", "--json")
    document = strict_json(done.out)
    assert done.code == 0
    assert document["schema"] == "equipoise/observe/1"
    by_name = {p["name"]: p for p in document["parameters"]}
    assert set(by_name["com_z"]) == {"name", "unit", "sd", "testbed_sd", "observable", "held"}
    assert by_name["com_z"]["testbed_sd"] == pytest.approx(40e-6)  # m
    assert 1e-8 < by_name["com_z"]["sd"] < 40e-6
    assert by_name["attitude_x"]["testbed_sd"] is None
    assert document["rank"] == document["size"] == len(by_name)
    assert document["unobservable"] == document["ratios"] == []
    assert 1 < document["condition"] < 1e9
    assert 0 < document["gravity_sweep"] < 2 / 3
    assert 0 <= document["tilt_rad"][0] < document["tilt_rad"][1] < 1
    ranks = {f["name"]: (f["rank"], f["possible_rank"], f["size"]) for f in document["filters"]}
    assert ranks["ekf [attitude, w, r]"] == (9, 9, 9)
    assert ranks["ekf [w, J, mu]"] == (None, 12, 12)


def test_bounds_are_what_identify_states(equipoise, record_file, strict_json):
    """The same record, the same model: sd of com and inertia within 10 %."""
    words = (record_file, "--testbed", "sputnix", "--json")
    bound = strict_json(equipoise("observe", *words).out)["parameters"]
    stated = strict_json(equipoise("identify", *words).out)["parameters"]
    sd = {p["name"]: p["sd"] for p in stated}
    body = [p for p in bound if p["name"].startswith(("com_", "inertia_P_"))]
    assert len(body) == 9
    for parameter in body:
        assert parameter["sd"] == pytest.approx(sd[parameter["name"]], rel=0.1)


def test_what_an_open_scale_leaves(equipoise, free_file, strict_json):
    """Without a move: null for the unobservable, and bounds of ratios; held, all is observable."""
    words = ("observe", free_file, "--testbed", "sputnix", "--json")
    document = strict_json(equipoise(*words).out)
    com = next(p for p in document["parameters"] if p["name"] == "com_z")
    assert (com["sd"], com["observable"]) == (None, False)
    assert document["condition"] is None
    assert document["rank"] == document["size"] - 1
    assert len(document["ratios"]) == 8
    assert any(reason["code"] == "scale" for reason in document["unobservable"])
    held = strict_json(equipoise(*words, "--hold", "inertia_P_zz").out)
    assert held["rank"] == held["size"] == document["size"] - 1
    assert [p["name"] for p in held["parameters"] if p["held"]] == ["inertia_P_zz"]


@pytest.mark.parametrize("odd", [np.inf, -np.inf, np.nan])
def test_numbers_without_a_value_become_null(odd):
    assert finite({"a": [1.0, (odd, "x")], "b": odd}) == {"a": [1.0, [None, "x"]], "b": None}
