"""Findings: each fault that is put into a record is found, and a sound record has none."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.assessment.findings.channel_content import content_findings
from equipoise.assessment.findings.record_findings import findings
from equipoise.assessment.record_checks.attitude_noise import attitude_noise
from equipoise.assessment.record_checks.rate_quality import rate_noise, step_of
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential, multiply
from equipoise.model.devices import Lamp
from equipoise.model.recording import CHANNELS, Recording, Samples
from equipoise.model.testbed import Testbed

DT = 0.02
T = np.arange(3000) * DT


def swing(rng: np.random.Generator, noise: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Return attitudes of a swinging, turning platform and its exact mean rates between rows."""
    phases = np.array([0.0, 1.0, 2.0])
    rate = np.array([0.10, 0.08, 0.05]) * np.sin(np.outer(T, [0.9, 0.7, 0.4]) + phases)
    q = [np.array([1.0, 0, 0, 0])]
    for w in rate[:-1]:
        q.append(multiply(q[-1], exponential(w * DT)))
    return multiply(np.array(q), exponential(rng.normal(scale=noise, size=(len(T), 3)))), rate


def recorded(gyro=lambda w: w, noise: float = 1e-3) -> Recording:
    """Return a noisy record; ``gyro`` distorts the rates."""
    rng = np.random.default_rng(7)
    q, rate = swing(rng, noise)
    response = gyro(rate + rng.normal(scale=1e-3, size=rate.shape))
    return Recording(
        attitude=Samples(T, q), rate=Samples(T + DT / 2, response)
    )  # means between rows


def said(recording: Recording, kind: str = "problem", testbed: Testbed | None = None) -> str:
    """Return all sentences of a kind."""
    kinds = {kind, "wrong"} if kind == "problem" else {kind}
    return " ".join(f.sentence for f in findings(recording, testbed) if f.kind in kinds)


def test_a_sound_record_has_no_problem() -> None:
    """Gyro and attitude agree about all axes."""
    assert said(recorded()) == ""
    assert "agree about x, y, z" in said(recorded(), "content")


@pytest.mark.parametrize(
    ("gyro", "sentence"),
    [
        (lambda w: w * [-1, 1, 1], 'axes = ["-x", "y", "z"]'),
        (lambda w: w[:, [1, 0, 2]], 'axes = ["y", "x", "z"]'),
        (lambda w: w[:, [0, 2, 1]] * [1, -1, 1], 'axes = ["x", "z", "-y"]'),
        (lambda w: np.degrees(w), "the gyro reads 57.3 times the rate of the attitude"),
        (lambda w: w * [1, 1, 1.3], "gyro z reads 1.3 times the rate of the attitude"),
        (lambda w: np.round(w / 0.01) * 0.01, "gyro x is quantised to 0.573 deg/s"),
        (lambda w: w * [1, 0, 1], "gyro y is 0 deg/s in every row"),
    ],
)
def test_a_distorted_gyro_is_found_out(gyro, sentence) -> None:
    """Signs, axes, units, steps and dead axes, each named with its axis."""
    assert sentence in said(recorded(gyro))


def test_a_gyro_zero_offset_is_reported() -> None:
    """0.5 deg/s on y shows in the offset and is no disagreement."""
    recording = recorded(lambda w: w + [0, np.radians(0.5), 0])
    assert said(recording) == ""
    zero = next(f.sentence for f in findings(recording) if "gyro bias" in f.sentence)
    assert float(zero.split(", ")[1]) == pytest.approx(0.5, abs=0.02)


def test_differences_of_the_attitude_are_no_second_sensor() -> None:
    """Backward differences begin with a row of zeros."""
    q, rate = swing(np.random.default_rng(1))
    late = np.vstack([np.zeros(3), rate[:-1]])
    recording = Recording(attitude=Samples(T, q), rate=Samples(T, late))
    assert "rates start at exactly zero" in said(recording)


@pytest.mark.parametrize("noise", [1e-4, 1e-3, 1e-2])
def test_the_attitude_noise_is_estimated_within_ten_percent(noise) -> None:
    """White noise of known size on a slow swing at 50 Hz; scatter of the sd from 3000 rows: 3 %."""
    q, _ = swing(np.random.default_rng(3), noise)
    assert attitude_noise(Samples(T, q)) == pytest.approx(noise, rel=0.1)


def test_noise_is_not_estimated_across_a_gap() -> None:
    """A jump across lost rows is motion, not noise."""
    q, _ = swing(np.random.default_rng(3), 1e-3)
    keep = np.r_[0:1000, 2000:3000]
    assert attitude_noise(Samples(T[keep], q[keep])) == pytest.approx(1e-3, rel=0.12)


def test_gaps_are_found_with_their_span() -> None:
    """1000 rows lost from 20 s on."""
    q, _ = swing(np.random.default_rng(3))
    keep = np.r_[0:1001, 2000:3000]
    found = findings(Recording(attitude=Samples(T[keep], q[keep])))
    found = [finding for finding in found if finding.kind == "problem"]
    assert [f.span for f in found] == [(pytest.approx(20.0), pytest.approx(40.0))]
    assert "gap of 20 s at 20 s" in found[0].sentence


def test_moves_of_masses_are_reported_with_times_and_sizes() -> None:
    """x1 from 0 to -10 mm between 1 and 2 s, z1 stays."""
    t = np.arange(6.0)
    x = np.column_stack([[0, 0, -0.01, -0.01, -0.01, -0.01], np.zeros(6)])
    q, _ = swing(np.random.default_rng(3))
    recording = Recording(Samples(T, q), mass_names=("x1", "z1"), masses=Samples(t, x))
    moves = [f for f in findings(recording) if f.sentence.startswith("mass ")]
    assert [f.span for f in moves] == [(1.0, 2.0)]
    assert "mass x1 moves from 0 to -10 mm" in moves[0].sentence


@pytest.mark.parametrize("channel", ["momentum", "torque", "devices", "position"])
def test_the_scale_is_open_only_where_nothing_absolute_was_recorded(channel) -> None:
    """Momentum of wheels, known torque and the path on a table show it without a move."""
    width = 2 if channel == "position" else 3
    still = {"mass_names": ("x1",), "masses": Samples(T, np.zeros((len(T), 1)))}
    named = {"device_names": ("wheel:x", "wheel:y", "wheel:z")} if channel == "devices" else {}
    rests, acts = (Samples(T, np.full((len(T), width), value)) for value in (0.0, 0.5))
    alone = replace(recorded(), **named, **{channel: acts})
    assert "the scale remains open" in said(recorded(), "content")
    assert "the scale remains open" in said(replace(alone, **{channel: rests}), "content")
    assert "scale" not in said(alone, "content")
    assert "No mass moved: the scale remains open." in said(replace(recorded(), **still), "content")
    assert "No mass moved. " in said(replace(alone, **still), "content") + " "


def test_every_channel_is_reported() -> None:
    """Of as many columns as each has; what a new one is called, somebody has to say."""
    rows = {name: Samples(np.arange(6.0), np.ones((6, 1))) for name in CHANNELS[2:]}
    record = Recording(*(Samples(T, c) for c in swing(np.random.default_rng(3))), **rows,
                       mass_names=("x1",), device_names=("wheel:rw_x",))  # fmt: skip
    reported = [f.sentence for f in content_findings(record)]
    assert len([line for line in reported if " rows from " in line]) == len(CHANNELS)


def test_a_lamp_that_nothing_counts_is_a_problem() -> None:
    """Not where the testbed has it, a thermometer was read, or it is never switched."""
    switch = Samples(np.array([0.0, 10.0]), np.array([[0.0], [1.0]]))
    record = Recording(Samples(T, swing(np.random.default_rng(3))[0]), lamp=switch)
    bed = read_preset("sputnix")
    assert "the testbed file has no [lamp]" in said(record, "problem", bed)
    assert "lamp" not in said(record, "problem", replace(bed, lamp=Lamp(3.0, 60.0)))
    assert "lamp" not in said(replace(record, temperature=switch), "problem", bed)
    steady = replace(switch, values=np.ones((2, 1)))
    assert "lamp" not in said(replace(record, lamp=steady), "problem", bed)


def test_devices_and_the_field_are_reported_and_unknown_names_listed() -> None:
    """A wheel and a magnetometer beside the camera; the testbed has a wheel of another name."""
    t, q = np.arange(6.0), swing(np.random.default_rng(3))[0]
    devices, field = Samples(t, np.ones((6, 2))), Samples(t, np.full((6, 3), 2e-5))
    names = ("wheel:rw_x", "jet:rw_y")
    record = Recording(Samples(T, q), device_names=names, devices=devices, field=field)
    reported = " ".join(f.sentence for f in findings(record, read_preset("reference-table")))
    assert "devices of wheel:rw_x, jet:rw_y: 6 rows from 0 to 5 s, 1 Hz." in reported
    assert "magnetic field: 6 rows from 0 to 5 s, 1 Hz." in reported
    assert "device jet:rw_y is not in the testbed; did you mean 'jet:jp_y'?" in reported
    assert "device wheel:rw_x" not in reported
    bare = " ".join(f.sentence for f in findings(record, read_preset("sputnix")))
    assert "device wheel:rw_x is not in the testbed; it has none" in bare
    assert "device" not in said(record)


def test_a_platform_on_its_side_is_a_turned_frame() -> None:
    """Leaning by 90 deg about x, body y points up; if the testbed says z, the frame is turned."""
    q = exponential(np.tile([np.pi / 2, 0, 0], (50, 1)))
    recording = Recording(attitude=Samples(np.arange(50) * 0.1, q))
    wrong = " ".join(f.sentence for f in findings(recording, read_preset("sputnix")))
    assert "gravity does not point down: the median tilt is 90 deg" in wrong
    assert "body axis y is nearest to vertical" in wrong
    assert "gravity" not in " ".join(f.sentence for f in findings(recording))


def test_spin_and_tilt_are_reported() -> None:
    """A level turn at 0.5 rad/s is 28.65 deg/s about the vertical at no tilt."""
    t = np.arange(100) * 0.1
    recording = Recording(attitude=Samples(t, exponential(np.outer(t, [0, 0, 0.5]))))
    motion = said(recording, "motion")
    assert "28.65 deg/s at the start, 28.65 deg/s at the end" in motion
    assert "0 to 0 deg" in motion


def test_quantisation_is_reported_only_for_quantised_values() -> None:
    """Multiples of 0.02 have that step; continuous noise has none."""
    rng = np.random.default_rng(5)
    x = rng.normal(size=500)
    assert step_of(np.round(x / 0.02) * 0.02) == pytest.approx(0.02)
    assert step_of(x) is None


def test_what_reading_mended_is_passed_on() -> None:
    """Notes are findings too."""
    recording = Recording(rate=Samples(T, np.ones((len(T), 3))), notes=("Two rows went.",))
    assert said(recording, "mended") == "Two rows went."


def test_steps_finer_than_the_noise_are_no_problem() -> None:
    """Rounding to a tenth of the noise is reported, as content."""
    recording = recorded(lambda w: np.round(w / 1e-4) * 1e-4)
    assert "steps" not in said(recording)
    assert "gyro x is quantised to 0.00573 deg/s" in said(recording, "content")


@pytest.mark.parametrize("noise", [1e-4, 1e-3, 1e-2])
def test_the_gyro_noise_is_estimated_within_ten_percent(noise) -> None:
    """White noise of known size on a slow swing; scatter of the sd from 3000 rows: 3 %."""
    rng = np.random.default_rng(4)
    _, rate = swing(rng)
    response = Samples(T, rate + rng.normal(scale=noise, size=rate.shape))
    assert rate_noise(response) == pytest.approx(noise, rel=0.1)
