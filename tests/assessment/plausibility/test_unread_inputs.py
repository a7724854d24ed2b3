"""A table that says what drove the platform, in columns that nothing reads, is no free swing."""

from pathlib import Path

import numpy as np
import pytest

from equipoise.assessment.findings.record_findings import findings
from equipoise.assessment.plausibility.unread_inputs import NAMED, unread_findings
from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.columns.read_options import AS_IT_IS, ReadOptions
from equipoise.io.formats.parquet_table import parquet_bytes
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.recording import Recording
from equipoise.model.unread_input import InputKind, UnreadInput
from tests.oracle.corpus import corpus_record

T = np.arange(200) * 0.05
SWING = {
    "time_s": T,
    "roll_deg": 3 * np.sin(T),
    "pitch_deg": 2 * np.cos(T),
    "yaw_deg": 0.1 * T,
}
RUNS_UP = 20 * T


def read(folder: Path, columns: dict[str, np.ndarray], options: ReadOptions = AS_IT_IS):
    """Return what is read of a CSV of a swing and more columns."""
    whole = SWING | columns
    rows = zip(*(np.asarray(each, float).tolist() for each in whole.values()), strict=True)
    lines = [",".join(f"{value:.9g}" for value in row) for row in rows]
    path = folder / "run.csv"
    path.write_text("\n".join([",".join(whole), *lines]) + "\n")
    return read_recording(path, options)


def problems(recording: Recording) -> list[Why]:
    """Return the codes of inputs that nothing reads."""
    coded = {Why.INPUT_UNREAD, Why.READ_DEVICE, Why.READ_TRIAD, Why.READ_REPORTS}
    reasons = [r for f in findings(recording) if f.kind == "problem" for r in f.reasons]
    return [reason.code for reason in reasons if reason.code in coded]


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("RW1 speed", "wheel"),
        ("wheel_2_rpm", "wheel"),
        ("m1.rpm", "wheel"),
        ("wheelMomentumX", "wheel"),
        ("thruster3", "jet"),
        ("valve_a", "jet"),
        ("coil x (A)", "dipole"),
        ("magnetorquer_current_y", "dipole"),
        ("dipoleZ", "dipole"),
        ("CMG gimbal rate", "gimbal"),
        ("stage 1", "mass"),
        ("angular_momentum_x", "momentum"),
        ("tau_x", "torque"),
        ("TorqueCmd[0]", "torque"),
        ("pwm4", "command"),
        ("u_cmd", "command"),
        ("ESC_2", "command"),
    ],
)
def test_a_column_of_an_input_that_changes_is_a_problem(tmp_path, name, kind):
    """It is named with its range; one that stands is none."""
    recording = read(tmp_path, {name: RUNS_UP})
    assert recording.unread == (UnreadInput(name, InputKind(kind), 0.0, 199.0),)
    assert problems(recording)[0] is Why.INPUT_UNREAD
    assert len(problems(recording)) == 2
    assert not problems(read(tmp_path, {name: 0 * T}))
    assert not problems(read(tmp_path, {name: 0 * T + 7.0}))


@pytest.mark.parametrize(
    "name",
    ["vbat", "RW1 temp", "motor_status", "cmd_time", "frame", "x_mm", "error", "quality", "mean",
     "omega_z_est", "current", "position_x", "commuter", "crews"],
)  # fmt: skip
def test_a_column_of_another_thing_is_none(tmp_path, name):
    """Battery, temperatures, counters, places."""
    assert not read(tmp_path, {name: RUNS_UP}).unread


def test_the_platforms_name_says_nothing(tmp_path):
    """A motion-capture body that is called as a device is."""
    path = tmp_path / "map.toml"
    columns = ["CMG bed qx", "CMG bed qy", "CMG bed qz", "CMG bed qw"]
    path.write_text(
        f'[time]\ncolumn = "time_s"\nunit = "s"\n[attitude]\ncolumns = {columns}\norder = "xyzw"\n'
    )
    half = np.radians(3 * np.sin(T)) / 2
    turn = [np.sin(half), 0 * T, 0 * T, np.cos(half)]
    options = ReadOptions(columns=read_column_map(path))
    taken = dict(zip(columns, turn, strict=True))
    assert not read(tmp_path, {**taken, "CMG bed TX": RUNS_UP}, options).unread
    assert read(tmp_path, {**taken, "CMG bed gimbal": RUNS_UP}, options).unread


def test_a_command_to_what_reports_is_accounted_for(tmp_path):
    """Of two wheels one is in the map: its command is no input more, the other's speed is."""
    path = tmp_path / "map.toml"
    path.write_text(
        '[time]\ncolumn = "time_s"\nunit = "s"\n'
        '[attitude]\ncolumns = ["yaw_deg", "pitch_deg", "roll_deg"]\nunit = "deg"\n'
        'sequence = "ZYX"\n'
        '[[device]]\nname = "x"\nreports = "wheel"\ncolumn = "rw1"\nunit = "rpm"\n'
    )
    wheels = {"rw1": RUNS_UP, "rw2": RUNS_UP, "rw1_cmd": RUNS_UP, "motor pwm": RUNS_UP}
    found = read(tmp_path, wheels, ReadOptions(columns=read_column_map(path)))
    assert [each.column for each in found.unread] == ["rw2"]


def test_another_format_says_the_same(tmp_path):
    """The columns of a Parquet file."""
    path = tmp_path / "run.parquet"
    path.write_bytes(parquet_bytes(SWING | {"wheel_speed": RUNS_UP}, str(path)))
    assert [each.column for each in read_recording(path).unread] == ["wheel_speed"]


def test_columns_of_words_and_blank_ones_say_nothing(tmp_path):
    """A name that is there, and no number below it."""
    assert not read(tmp_path, {"wheel_speed": np.full(len(T), np.nan)}).unread


def test_of_many_columns_some_are_named():
    """One finding a kind, with what makes use of it."""
    wheels = [UnreadInput(f"rw{k}", InputKind.WHEEL, 0.0, 1.0) for k in range(NAMED + 2)]
    jet = UnreadInput("valve", InputKind.JET, 0.0, 1.0)
    found = {each.reasons[-1].parameters: each for each in unread_findings([jet, *wheels])}
    codes = [reason.code for reason in found[WHEEL].reasons]
    assert codes == [Why.INPUT_UNREAD] * NAMED + [Why.MORE_INPUTS_UNREAD, Why.READ_DEVICE]
    assert found[WHEEL].reasons[NAMED].numbers == {"count": 2}
    assert len(found) == 2


WHEEL = ('[[device]], reports = "wheel"', "[[reaction_wheel]]")


@pytest.mark.parametrize("seed", range(3))
def test_a_record_of_ours_has_none(tmp_path, seed):
    """Masses, cameras and gyros are all read."""
    path = tmp_path / "run.csv"
    write_recording(corpus_record(seed).recording, path)
    assert not read_recording(path).unread
