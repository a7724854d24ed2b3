"""`equipoise ledger`, run as people run it: an estimate made before, and columns in the record."""

import numpy as np
import pytest

from equipoise.app.cli import run
from equipoise.io.recording.recording_file import read_recording


@pytest.fixture(scope="module")
def swing(tmp_path_factory):
    """A recording of 20 s with a move."""
    folder = tmp_path_factory.mktemp("ledger")
    file = folder / "swing.csv"
    words = ("--duration-s", "20", "--move", "8.5: x1=-15 y1=25", "--seed", "1")
    assert run(["simulate", "sputnix", "--out", str(file), *words]) == 0
    return file


@pytest.fixture(scope="module")
def identified(swing):
    """The folder of the run that identified its platform."""
    folder = swing.parent / "identified"
    assert run(["identify", str(swing), "--testbed", "sputnix", "--out", str(folder)]) == 0
    return folder


def test_an_estimate_made_before_gives_the_same_ledger(equipoise, strict_json, swing, identified):
    own = strict_json(equipoise("ledger", swing, "--testbed", "sputnix", "--json").out)
    words = ("ledger", swing, "--testbed", "sputnix", "--estimate", identified, "--json")
    other = strict_json(equipoise(*words).out)
    for key in ("total_N_m", "total_sd_N_m"):
        assert np.array(other[key]) == pytest.approx(np.array(own[key]), rel=1e-9)


@pytest.mark.parametrize("name", ["run.csv", "run.parquet", "run.mcap", "run.mat"])
def test_columns_of_the_record_are_the_numbers_of_the_document(
    equipoise, strict_json, swing, identified, name
):
    path = swing.with_name(name)
    said = equipoise("ledger", swing, "--testbed", "sputnix", "--estimate", identified,
                     "--record", path, "--json")  # fmt: skip
    document, written, before = strict_json(said.out), read_recording(path), read_recording(swing)
    for cause, torque in (*document["torque_N_m"].items(), ("total", document["total_N_m"])):
        where = [written.cause_names.index(f"{cause}_{axis}") for axis in "xyz"]
        assert written.torque_by_cause.values[:, where].tolist() == torque
    assert written.torque_by_cause.t == pytest.approx(np.array(document["t_s"]), abs=1e-9)
    assert written.attitude.values == pytest.approx(before.attitude.values, abs=1e-15)
    assert written.masses.values == pytest.approx(before.masses.values, abs=1e-15)
    assert written.unread == ()
    assert str(path) in said.err


def test_terms_beside_an_estimate_are_refused(equipoise, swing, identified):
    words = ("ledger", swing, "--testbed", "sputnix", "--estimate", identified, "--term", "sag")
    refused = equipoise(*words)
    assert refused.code == 2
    assert "--estimate: found --hold, --term or --prior" in refused.err


def test_a_record_of_no_format_is_refused_at_once(equipoise, swing, tmp_path):
    refused = equipoise("ledger", swing, "--testbed", "sputnix", "--record", tmp_path / "a.xlsx")
    assert refused.code == 2
    assert "suffix '.xlsx'" in refused.err
