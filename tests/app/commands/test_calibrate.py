"""`equipoise calibrate` from the command line: moves, tables, JSON, and the file it writes."""

import pytest

from equipoise.app.cli import run
from equipoise.io.testbed.presets import preset_text
from equipoise.io.testbed.testbed_file import read_testbed

DRIVE = """[[truth.drive]]
mass = "x1"
gain = 1.05
axis = [1.0, 0.0, 0.0]

[assumed]"""
MOVES = (("20", "10"), ("40", "20"), ("60", "0"), ("80", "-20"), ("100", "-10"), ("120", "0"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with a testbed and a record of moves."""
    path = tmp_path_factory.mktemp("calibrate")
    text = preset_text("sputnix").replace("[assumed]", DRIVE)
    (path / "my.toml").write_text(text, encoding="utf-8")
    words = ["simulate", str(path / "my.toml"), "--out", str(path / "run.csv")]
    words += ["--duration-s", "140", "--seed", "8"]  # such moves throw most others on their stop
    for time, goal in MOVES:
        words += ["--move", f"{time}: x1={goal}"]
    assert run(words) == 0
    return path


def calibrate(folder, *more):
    return run(["calibrate", str(folder / "run.csv"), "--testbed", str(folder / "my.toml"), *more])


def test_it_says_what_it_found_and_writes_it_with_the_comments(folder, capsys):
    assert calibrate(folder, "--hold", "inertia_P_zz", "--write", str(folder / "new.toml")) == 0
    said = capsys.readouterr().out
    assert "backlash, mm" in said
    assert "Never moved, hence not calibrated: x2, y1, y2, z1, z2." in said
    assert "is fixed by the stated inertia" in said
    assert "not written to a testbed file" in " ".join(said.split())
    text = (folder / "new.toml").read_text(encoding="utf-8")
    assert "# from CAD, without the cabling" in text
    assert "# calibrated: " in text
    before, after = (read_testbed(folder / f"{name}.toml").masses for name in ("my", "new"))
    assert after[0].gain != before[0].gain
    assert [m.gain for m in after[1:]] == [1.0] * 5


def test_json_is_one_document_with_null_for_what_was_not_shown(folder, capsys, strict_json):
    assert calibrate(folder, "--reference", "x1", "--json") == 0
    document = strict_json(capsys.readouterr().out)
    values = {p["name"]: p for p in document["parameters"]}
    assert document["method"] == "calibration"
    assert values["gain_x1"]["value"] == 1.0
    assert values["axis_x1_y"]["sd"] > 0


def test_moves_are_printed_as_a_command(folder, capsys):
    assert run(["calibrate", "--testbed", str(folder / "my.toml"), "--moves"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("equipoise simulate ")
    assert said.count("--move ") == 36


def test_neither_a_record_nor_moves_is_wrong_use(folder, capsys):
    assert run(["calibrate", "--testbed", str(folder / "my.toml")]) == 2
    assert "--moves" in capsys.readouterr().err
