"""Every bad input of the issue: exit code 2, one sentence with its place, nothing written.

``tests/io`` has the sentences in full; here they come through the command line.
"""

import numpy as np
import pytest

from equipoise.io.testbed.presets import preset_text

PRESET = preset_text("sputnix")
HEAD = "time_s,q_w,q_x,q_y,q_z\n"
ROWS = [f"{0.2 * i:.1f},1,0,0,{0.0001 * i}\n" for i in range(40)]
GOOD = HEAD + "".join(ROWS)
CAD = "[0.3309, 0.0018, 0.0373]"
UPSIDE_DOWN = GOOD.replace(",1,0,0,", ",0,1,0,")

TESTBEDS = {
    "misspelt key": ("mass_kg", "mas_kg", ["platform.mas_kg", "'mass_kg'"]),
    "unknown key": ("[sensor.attitude]", "[sensor.atitude]", ["sensor.atitude"]),
    "missing key": ("mass_kg = 14.24", "", ["platform.mass_kg"]),
    "negative mass": ("mass_kg = 14.24", "mass_kg = -14.24", ["platform.mass_kg", "above 0"]),
    "impossible inertia": (CAD, "[3.309, 0.0018, 0.0373]", ["platform.inertia_kg_m2"]),
    "axis of zero length": ("axis = [1.0, 0.0, 0.0]", "axis = [0, 0, 0]", ["sliding_mass[1].axis"]),
    "unit in the wrong place": (
        "mass_kg = 14.24",
        'mass = "14 kg"',
        ["platform.mass", "'mass_kg'"],
    ),
    "no TOML": ("[platform]", "[platform", ["line "]),
}
RECORDINGS = {
    "missing column": (GOOD.replace("q_z", "other"), ["header", "q_z"]),
    "text in a number column": (HEAD + ROWS[0] + "0.2,abc,0,0,0\n", ["line 3", "'q_w'", "'abc'"]),
    "NaN row": (HEAD + ROWS[0] + "0.2,nan,nan,nan,nan\n" + ROWS[2], ["line 3", "'nan'"]),
    "empty file": ("", ["an empty file"]),
    "two samples": (HEAD + ROWS[0] + ROWS[1], ["2 rows", "at least 3"]),
    "time backwards": (
        HEAD + ROWS[0] + ROWS[2] + ROWS[1] + ROWS[3],
        ["line 4", "increasing times"],
    ),
    "quaternion far from unit": (
        HEAD + ROWS[0] + "0.2,2,0,0,0\n" + ROWS[2],
        ["line 3", "length 2"],
    ),
    "gravity does not point down": (UPSIDE_DOWN, ["gravity", "180 deg"]),
}


def check(done, folder, kept: set[str], words: list[str]) -> None:
    assert done.code == 2
    assert done.out == ""
    lines = [line for line in done.err.splitlines() if not line.endswith("...")]
    assert len(lines) == 1, lines
    assert "Traceback" not in done.err
    for word in words:
        assert word in lines[0]
    assert {path.name for path in folder.iterdir()} == kept


@pytest.mark.parametrize("bad", TESTBEDS.values(), ids=TESTBEDS.keys())
@pytest.mark.parametrize("command", ["simulate", "balance", "identify"])
def test_a_bad_testbed(equipoise, tmp_path, record_file, command, bad):
    found, put, words = bad
    assert found in PRESET
    (tmp_path / "bad.toml").write_text(PRESET.replace(found, put, 1))
    rest = {
        "simulate": ["bad.toml", "--out", "x.csv"],
        "balance": ["bad.toml", "--out", "here"],
        "identify": [record_file, "--testbed", "bad.toml", "--out", "here"],
    }
    check(equipoise(command, *rest[command]), tmp_path, {"bad.toml"}, ["bad.toml", *words])


@pytest.mark.parametrize(("text", "words"), RECORDINGS.values(), ids=RECORDINGS.keys())
def test_a_bad_recording(equipoise, tmp_path, text, words):
    (tmp_path / "run.csv").write_text(text)
    done = equipoise("identify", "run.csv", "--testbed", "sputnix", "--out", "here")
    check(done, tmp_path, {"run.csv"}, ["run.csv", *words])


def test_a_mass_that_the_testbed_does_not_have(equipoise, tmp_path):
    lines = [HEAD.strip() + ",mass_u1_mm", *(row.strip() + ",0" for row in ROWS)]
    (tmp_path / "run.csv").write_text("\n".join(lines))
    done = equipoise("identify", "run.csv", "--testbed", "sputnix", "--out", "here")
    check(done, tmp_path, {"run.csv"}, ["run.csv", "'u1'", "x1"])


def test_a_binary_recording(equipoise, tmp_path):
    (tmp_path / "run.csv").write_bytes(np.random.default_rng(1).bytes(500))
    for words in (["inspect", "run.csv"], ["identify", "run.csv", "--testbed", "sputnix"]):
        check(equipoise(*words), tmp_path, {"run.csv"}, ["run.csv", "binary"])


def test_the_good_table_is_good(equipoise, tmp_path):
    """The cases above fail for the reason they state."""
    (tmp_path / "run.csv").write_text(GOOD)
    assert equipoise("inspect", "run.csv", "--testbed", "sputnix").code == 0
