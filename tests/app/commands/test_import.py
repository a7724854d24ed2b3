"""`equipoise import`: a table of unknown columns, from its numbers to a recording."""

import numpy as np
import pytest

from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import conjugate
from equipoise.model.recording import Recording
from equipoise.model.units import DEG
from tests.oracle.corpus import corpus_record

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
    assert "says itself what it holds" in done.out
    assert "motion" not in done.out


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
    assert "'wheel x rpm' goes from 20 to 26" in said
    assert "[[reaction_wheel]]" in said
    again = equipoise("convert", str(out), str(tmp_path / "run.parquet"))
    assert again.code == 0
    assert "reaction_wheel" not in again.out
