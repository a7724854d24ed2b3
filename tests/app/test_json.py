"""--json prints one document, strict JSON, with the schema's keys and SI units."""

import numpy as np
import pytest

from equipoise.app.views_json import finite

PARAMETER = {"name", "unit", "value", "sd", "low95", "high95", "observable"}


def test_an_estimate(equipoise, record_file, strict_json):
    done = equipoise("identify", record_file, "--testbed", "sputnix", "--json")
    document = strict_json(done.out)
    assert done.code == 0
    assert document["schema"] == "equipoise/estimate/1"
    assert document["method"] == "trajectory"
    assert document["outcome"]["usable"]
    assert all(set(p) == PARAMETER for p in document["parameters"])
    n = len(document["parameters"])
    assert np.shape(document["covariance"]) == (n, n)
    by_name = {p["name"]: p for p in document["parameters"]}
    assert 1e-6 < abs(by_name["com_z"]["value"]) < 1e-3  # m, not um
    assert by_name["inertia_P_xx"]["unit"] == "kg m2"
    assert document["provenance"]["sha256"]
    assert 0 < document["residual"]["held_out_rms"] < 0.1  # rad
    assert "identifying" in done.err


def test_what_was_not_seen_is_null_and_ratios_stand_beside_it(equipoise, record_file, strict_json):
    """Before the move the scale is open."""
    words = ["--testbed", "sputnix", "--to-s", "60", "--json"]
    document = strict_json(equipoise("identify", record_file, *words).out)
    com = next(p for p in document["parameters"] if p["name"] == "com_z")
    assert (com["sd"], com["low95"], com["observable"]) == (None, None, False)
    assert document["ratios"]
    assert any("scale" in sentence for sentence in document["unobservable"])


def test_a_balancing_run(equipoise, strict_json):
    done = equipoise("balance", "sputnix", "--json", "--seed", "3")
    document = strict_json(done.out)
    assert document["schema"] == "equipoise/balance/1"
    assert done.code == (0 if document["verdict"]["passed"] else 1)
    assert len(document["verdict"]["com_um"]) == len(document["verdict"]["sd_um"]) == 3
    assert len(document["truth"]["com_um"]) == 3
    assert np.shape(document["truth"]["inertia_P_kg_m2"]) == (3, 3)
    assert document["steps"][0]["kind"] == "look"
    assert document["steps"][-1]["verdict"] == document["verdict"]
    times = [step["time_s"] for step in document["steps"]]
    assert times == sorted(times)


def test_a_recording(equipoise, record_file, strict_json):
    document = strict_json(equipoise("inspect", record_file, "--json").out)
    assert document["schema"] == "equipoise/recording/1"
    assert document["rows"]["attitude"] == 601
    assert document["span_s"] == [0, 120]
    assert any("x1 moves" in finding["sentence"] for finding in document["findings"])


@pytest.mark.parametrize("odd", [np.inf, -np.inf, np.nan])
def test_numbers_without_a_value_become_null(odd):
    assert finite({"a": [1.0, (odd, "x")], "b": odd}) == {"a": [1.0, [None, "x"]], "b": None}
