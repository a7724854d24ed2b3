"""DataFrames become recordings by the rules that a file with the same columns meets."""

import numpy as np
import pytest

import equipoise as eq
from equipoise.maths.attitude import exponential
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording, Samples

pandas = pytest.importorskip("pandas", reason="pandas is not pinned yet: make pins")

N = 100
T = np.arange(N) * 0.1
Q = exponential(np.outer(T, [0.0, 0.02, 0.3]))
RATE = np.tile([0.01, 0.02, 0.3], (N, 1))
TURN = dict(zip(("q_w", "q_x", "q_y", "q_z"), Q.T, strict=True))
NATIVE = {**TURN, "mass_x1_mm": np.full(N, 5.0)}
made = eq.Recording.from_pandas


def holds(recording: Recording) -> None:
    np.testing.assert_allclose(recording.attitude.t, T, atol=1e-9)
    np.testing.assert_allclose(recording.attitude.values, Q, atol=1e-15)


def test_native_columns_are_known_by_their_names():
    recording = made(pandas.DataFrame({"time_s": T, **NATIVE}), source="rig 3")
    holds(recording)
    assert type(recording) is eq.Recording
    assert recording.source == "rig 3"
    assert recording.mass_names == ("x1",)
    np.testing.assert_allclose(recording.masses.values, 0.005)  # m


DATES = pandas.date_range("2024-05-03T14:11:40.123", periods=N, freq="100ms")
INDICES = {
    "seconds": pandas.Index(T),
    "named as ours": pandas.Index(T, name="time_s"),
    "named otherwise": pandas.Index(T, name="t"),
    "dates": DATES,
    "dates of a zone": DATES.tz_localize("Europe/Berlin"),
    "spans": pandas.to_timedelta(T, unit="s"),
}


@pytest.mark.parametrize("index", INDICES.values(), ids=INDICES.keys())
def test_the_index_may_be_the_time(index):
    recording = made(pandas.DataFrame(NATIVE, index=index))
    holds(recording)
    assert not any("ignored" in note for note in recording.notes)


def test_dates_say_where_the_clock_starts():
    noted = made(pandas.DataFrame(NATIVE, index=DATES)).notes
    assert noted == ("The clock starts at 2024-05-03T14:11:40.123000000; this is taken as zero.",)


def test_a_column_of_dates_may_be_the_time():
    holds(made(pandas.DataFrame({"time_s": DATES, **NATIVE})))


def test_whole_numbers_of_an_index_are_no_times():
    """They are left where rows were left out."""
    with pytest.raises(InputError, match="no column 'time_s'"):
        made(pandas.DataFrame(NATIVE)[10:])


def test_other_programs_columns_are_known_too():
    """Of ROS, and roll, pitch and yaw over an index of dates; a column goes before the index."""
    ros = {f"/imu/orientation/{letter}": column for letter, column in zip("wxyz", Q.T, strict=True)}
    holds(made(pandas.DataFrame({"__time": T, **ros}, index=T[::-1])))
    angles = {"roll_deg": np.zeros(N), "pitch_deg": np.zeros(N), "yaw_deg": np.degrees(0.3 * T)}
    turned = made(pandas.DataFrame(angles, index=DATES)).attitude
    np.testing.assert_allclose(turned.t, T, atol=1e-9)
    np.testing.assert_allclose(turned.values, exponential(np.outer(T, [0, 0, 0.3])), atol=1e-12)


MAP = '[time]\ncolumn = "t"\n{}\n[attitude]\ncolumns = ["a", "b", "c", "d"]\norder = "wxyz"\n'
MAPPED = dict(zip("abcd", Q.T, strict=True))


@pytest.mark.parametrize(
    ("time", "stated"),
    [
        (1000 * T, 'unit = "ms"'),
        (DATES, 'unit = "ms"'),
        (DATES.strftime("%Y-%m-%dT%H:%M:%S.%f"), 'format = "ISO"'),
    ],
    ids=["numbers", "dates", "text"],
)
@pytest.mark.parametrize("where", ["column", "index"])
def test_a_column_map_names_the_columns(tmp_path, time, stated, where):
    (tmp_path / "map.toml").write_text(MAP.format(stated))
    index = pandas.Index(time, name="t") if where == "index" else None
    of_time = {} if where == "index" else {"t": time}
    frame = pandas.DataFrame({**of_time, **MAPPED}, index=index)
    for path in (tmp_path / "map.toml", str(tmp_path / "map.toml")):
        holds(made(frame, columns=path))


def test_an_index_without_a_name_is_the_time_that_a_map_names(tmp_path):
    (tmp_path / "map.toml").write_text(MAP.format('unit = "s"'))
    holds(made(pandas.DataFrame(MAPPED, index=DATES), columns=tmp_path / "map.toml"))


def test_no_reading_is_no_fault_and_a_faulty_row_is_left_out():
    """NaN or None throughout says nothing; a blank beside numbers, a zero quaternion are faults."""
    frame = pandas.DataFrame({"time_s": T, **TURN}).astype("Float64")
    frame.loc[10:49, list(TURN)] = None
    frame.loc[60, "q_x"] = None
    frame.loc[70, list(TURN)] = 0.0
    recording = made(frame)
    kept = np.delete(T, [*range(10, 50), 60, 70])
    np.testing.assert_array_equal(recording.attitude.t, kept)
    noted = " ".join(recording.notes)
    assert "1 row with a blank cell beside numbers, row 61; left out." in noted
    assert "unit length, row 71" in noted


def everything() -> Recording:
    """Return a recording with every channel, each at its own times."""
    rng = np.random.default_rng(1)

    def rows(k: int, start: float) -> Samples:
        return Samples(start + T, rng.normal(size=(N, k)))

    return Recording(
        attitude=Samples(T, Q), rate=rows(3, 0.01), mass_names=("x1", "z_2"), masses=rows(2, 0.02),
        momentum=rows(3, 0.03), torque=rows(3, 0.0), field=rows(3, 0.04),
        device_names=("wheel:x", "gimbal:a_b", "dipole:x", "jet:x"), devices=rows(4, 0.05),
        temperature=rows(1, 0.0), lamp=rows(1, 0.0), accelerometer=rows(3, 0.06),
        sun=rows(3, 0.07), position=rows(2, 0.08),
        cause_names=("sag_x", "sag_sd_x"), torque_by_cause=rows(2, 0.09),
    )  # fmt: skip


def test_what_to_pandas_gives_comes_back():
    recording = everything()
    again = made(recording.to_pandas())
    assert again.notes == ()
    assert again.mass_names == recording.mass_names
    assert again.device_names == recording.device_names
    assert again.cause_names == recording.cause_names
    for name in CHANNELS:
        ours, theirs = getattr(again, name), getattr(recording, name)
        np.testing.assert_array_equal(ours.t, theirs.t)
        np.testing.assert_array_equal(ours.values, theirs.values)


TWICE = pandas.DataFrame(np.column_stack([T, Q, Q[:, 0]]), columns=["time_s", *TURN, "q_w"])
WRONG = {
    "a list": ([1, 2], {}, "from_pandas: frame: found a list; wanted a pandas DataFrame"),
    "a dictionary": (NATIVE, {}, "frame: found a dict"),
    "no rows": (pandas.DataFrame({"time_s": [], "q_w": []}), {}, "frame: found no rows"),
    "unknown columns": (
        pandas.DataFrame({"a": T, "b": T}, index=DATES), {}, "columns time_s, a, b; wanted",
    ),
    "nearly ours": (
        pandas.DataFrame({"time_s": T, **TURN, "mass_x1_cm": T}), {}, "'mass_<name>_mm'",
    ),
    "words": (
        pandas.DataFrame({"time_s": T, **TURN, "q_x": ["so"] * N}), {},
        "frame, column 'q_x': found values of type .*; wanted numbers",
    ),
    "a name twice": (TWICE, {}, "two columns 'q_w'"),
    "a share": (pandas.DataFrame(NATIVE, index=DATES), {"bad_rows": -0.1}, "bad_rows: found -0.1"),
    "two rows": (pandas.DataFrame(NATIVE, index=DATES)[:2], {}, "2 rows of attitude"),
}  # fmt: skip


@pytest.mark.parametrize(("frame", "stated", "words"), WRONG.values(), ids=WRONG.keys())
def test_what_is_wrong_is_named(frame, stated, words):
    with pytest.raises(InputError, match=words):
        made(frame, **stated)
