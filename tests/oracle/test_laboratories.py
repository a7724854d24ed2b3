"""Records of other laboratories: they are what they say, and what the estimator makes of them."""

import json
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.app.cli import run
from equipoise.estimation.model_selection import initial_model, reference_fit
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.io.recording.recording_file import write_recording
from equipoise.io.testbed.testbed_file import text_of_testbed
from equipoise.maths.attitude import tilt
from equipoise.model.errors import InputError
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import laboratories as labs
from tests.oracle.defects import SIXTEENTH
from tests.support import thorough

UP = np.array([0.0, 0.0, 1.0])


def test_a_spin_is_that_fast_and_slows_down() -> None:
    q = labs.spun(0, duration=5.0).recording.attitude.values
    step = 2 * np.arccos(np.abs(np.sum(q[1:] * q[:-1], axis=1)))
    assert np.degrees(np.median(step)) * 100 == pytest.approx(280, rel=0.05)


def test_a_tilt_is_that_large() -> None:
    q = labs.tilted(0, 28.0, moved=False).recording.attitude.values
    assert np.degrees(tilt(q[:5], UP)).mean() == pytest.approx(28, abs=1.5)


def test_a_gyro_is_quantised_in_sixteenths() -> None:
    whole = labs.tumbling(0, 20.0).recording.rate.values / SIXTEENTH
    np.testing.assert_allclose(whole, np.round(whole), atol=1e-9)


def test_a_gap_is_empty() -> None:
    t = labs.silent(labs.tilted(0, duration=60.0), (10.0, 38.0)).recording.attitude.t
    assert np.diff(t).max() == pytest.approx(28.4, abs=0.05)


def test_a_motor_turns_the_platform() -> None:
    """A constant torque about the vertical for 5 s: J_zz by the rate that it gains, to the tilt."""
    still, pushed = (
        labs.motored(1, torque, tilt_deg=1.0, moved=False, duration=5.0)
        for torque in (lambda t: 0 * t, lambda t: 0 * t + 0.01)
    )
    rates = []
    for record in (still, pushed):
        q = record.recording.attitude.values
        heading = np.unwrap(2 * np.arctan2(q[:, 3], q[:, 0]))
        rates.append(np.polyfit(record.recording.attitude.t, heading, 2)[0] * 2)
    gained = rates[1] - rates[0]
    assert 0.01 / gained == pytest.approx(still.platform.inertia_P[2, 2], rel=0.1)


def test_held_stays_held_in_a_search_along_the_boundary() -> None:
    """A spin from a body far off, whose search goes through bodies that cannot be."""
    record = labs.spun(0).knowing(2)
    found = fit(record.recording, record.testbed, Params(hold=("inertia_P_zz",)))
    inertia = found.point.body(record.platform.mass).inertia_P
    assert inertia[2, 2] == pytest.approx(record.platform.inertia_P[2, 2], rel=1e-9)


@thorough.whole  # behind a long gap, a spin is followed with damping in statistical
def test_drag_over_many_turns_is_found() -> None:
    """Without the term from the start nothing is found: the heading runs away by radians."""
    record = labs.spun(1)
    plain = fit(record.recording, record.testbed, Params())
    assert not initial_model.is_near(plain)
    params, damped = initial_model.plainly(record.recording, record.testbed, Params())
    assert params.terms == ("viscous_x", "viscous_y", "viscous_z")
    rows = 3 * len(record.recording.attitude)
    assert 2 * damped.at.cost == pytest.approx(rows, rel=0.1)


@thorough.whole
def test_a_platform_at_rest_shows_no_ratios() -> None:
    """Where it rests com is known up to its length; the moments of inertia are not seen at all."""
    record = labs.at_rest(0, rate_deg_s=0.05)
    *_, last = identify(record.recording, record.testbed, IdentifyOptions("trajectory"))
    moments = [p for p in last.estimate.ratios if p.name.startswith("inertia")]
    assert moments
    assert not any(np.isfinite(p.sd) or p.observable for p in moments)


@thorough.whole
def test_what_no_model_explains_is_not_usable_and_fails_nothing() -> None:
    """50 mN m, ten times what gravity does."""
    record = labs.motored(0, labs.bang_bang(0.05))
    estimate = reference_fit.estimate(record.recording, record.testbed, Params())
    assert not estimate.outcome.usable


def test_a_sensor_that_the_testbed_lacks_is_named() -> None:
    record = labs.tilted(0, 5.0, duration=20.0, moved=False)
    with pytest.raises(InputError, match=r"sensor.attitude: found none, but 101 rows"):
        reference_fit.estimate(record.recording, replace(record.testbed, attitude=None), Params())


def test_a_file_with_a_command_column(tmp_path, capsys, monkeypatch) -> None:
    """inspect and identify, as a user runs them: the column that nothing uses is told."""
    monkeypatch.setenv("EQUIPOISE_RUNS", "")
    record = labs.motored(0, labs.sine(5e-3), duration=60.0, moved=False)
    csv, toml = tmp_path / "run.csv", tmp_path / "bed.toml"
    write_recording(replace(record.recording, mass_names=(), masses=None), csv)
    head, *rows = csv.read_text().splitlines()
    reported = [f"{row},{0.5 * (k % 2)}" for k, row in enumerate(rows)]
    csv.write_text("\n".join([f"{head},motor_command", *reported]) + "\n")
    toml.write_text(text_of_testbed(record.testbed))
    assert run(["inspect", str(csv)]) == 0
    assert "ignored: 'motor_command'" in " ".join(capsys.readouterr().out.split())
    code = run(["identify", str(csv), "--testbed", str(toml), "--json"])
    document = json.loads(capsys.readouterr().out)
    assert code == (0 if document["outcome"]["usable"] else 1)
