"""Arrays in memory become a recording by the rules that a file with the same numbers meets."""

import math

import numpy as np
import pytest

import equipoise as eq
from equipoise.io.formats.mat_table import mat_bytes
from equipoise.maths.attitude import conjugate, exponential, multiply
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS

N = 100
T = np.arange(N) * 0.1
Q = exponential(np.outer(T, [0.0, 0.02, 0.3]))
RATE = np.tile([0.01, 0.02, 0.3], (N, 1))
X1 = np.where(T < 5.0, 0.0, 0.010)
NAMES = ("time_s", *(f"q_{c}" for c in "wxyz"), *(f"omega_{c}_rad_s" for c in "xyz"))
made = eq.Recording.from_arrays


def same(one: eq.Recording, other: eq.Recording) -> None:
    for name in CHANNELS:
        a, b = getattr(one, name), getattr(other, name)
        assert (a is None) == (b is None), name
        if a is not None:
            np.testing.assert_array_equal(a.t, b.t)
            np.testing.assert_allclose(a.values, b.values, rtol=1e-13, atol=1e-15)


def test_arrays_come_back_as_they_were_in_a_recording_of_the_one_class():
    field = np.tile([1e-5, 2e-5, 3e-5], (N, 1))
    recording = made(T, q=Q, rate=RATE, masses={"x1": X1}, field=field, source="rig 3")
    assert type(recording) is eq.Recording
    assert recording.source == "rig 3"
    assert recording.notes == ()
    assert recording.mass_names == ("x1",)
    for channel, values in (("attitude", Q), ("rate", RATE), ("masses", X1[:, None]),
                            ("field", field)):  # fmt: skip
        np.testing.assert_array_equal(getattr(recording, channel).t, T)
        np.testing.assert_array_equal(getattr(recording, channel).values, values)


def faulty() -> np.ndarray:
    """Return a table with a fault of each kind, each in one row."""
    rows = np.column_stack([T, Q, RATE])
    rows[10, 1:] = np.nan
    rows[20, 1:5] = 0.0
    rows[30, 0] = rows[29, 0]
    rows[40, 3] = np.inf
    rows[50, 0] = 0.25
    rows[60:, 1:5] *= -1.0
    return rows


def test_faulty_rows_meet_the_rules_of_a_file(tmp_path):
    """NaN throughout, a zero quaternion, a repeat, infinity and a stamp behind; a flipped sign."""
    rows = faulty()
    (tmp_path / "r.mat").write_bytes(mat_bytes(dict(zip(NAMES, rows.T, strict=True))))
    ours = made(rows[:, 0], q=rows[:, 1:5], rate=rows[:, 5:])
    same(ours, eq.read_recording(tmp_path / "r.mat"))
    np.testing.assert_array_equal(ours.attitude.t, np.delete(T, [10, 20, 30, 40, 50]))
    noted = " ".join(ours.notes)
    for words in ("no number, row 11, row 41", "unit length, row 21", "time stamp, row 31",
                  "out of order, row 51", "changed its sign"):  # fmt: skip
        assert words in noted


def test_a_share_of_faulty_rows_is_refused_beyond_bad_rows():
    broken = Q.copy()
    broken[5:15] = 0.0
    with pytest.raises(InputError, match=r"^arrays, row 6: found a quaternion of length 0 \(10 of"):
        made(T, q=broken)
    assert len(made(T, q=broken, bad_rows=0.1).attitude) == N - 10


def test_a_quaternion_may_end_with_its_scalar():
    same(made(T, q=Q[:, [1, 2, 3, 0]], order="xyzw"), made(T, q=Q))


def test_an_attitude_may_turn_the_laboratory_into_the_body():
    same(made(T, q=conjugate(Q), turns="laboratory to body"), made(T, q=Q))


def test_angles_are_an_attitude():
    """Yaw about z by 0.3 rad/s, then 5 deg of pitch about the turned y."""
    yaw, pitch = np.degrees(0.3 * T), np.full(N, 5.0)
    angles = np.column_stack([yaw, pitch, np.zeros(N)])
    found = made(T, euler=angles, sequence="ZYX", euler_unit="deg").attitude.values
    turned = multiply(
        exponential(np.outer(0.3 * T, [0, 0, 1])), exponential(np.array([0, math.radians(5), 0]))
    )
    np.testing.assert_allclose(found, turned, atol=1e-12)


def test_units_of_a_rate():
    same(made(T, rate=np.degrees(RATE), rate_unit="deg/s"), made(T, rate=RATE))


def test_axes_are_turned_as_a_column_map_turns_them(tmp_path):
    """Y up, and our axes x, -z, y of the arrays'."""
    names = {"t": T, **dict(zip("abcd", Q.T, strict=True)), **dict(zip("efg", RATE.T, strict=True))}
    (tmp_path / "r.mat").write_bytes(mat_bytes(names))
    (tmp_path / "map.toml").write_text(
        'lab_up = "y"\nbody = ["x", "-z", "y"]\n[time]\ncolumn = "t"\nunit = "s"\n'
        '[attitude]\ncolumns = ["a", "b", "c", "d"]\norder = "wxyz"\n'
        '[rate]\ncolumns = ["e", "f", "g"]\nunit = "rad/s"\n'
    )
    by_map = eq.read_recording(tmp_path / "r.mat", columns=tmp_path / "map.toml")
    same(made(T, q=Q, rate=RATE, lab_up="y", body=("x", "-z", "y")), by_map)


def test_each_channel_keeps_its_own_times():
    """A gyro ten times as fast, half a step late, and two rows of a mass."""
    fast = 0.005 + np.arange(900) * 0.01
    rate = np.outer(np.sin(fast), [1.0, 2.0, 3.0]) + 0.1
    recording = made(T, q=Q, rate=rate, rate_t=fast, masses={"x1": [0.0, 0.01]}, masses_t=[0.0, 5])
    np.testing.assert_array_equal(recording.attitude.t, T)
    np.testing.assert_array_equal(recording.rate.t, fast)
    np.testing.assert_array_equal(recording.rate.values, rate)
    np.testing.assert_array_equal(recording.masses.t, [0.0, 5.0])


def test_clocks_that_count_from_1970_have_one_zero():
    """The gyro begins 0.25 s after the camera."""
    zero = 1_714_745_500.0
    late = zero + 0.25 + np.arange(50) * 0.1
    recording = made(zero + T, q=Q, rate=RATE[:50], rate_t=late)
    np.testing.assert_allclose(recording.attitude.t, T, atol=1e-6)
    np.testing.assert_allclose(recording.rate.t, late - zero, atol=1e-6)
    assert recording.notes == ("The clock starts at 1714745500.000 s; this is taken as zero.",)


def test_dates_are_times():
    zero = np.datetime64("2024-05-03T14:11:40.123", "ns")
    dates = zero + (T * 1e9).round().astype("timedelta64[ns]")
    recording = made(dates, q=Q, rate=RATE, rate_t=dates + np.timedelta64(20, "ms"))
    np.testing.assert_allclose(recording.attitude.t, T, atol=1e-9)
    np.testing.assert_allclose(recording.rate.t, T + 0.02, atol=1e-9)
    assert "The clock starts at 2024-05-03T14:11:40.123000000" in recording.notes[0]


WRONG = {
    "t": ({"t": np.zeros((N, 2)), "q": Q}, r"t: found an array of shape \(100, 2\)"),
    "t of words": ({"t": ["a"] * N, "q": Q}, "t: found neither numbers nor dates"),
    "no t": ({"t": [], "q": Q}, r"t: found an array of shape \(0,\)"),
    "q across": ({"q": Q.T}, r"q: found an array of shape \(4, 100\); wanted \(100, 4\): a row"),
    "q of three": ({"q": Q[:, :3]}, r"q: found an array of shape \(100, 3\)"),
    "q too short": ({"q": Q[:-1]}, r"q: found an array of shape \(99, 4\).*100 times in t"),
    "q of words": ({"q": [["a"] * 4] * N}, "q: found not an array of numbers"),
    "ragged q": ({"q": [[1, 0, 0], [1, 0, 0, 0]]}, "q: found not an array of numbers"),
    "order": ({"q": Q, "order": "wxzy"}, "order: found 'wxzy'; did you mean 'wxyz'"),
    "turns": ({"q": Q, "turns": "body to lab"}, "turns: found 'body to lab'; did you mean 'body"),
    "both": ({"q": Q, "euler": Q[:, :3]}, "q and euler: found both"),
    "euler": ({"euler": Q, "sequence": "ZYX"}, r"euler: found an array of shape \(100, 4\)"),
    "no sequence": ({"euler": Q[:, :3]}, "sequence: found none"),
    "sequence": ({"euler": Q[:, :3], "sequence": "ZyX"}, "sequence: found 'ZyX'"),
    "euler_unit": (
        {"euler": Q[:, :3], "sequence": "ZYX", "euler_unit": "degree"},
        "euler_unit: found unit 'degree'; did you mean 'deg'",
    ),
    "rate": ({"rate": RATE[:, 0]}, r"rate: found an array of shape \(100,\); wanted \(100, 3\)"),
    "rate_unit": ({"rate": RATE, "rate_unit": "deg"}, "rate_unit: found unit 'deg'"),
    "rate_t": (
        {"rate": RATE, "rate_t": T[:9]},
        r"rate: found .* \(100, 3\); wanted \(9, 3\): a row for each of the 9 times in rate_t",
    ),
    "another clock": (
        {"q": Q, "rate": RATE, "rate_t": 1.7e9 + T},
        "rate_t: found a clock that starts 1.7e.09 s after the zero of t",
    ),
    "dates beside numbers": (
        {"q": Q, "rate": RATE, "rate_t": np.zeros(N, "datetime64[ns]")},
        "rate_t: found times of another kind than in t",
    ),
    "masses": ({"q": Q, "masses": {"x1": X1[:-1]}}, r"masses\['x1'\]: found an array of shape"),
    "field": ({"q": Q, "field": np.zeros(3)}, r"field: found an array of shape \(3,\)"),
    "lab_up": ({"q": Q, "lab_up": "up"}, "lab_up: found 'up'"),
    "body": ({"q": Q, "body": ("x", "z", "y")}, "body: found .*right-handed"),
    "body of words": ({"q": Q, "body": ("x", "up", "y")}, "body: found .*three axes"),
    "nothing": ({}, "neither q, euler nor rate"),
    "masses alone": ({"masses": {"x1": X1}}, "neither attitude nor rate"),
}


@pytest.mark.parametrize(("stated", "words"), WRONG.values(), ids=WRONG.keys())
def test_what_is_wrong_is_named_by_its_argument(stated, words):
    with pytest.raises(InputError, match=words):
        made(**{"t": T, **stated})


def test_a_share_that_is_none_is_named():
    with pytest.raises(InputError, match="bad_rows: found 1; wanted a fraction"):
        made(T, q=Q, bad_rows=1.0)


def test_a_recording_of_arrays_is_identified_as_its_file_is(returned):
    """Every verb takes it."""
    read = returned.results["Recording"]
    masses = dict(zip(read.mass_names, read.masses.values.T, strict=True))
    ours = made(read.attitude.t, q=read.attitude.values, masses=masses, masses_t=read.masses.t)
    same(ours, read)
    found = eq.observe(ours, "sputnix").to_dict()["parameters"]
    assert found == returned.results["observe"].to_dict()["parameters"]
