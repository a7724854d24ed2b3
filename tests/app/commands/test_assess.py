"""`equipoise assess`, run as people run it: tables, verdict and exit code, JSON, folder."""

import pytest

from equipoise.app.cli import run
from equipoise.procedure.identification import assess as assessment
from tests.support.quiet_records import lowered


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    folder = tmp_path_factory.mktemp("assess")
    paths = [folder / "before.csv", folder / "after.csv"]
    moves = ((), ("--move", "5: z1=-50 z2=-50"))
    for path, move in zip(paths, moves, strict=True):
        run(["simulate", "sputnix", "--out", str(path), "--duration-s", "45", "--seed", "3", *move])
    return paths


def assess(path, *words):
    return run(["assess", str(path), "--testbed", "sputnix", *words])


def test_tables_end_with_a_verdict(records, capsys):
    """110 um are put below another 43: the distance fails, and so does the exit code."""
    assert assess(records[1], "--require-offset-um", "20") == 1
    text = capsys.readouterr().out
    for part in (
        "torque within 20 deg, rms",
        "trajectory fit",
        "torque, slopes over",
        "energy",
        "swing",
        "residual torque",
        "Error indices",
        "Failed: the centre of mass",
    ):
        assert part in text  # fmt: skip


def test_measurements_along_a_recording_are_reported_and_plotted(records, tmp_path, capsys):
    assert assess(records[0], "--windows-s", "11", "--out", str(tmp_path / "o")) == 0
    text = capsys.readouterr().out
    assert "Centre of mass over time, 4 windows" in text
    assert "Allan deviation, 22 s" in text
    assert (tmp_path / "o" / "figures" / "com_over_hours.svg").exists()


def test_a_generous_requirement_passes(records, capsys):
    assert assess(records[0], "--require-torque", "0.1", "--tilt-deg", "5") == 0
    assert "within 5 deg of level" in capsys.readouterr().out


def test_without_a_requirement_there_is_no_verdict(records, capsys):
    assert assess(records[0]) == 0
    assert "No requirement was stated" in capsys.readouterr().out


def test_two_recordings_are_compared_and_the_document_holds_both(
    records, tmp_path, capsys, strict_json
):
    """SI units: 43 um off before, the masses at home; lower by 2 x 15.6 g x 50 mm / 14.24 kg."""
    folder = tmp_path / "out"
    words = ("--before", str(records[0]), "--json", "--out", str(folder))
    assert assess(records[1], *words) == 0
    document = strict_json(capsys.readouterr().out)
    assert document["schema"] == "equipoise/assess/2"
    assert document["verdict"] is None
    fell = document["before"]["com"]["value_m"][2] - document["com"]["value_m"][2]
    assert fell == pytest.approx(2 * 0.0156 * 0.05 / 14.24, rel=0.15)
    assert (
        document["torque_in_range"]["rms_N_m"]["low"]
        > document["before"]["torque_in_range"]["rms_N_m"]["high"]
    )
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "increased by a factor" in page
    assert (folder / "assess.json").exists()
    drawn = {path.stem for path in folder.glob("figures/*.svg")}
    assert {"torque_in_range", "residual_torque", "swing_spectrum"} <= drawn


def test_cross_checks_are_shown_and_one_that_disagrees_ends_with_one(
    records, tmp_path, capsys, strict_json, monkeypatch
):
    """The fit put a fifth lower: torque knows the height to 1 %."""
    assert assess(records[1]) == 0
    text = capsys.readouterr().out
    assert "Cross-check, torque: " in text
    assert "It counts, and agrees." in text
    monkeypatch.setattr(assessment, "fit_of", lowered)
    folder = tmp_path / "out"
    assert assess(records[1], "--out", str(folder)) == 1
    text = " ".join(capsys.readouterr().out.split())
    assert "It counts, and disagrees." in text
    assert "Cannot tell: " in text
    assert "cross-checks at the same inertia disagree by up to" in text
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "It counts, and disagrees." in page
    assert assess(records[1], "--json") == 1
    document = strict_json(capsys.readouterr().out)
    assert document["estimate"]["outcome"]["trust"] == "not_trustworthy"
    checks = {check["metric"]: check for check in document["cross_checks"]}
    assert (checks["torque"]["counts"], checks["torque"]["disagrees"]) == (True, True)
    assert checks["torque"]["off_sd"] > 5


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (("--require-torque", "0"), "--require-torque"),
        (("--tilt-deg", "91"), "at most 90"),
        (("--hold", "com_q"), "com_z"),
    ],
)
def test_wrong_usage_is_reported(records, capsys, words, reported):
    assert assess(records[0], *words) == 2
    assert reported in capsys.readouterr().err
