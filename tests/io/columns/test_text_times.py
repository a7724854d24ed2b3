"""Times that are text: dates and clocks of the day, as a column map declares them."""

import numpy as np
import pytest

from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError

RATE = '[rate]\ncolumns = ["gx", "gy", "gz"]\nunit = "rad/s"\n'


def read(tmp_path, written: str, times: list[str], **options):
    """Write a table with times as text, and a map that says how they are written; read it."""
    rows = [f"{time};{0.1 * i};0.2;0.3" for i, time in enumerate(times, 1)]
    (tmp_path / "r.csv").write_text("\n".join(["when;gx;gy;gz", *rows]) + "\n")
    (tmp_path / "map.toml").write_text(f'[time]\ncolumn = "when"\n{written}\n{RATE}')
    columns = read_column_map(tmp_path / "map.toml")
    return read_recording(tmp_path / "r.csv", ReadOptions(columns=columns, **options))


DATES = {
    "plain": ("2024-05-03T23:59:59.750", "2024-05-04T00:00:00.000", "2024-05-04T00:00:00.250"),
    "zone": ("2024-05-03 21:59:59.75Z", "2024-05-04 02:00:00+04:00", "2024-05-03 22:00:00.25Z"),
    "comma": ("2024-05-03 23:59:59,750", "2024-05-04 00:00:00,000", "2024-05-04 00:00:00,250"),
}


@pytest.mark.parametrize("times", DATES.values(), ids=DATES.keys())
def test_dates_are_seconds_since_the_first(tmp_path, times) -> None:
    """Over midnight; a quarter of a second comes out exactly."""
    recording = read(tmp_path, 'format = "ISO"', [*times])
    np.testing.assert_array_equal(recording.rate.t, [0.0, 0.25, 0.5])
    assert any("clock starts at 2024-05-03" in note for note in recording.notes)


def test_a_clock_of_the_day_goes_on_over_midnight(tmp_path) -> None:
    """It restarts at 24 h, which is said."""
    times = ["23:59:59.50", "23:59:59.75", "00:00:00.00", "00:00:00.25"]
    recording = read(tmp_path, 'format = "clock of the day"', times)
    np.testing.assert_allclose(np.diff(recording.rate.t), 0.25, atol=1e-9)
    np.testing.assert_allclose(recording.rate.t[0], 23 * 3600 + 59 * 60 + 59.5, atol=1e-9)


def test_a_cell_that_is_no_time_is_a_faulty_row(tmp_path) -> None:
    """It is left out with its line, like any other."""
    times = ["10:00:00", "10:00:01", "soon", "10:00:03", "10:00:04"]
    recording = read(tmp_path, 'format = "clock of the day"', times, bad_rows=0.3)
    np.testing.assert_array_equal(recording.rate.t, 36_000 + np.array([0.0, 1.0, 3.0, 4.0]))
    assert any("line 4" in note for note in recording.notes)


BAD = {
    "no date": ('format = "ISO"', "10:00", "r.csv, line 2, column 'when': found '10:00'"),
    "no clock": ('format = "clock of the day"', "5.5", "a time as '14:11:40.123'"),
    "both": ('format = "ISO"\nunit = "s"', "5.5", ": time: found 'unit' and 'format'"),
    "neither": ("", "5.5", ": time: found neither 'unit' nor 'format'"),
    "another": ('format = "US"', "5.5", "'ISO' or 'clock of the day'"),
}


@pytest.mark.parametrize(("written", "time", "words"), BAD.values(), ids=BAD.keys())
def test_times_that_are_not_as_declared_are_refused(tmp_path, written, time, words) -> None:
    """Where, what was found, and how it should be."""
    with pytest.raises(InputError) as caught:
        read(tmp_path, written, [time] * 4)
    assert words in str(caught.value)
