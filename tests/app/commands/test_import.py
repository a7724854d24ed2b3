"""`equipoise import`: a table of unknown columns, from its numbers to a recording."""

import numpy as np
import pytest

from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import conjugate, difference
from equipoise.model.recording import Recording
from equipoise.model.units import DEG, G0
from tests.oracle.corpus import corpus_record
from tests.oracle.vector_records import MPU6050, case
from tests.support.recordings.clock_guises import ticks_of_dot_net
from tests.support.recordings.frame_guises import accelerations, tilted, turned
from tests.support.recordings.recorded_motion import turning
from tests.support.recordings.written_tables import columns, saved, text

SEED = 27  # with camera and gyro; MuJoCo's


MEANINGLESS = tuple(f"c{k}" for k in range(8))


def table(path, recording: Recording, q=None, names=MEANINGLESS, clock=1e3) -> None:
    """Write rows at the camera's times: a clock, a quaternion, the gyro in deg/s.

    As many of these columns as there are names.
    """
    attitude, rate = recording.attitude, recording.rate
    assert attitude is not None
    assert rate is not None
    within = attitude.t <= rate.t[-1]
    t, q = attitude.t[within], (attitude.values if q is None else q)[within]
    w = np.stack([np.interp(t, rate.t, axis) for axis in rate.values.T], axis=1)
    whole = [np.round(t * clock, 3), *q.T, *(w.T / DEG)]
    columns = whole[: len(names)]
    rows = [",".join(f"{value:.9g}" for value in row) for row in zip(*columns, strict=True)]
    path.write_text("\n".join([",".join(names), *rows]) + "\n")


@pytest.fixture(scope="module")
def recording() -> Recording:
    return corpus_record(SEED).recording


def test_columns_without_meaning_are_read_and_the_map_reads_them_again(
    equipoise, tmp_path, recording
):
    """The attitude turns the other way; the gyro is in deg/s, the clock in milliseconds."""
    table(tmp_path / "raw.csv", recording, q=conjugate(recording.attitude.values))
    words = [str(tmp_path / "raw.csv"), "--write-map", str(tmp_path / "m.toml")]
    done = equipoise("import", *words, "--out", str(tmp_path / "run.csv"))
    assert done.code == 0
    assert "'c0' in ms" in done.out
    assert "laboratory to body" in done.out
    found = read_recording(tmp_path / "run.csv")
    q = recording.attitude.values[: len(found.attitude)]
    assert np.abs(np.sum(found.attitude.values * q, axis=1)).min() > 1 - 1e-9
    shown = equipoise("inspect", words[0], "--columns", str(tmp_path / "m.toml"))
    assert shown.code == 0
    assert "agree about x, y, z" in shown.out


def test_a_camera_alone_is_decided_by_a_testbed(equipoise, tmp_path, recording):
    """Without one both directions are shown; the second may be chosen by its number."""
    table(tmp_path / "raw.csv", recording, names=MEANINGLESS[:5])
    undecided = equipoise("import", str(tmp_path / "raw.csv"))
    assert undecided.code == 1
    assert "--choose 1 to 2" in undecided.out
    chosen = equipoise("import", str(tmp_path / "raw.csv"), "--choose", "2")
    assert chosen.code == 0
    beyond = equipoise("import", str(tmp_path / "raw.csv"), "--choose", "3")
    assert beyond.code == 2
    assert "1 to 2" in beyond.err


def test_a_table_without_any_attitude_gets_a_map_to_start_from(equipoise, tmp_path):
    """Its columns are named in it."""
    (tmp_path / "r.csv").write_text("alpha,beta\n1,2\n3,4\n5,9\n")
    done = equipoise("import", str(tmp_path / "r.csv"), "--write-map", str(tmp_path / "m.toml"))
    assert done.code == 1
    assert "'alpha', 'beta'" in (tmp_path / "m.toml").read_text()


def test_an_unknown_header_names_the_command(equipoise, tmp_path):
    """What to do next."""
    (tmp_path / "r.csv").write_text("alpha,beta\n1,2\n3,4\n5,9\n")
    done = equipoise("inspect", str(tmp_path / "r.csv"))
    assert done.code == 2
    assert "equipoise import" in done.err


def test_a_record_that_cannot_be_is_not_fitted_unless_it_is_forced(equipoise, tmp_path, recording):
    """A gyro in degrees that is declared in radians: ends with 1 and names the key."""
    names = ["__time", *(f"/imu/orientation/{a}" for a in "wxyz")]
    names += [f"/imu/angular_velocity/{a}" for a in "xzy"]
    table(tmp_path / "raw.csv", recording, names=names, clock=1.0)
    words = ["identify", str(tmp_path / "raw.csv"), "--testbed", "nanosat", "--prior"]
    done = equipoise(*words)
    assert done.code == 1
    assert "rate: axes" in done.err
    assert "--force" in done.err
    assert "nothing was fitted" not in equipoise(*words, "--force", "--method", "momentum-body").err


def test_a_header_that_says_it_all_claims_nothing_of_the_motion(equipoise, tmp_path, recording):
    """A gyro alone under our own names: no readings, so no motion decided between them."""
    rate = recording.rate
    rows = [
        ",".join(map(repr, map(float, (t, *w)))) for t, w in zip(rate.t, rate.values, strict=True)
    ]
    header = "time_s,omega_x_rad_s,omega_y_rad_s,omega_z_rad_s"
    (tmp_path / "gyro.csv").write_text("\n".join([header, *rows[:500]]) + "\n")
    done = equipoise("import", str(tmp_path / "gyro.csv"), "--testbed", "nanosat")
    assert done.code == 0
    assert "itself states what it holds" in done.out
    assert "motion" not in done.out


def test_the_document_says_what_the_terminal_says(equipoise, strict_json, tmp_path, recording):
    """What is read, what else it may be, and every sentence."""
    table(tmp_path / "raw.csv", recording)
    words = ["import", tmp_path / "raw.csv", "--out", tmp_path / "run.csv", "--json"]
    done = equipoise(*words)
    assert done.code == 0
    document = strict_json(done.out)
    assert document["outcome"] == "by numbers"
    assert document["taken"]["clock"]["unit"] == "ms"
    assert document["taken"]["gyro"]["unit"] == "deg/s"
    assert document["taken"] in document["alike"]
    printed = " ".join(equipoise("import", tmp_path / "raw.csv").out.split())
    assert [s for s in document["sentences"] if " ".join(s.split()) not in printed] == []
    assert "run.csv" in done.err


def test_the_document_of_an_open_table_lists_the_readings(
    equipoise, strict_json, tmp_path, recording
):
    table(tmp_path / "raw.csv", recording, names=MEANINGLESS[:5])
    done = equipoise("import", tmp_path / "raw.csv", "--json")
    assert done.code == 1
    document = strict_json(done.out)
    assert document["outcome"] == "open"
    assert document["taken"] is None
    assert len(document["alike"]) == 2
    assert [reading["gyro"] for reading in document["alike"]] == [None, None]


def test_columns_that_are_not_read_are_named_and_counted(equipoise, strict_json, tmp_path):
    """Many are cut short with a count; the document has them all."""
    moved = turning()
    others = {f"extra{k}": np.full(len(moved.t), float(k)) for k in range(11)}
    saved(tmp_path, text(columns(moved) | others))
    printed = " ".join(equipoise("import", "run.csv").out.split())
    assert "ignored: 11 columns were not read, 'extra0', 'extra1'" in printed
    assert "'extra7' and 3 more" in printed
    document = strict_json(equipoise("import", "run.csv", "--json").out)
    assert document["left_aside"] == list(others)


def test_a_gyro_that_does_not_rest_at_zero_is_named(equipoise, tmp_path):
    """2 deg/s about x are beyond doubt; the motion's own zero is too small to be stated."""
    moved = turning()
    saved(tmp_path, text(columns(moved)))
    assert "gyro's zero" not in equipoise("import", "run.csv").out
    saved(tmp_path, text(columns(moved, w=moved.w + np.radians([2.0, 0.0, 0.0]))))
    printed = " ".join(equipoise("import", "run.csv").out.split())
    assert "gyro bias: at rest it reports 2.0" in printed


def test_a_vertical_that_nothing_shows_is_said_to_be_unchecked(equipoise, tmp_path):
    """Without an accelerometer a testbed's stop shows it roughly, and nothing else at all."""
    moved = turning()
    saved(tmp_path, text(columns(moved, q=tilted(moved, 45.0))))
    alone = equipoise("import", "run.csv")
    assert alone.code == 0
    assert "not checked: whether the laboratory axis" in " ".join(alone.out.split())
    saved(tmp_path, text(columns(moved)))
    checked = equipoise("import", "run.csv", "--testbed", "nanosat")
    assert "not checked: a laboratory tilt below 40 deg" in " ".join(checked.out.split())
    saved(tmp_path, text(columns(moved) | accelerations(moved)))
    assert "not checked" not in equipoise("import", "run.csv", "--testbed", "nanosat").out


def test_a_map_of_ticks_reads_the_table_again(equipoise, tmp_path):
    moved = turning()
    path = ticks_of_dot_net.write(moved, tmp_path)
    assert equipoise("import", path, "--write-map", "map.toml").code == 0
    assert 'unit = "100 ns"' in (tmp_path / "map.toml").read_text()
    assert equipoise("inspect", path, "--columns", "map.toml").code == 0


def test_a_column_of_a_wheel_is_named_where_it_is_left_behind(equipoise, tmp_path, recording):
    """What is written has no such column, so that nothing could say so later."""
    raw, out = tmp_path / "raw.csv", tmp_path / "run.csv"
    table(raw, recording)
    header, *rows = raw.read_text().splitlines()
    more = [f"{row},{20 + k % 7}" for k, row in enumerate(rows)]
    raw.write_text("\n".join([f"{header},wheel x rpm", *more]) + "\n")
    done = equipoise("import", str(raw), "--out", str(out))
    assert done.code == 0
    said = " ".join(done.out.split())
    assert "'wheel x rpm' ranges from 20 to 26" in said
    assert "[[reaction_wheel]]" in said
    again = equipoise("convert", str(out), str(tmp_path / "run.parquet"))
    assert again.code == 0
    assert "reaction_wheel" not in again.out


def alike(one, other):
    """Return the correlation of each column's course about its straight line."""
    straight = np.column_stack([np.arange(len(one)), np.ones(len(one))])
    bent = [x - straight @ np.linalg.lstsq(straight, x, rcond=None)[0] for x in (one, other)]
    lengths = np.linalg.norm(bent[0], axis=0) * np.linalg.norm(bent[1], axis=0)
    return np.sum(bent[0] * bent[1], axis=0) / lengths


TIPPED = {  # our axes in the table of a unit that is mounted so: columns x, y, z of our body's axes
    "z": np.eye(3),
    "-z": np.diag([1.0, -1.0, -1.0]),
    "x": np.array([[0.0, 0, 1], [1, 0, 0], [0, 1, 0]]),
    "-y": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
}


@pytest.mark.parametrize("up", TIPPED)
def test_an_inertial_unit_without_an_attitude_is_read_whichever_axis_points_up(
    equipoise, tmp_path, up
):
    """Gravity is up again, turns as the rate says, and both have their units."""
    record = case(3, MPU6050, 40.0).recording
    load, rate = (each.values @ TIPPED[up].T for each in (record.accelerometer, record.rate))
    counts = np.column_stack([record.rate.t * 1e3, load / G0 * 16384, rate / DEG * 131]).round()
    lines = ["ms,ax,ay,az,gx,gy,gz", *(",".join(f"{x:.0f}" for x in row) for row in counts)]
    (tmp_path / "raw.csv").write_text("\n".join(lines) + "\n")
    words = ("raw.csv", "--write-map", "m.toml", "--out", "run.csv")
    done = equipoise("import", *words)
    assert done.code == 0
    assert f"up: {up} of the accelerometer" in done.out
    read = read_recording(tmp_path / "run.csv")
    upwards = record.accelerometer.values[:, 2]
    np.testing.assert_allclose(read.accelerometer.values[:, 2], upwards, atol=G0 / 16384)
    n = read.accelerometer.values / np.linalg.norm(read.accelerometer.values, axis=1)[:, None]
    turned_by = np.cumsum(np.cross(n, read.rate.values) * 0.01, axis=0)
    assert alike(n, turned_by)[:2].min() > 0.9
    shown = equipoise("inspect", "raw.csv", "--columns", "m.toml")
    assert shown.code == 0


def test_a_gyro_whose_axes_are_ours_beside_an_attitude_of_other_axes(equipoise, tmp_path):
    """Attitude FRD, gyro FLU: the gyro's axes are stated, though they are x, y, z."""
    motion = turning()
    down = np.diag([1.0, -1.0, -1.0])
    q, _ = turned(motion, down)
    path = saved(tmp_path, text(columns(motion, q=q)))
    done = equipoise("import", str(path), "--out", str(tmp_path / "out.csv"))
    assert done.code == 0
    read = read_recording(tmp_path / "out.csv")
    turns = np.cumsum(difference(read.attitude.values[1:], read.attitude.values[:-1]), axis=0)
    middle = 0.5 * (read.rate.values[1:] + read.rate.values[:-1])
    sums = np.cumsum(middle * np.diff(read.attitude.t)[:, None], axis=0)
    assert alike(turns, sums).min() > 0.9
