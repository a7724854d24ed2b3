"""``docs/recordings.md``: every map is read, every command and the Python run as they stand."""

import contextlib
import io
import math
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomlkit
from pydantic import BaseModel

from equipoise.app.cli import run
from equipoise.io.columns import column_map_file
from equipoise.io.columns.attitude_table import AttitudeTable
from equipoise.io.columns.column_map_file import MapFile, read_column_map
from equipoise.io.columns.read_options import BAD_ROWS, ReadOptions
from equipoise.io.formats.long_text import LONG
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.testbed_file import read_testbed
from tests.docs.test_examples import ROOT, Block, blocks, commands, run_python
from tests.io.dialects.test_motion_capture import motive
from tests.support.flight_logs import flight
from tests.support.odd_table import AT_REST, COUNTS, WIRED, odd_table
from tests.support.sample_logs import IMU, bag_2_mcap_file

TEXT = (ROOT / "docs" / "recordings.md").read_text(encoding="utf-8")
BLOCKS = blocks(TEXT)
MAPS = [block for block in BLOCKS if block.kind == "toml"]
COMMANDS = [command for block in BLOCKS for command in commands(block)]
TUTORIAL = blocks((ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory) -> Path:
    """Return a folder with the files that the page names."""
    folder = tmp_path_factory.mktemp("laboratory")
    (folder / "log.csv").write_text(odd_table())
    (folder / "my.toml").write_text(next(b.text for b in TUTORIAL if b.kind == "toml"))
    (folder / "take.csv").write_text(motive("Base", "Platform"))
    (folder / "flight.bin").write_bytes(flight("XKQ", "IMU"))
    topics = {"/imu": IMU, "/imu_below": IMU}
    shutil.copy(bag_2_mcap_file(folder / "bag", topics), folder / "bench.mcap")
    return folder


@pytest.fixture
def here(laboratory, monkeypatch) -> Path:
    monkeypatch.chdir(laboratory)
    monkeypatch.setenv("EQUIPOISE_RUNS", "")
    return laboratory


def output_of(*words: str) -> tuple[int, str]:
    """Return exit code and output of a command."""
    with contextlib.redirect_stdout(io.StringIO()) as stream:
        code = run(words)
    return code, stream.getvalue()


def whole_map(block: Block) -> str:
    """Return a map's text; what a part of one lacks is that of the first."""
    first, part = (dict(tomlkit.parse(each.text)) for each in (MAPS[0], block))
    return tomlkit.dumps(part if "time" in part and len(part) > 1 else first | part)


def read_map(block: Block, folder: Path) -> Any:
    path = folder / f"line_{block.line}.toml"
    path.write_text(whole_map(block))
    return read_column_map(path)


@pytest.mark.parametrize("block", MAPS, ids=lambda block: f"line {block.line}")
def test_every_map_of_the_page_is_one(block, tmp_path):
    read_map(block, tmp_path)


def test_the_page_has_every_key_of_a_map():
    tables = [each for each in vars(column_map_file).values() if isinstance(each, type)]
    tables = [each for each in tables if issubclass(each, BaseModel)]
    keys = {key for table in (*tables, AttitudeTable) for key in table.model_fields}
    assert {"lab_up", "sequence", "factor", "reports"} <= keys
    assert [key for key in sorted(keys) if not re.search(rf"\b{key}\b", TEXT)] == []
    assert {*MapFile.model_fields} <= keys


def test_every_command_of_the_page_runs(here):
    codes = [(line, output_of(*words[1:])[0]) for line, words in COMMANDS]
    assert len(codes) == 7
    assert [line for line, code in codes if code != 0] == []


def test_the_map_of_the_page_reads_what_import_finds_less_the_counts_at_rest(here, tmp_path):
    output_of("import", "log.csv", "--testbed", "my.toml", "--write-map", f"{tmp_path}/found.toml")
    found = read_column_map(tmp_path / "found.toml")
    by_import = read_recording("log.csv", ReadOptions(columns=found))
    by_page = read_recording("log.csv", ReadOptions(columns=read_map(MAPS[0], tmp_path)))
    np.testing.assert_array_equal(by_page.attitude.values, by_import.attitude.values)
    at_rest = np.radians(WIRED * AT_REST / COUNTS)
    # The page's factor has six digits, import's too: 1e-5 of rates up to 1 rad/s.
    np.testing.assert_allclose(
        by_import.rate.values - by_page.rate.values, at_rest[None].repeat(2998, 0), atol=1e-5
    )


def test_readings_that_are_alike_are_listed_and_nothing_is_written(here, tmp_path):
    rows = [line.split(",")[:5] for line in Path("log.csv").read_text().splitlines()]
    (tmp_path / "no_gyro.csv").write_text("\n".join(map(",".join, rows)))
    words = ("import", f"{tmp_path}/no_gyro.csv", "--write-map", f"{tmp_path}/map.toml")
    code, out = output_of(*words)
    assert code == 1
    assert "The numbers support 2 interpretations equally: choose one, --choose 1 to 2." in out
    assert not (tmp_path / "map.toml").exists()
    assert output_of(*words, "--choose", "2")[0] == 0
    assert (tmp_path / "map.toml").exists()


def test_the_python_of_the_page_runs(here):
    (block,) = (block for block in BLOCKS if block.text.startswith("import equipoise"))
    output_of("import", "log.csv", "--write-map", "map.toml")
    namespace: dict[str, Any] = {}
    with contextlib.redirect_stdout(io.StringIO()):
        run_python(block, "recordings.md", namespace)
    assert namespace["found"].estimate.outcome.usable


def test_numbers_of_the_page_are_those_of_the_code():
    assert f"Up to {100 * BAD_ROWS:g} % of the rows may be left out." in TEXT
    assert f"the same beyond {LONG / 1e6:g} MB" in TEXT


def test_the_sensors_of_a_platform_without_a_camera_are_a_testbeds(tmp_path):
    """In place of the camera of a testbed file."""
    (block,) = (b for b in BLOCKS if b.kind == "text" and "[sensor.accelerometer]" in b.text)
    whole = tomlkit.parse(next(b.text for b in TUTORIAL if b.kind == "toml")).unwrap()
    (tmp_path / "blind.toml").write_text(tomlkit.dumps(whole | tomlkit.parse(block.text).unwrap()))
    bed = read_testbed(tmp_path / "blind.toml")
    assert bed.attitude is None
    assert bed.accelerometer.place == pytest.approx([0.08, -0.05, 0.06])
    assert bed.accelerometer.mounting_sd == pytest.approx(math.radians(0.5))
