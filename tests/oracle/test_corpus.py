"""The corpus: the same seed makes the same record, over the space that is claimed."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.estimation.output_error.free_vertical import with_free_vertical
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.parameters.fit_parameters import core_of
from equipoise.maths.attitude import tilt
from equipoise.model.mass_properties import is_possible
from tests.oracle import corpus, corpus_choices, corpus_testbed
from tests.oracle.corpus_choices import MassLog, Sensors, Shape, choices

MANY = [choices(seed) for seed in range(300)]
QUICK = [drawn for drawn in MANY if drawn.duration < 60.0]
UP = np.array([0.0, 0.0, 1.0])


def first(**wanted: object) -> corpus_choices.Choices:
    """Return the first short record with these choices."""
    return next(d for d in QUICK if all(getattr(d, k) == v for k, v in wanted.items()))


def made(drawn: corpus_choices.Choices) -> corpus.CorpusRecord:
    """Return the record of what was drawn."""
    return corpus.corpus_record(drawn.seed)


def test_the_same_seed_makes_the_same_record() -> None:
    one, other = made(first(log=MassLog.STEPS)), made(first(log=MassLog.STEPS))
    for channel in ("attitude", "rate", "masses"):
        a, b = getattr(one.recording, channel), getattr(other.recording, channel)
        assert (a is None) == (b is None)
        if a is not None:
            np.testing.assert_array_equal(a.values, b.values)
    np.testing.assert_array_equal(core_of(one.testbed.body), core_of(other.testbed.body))


@pytest.mark.parametrize("kind", [*Shape, *Sensors, *MassLog])
def test_each_kind_is_drawn(kind) -> None:
    assert sum(kind in (d.shape, d.sensors, d.log) for d in MANY) >= 30


@pytest.mark.parametrize(
    ("name", "ends"),
    [
        ("mass", corpus_choices.MASS),
        ("duration", corpus_choices.DURATION),
        ("tilt", corpus_choices.TILT),
        ("camera_hz", (1.0, 200.0)),
    ],
)
def test_the_whole_of_a_range_is_met_and_nothing_else(name, ends) -> None:
    values = np.array([getattr(d, name) for d in MANY])
    assert ends[0] <= values.min() < 1.2 * ends[0]
    assert ends[1] / 1.2 < values.max() <= ends[1]


def test_com_is_above_and_below_and_some_platforms_do_not_spin() -> None:
    assert 0.15 < np.mean([d.depth < 0 for d in MANY]) < 0.35
    spins = np.abs([d.spin for d in MANY])
    assert spins.max() > 250
    assert 0.08 < np.mean(spins == 0) < 0.22


@pytest.mark.parametrize("seed", [d.seed for d in QUICK[:12]])
def test_a_record_is_of_a_possible_platform_and_ends_at_the_stop(seed) -> None:
    record = corpus.corpus_record(seed)
    assert is_possible(record.truth)
    assert is_possible(record.testbed.body)
    start, end = record.recording.span
    assert end - start >= 0.5 * corpus_choices.DURATION[0]
    if record.recording.attitude is not None:
        q, lean = record.recording.attitude.values, corpus_testbed.PLUMB_SD
        noise = np.radians(record.choices.camera_deg)
        assert tilt(q, UP).max() < corpus.STOP + 5 * (lean + noise)


def test_a_rod_has_moments_1_to_20_and_a_disc_1_to_2() -> None:
    rod = np.sort(np.diag(corpus.platform_of(first(shape=Shape.ROD, log=MassLog.NONE)).inertia_P))
    disc = np.sort(np.diag(corpus.platform_of(first(shape=Shape.DISC, log=MassLog.NONE)).inertia_P))
    assert rod[2] / rod[0] > 8
    assert disc[2] / disc[0] == pytest.approx(2.0, rel=0.25)


def test_inputs_err_as_their_sd_say() -> None:
    """36 platforms: the rms of errors over sd is 1, within 3 / sqrt(2 n) of it for the masses."""
    errors = []
    for drawn in MANY[:36]:
        platform = corpus.platform_of(drawn)
        exact = corpus_testbed.exact_testbed(drawn, platform)
        stated = corpus_testbed.stated_testbed(drawn, exact)
        errors.append((stated.body.mass / exact.body.mass - 1) / exact.mass_sd)
        errors.append((exact.gravity / stated.gravity - 1) / exact.gravity_sd)
        pairs = zip(stated.masses, exact.masses, strict=True)
        errors += [(a.mass / b.mass - 1) / b.mass_sd for a, b in pairs]
    assert np.std(errors) == pytest.approx(1.0, abs=3 / np.sqrt(2 * len(errors)))


# --- what is logged of the masses -----------------------------------------------------------------


def log_of(drawn: corpus_choices.Choices, kind: MassLog) -> tuple[np.ndarray, np.ndarray]:
    """Return times and displacements of the first mass (m), logged in a way, on a true clock."""
    run, moves = corpus.run_of(drawn)
    rows = corpus._masses(replace(drawn, log=kind), run, moves)
    return rows.t, rows.values[:, 0]


def test_logs_of_one_move() -> None:
    """Steps are whole, a late log is the exact one later, a command comes before the mass."""
    drawn = first(log=MassLog.LATE, sensors=Sensors.BOTH)
    t, exact = log_of(drawn, MassLog.EXACT)
    whole = log_of(drawn, MassLog.STEPS)[1] / corpus_testbed.QUANTUM
    np.testing.assert_allclose(whole, np.round(whole), atol=1e-9)
    late, same = log_of(drawn, MassLog.LATE)
    np.testing.assert_allclose(late - t, drawn.late, rtol=1e-9)
    np.testing.assert_array_equal(same, exact)
    when, commanded = log_of(drawn, MassLog.COMMAND)
    moved = np.abs(np.interp(when, t, exact) - commanded)
    assert moved.max() > 0.3e-3
    assert np.abs(commanded[-1] - exact[-1]) < 2 * corpus_testbed.GRAVITY / corpus_testbed.SERVO**2


# --- a record without defects ---------------------------------------------------------------------


def test_a_record_without_defects_is_explained() -> None:
    """From the true body the fit leaves what the noise is: chi-square of its degrees of freedom."""

    record = made(first(log=MassLog.NONE, sensors=Sensors.CAMERA))
    params = Params(record.exact.disturbances, use_prior=True)
    params = with_free_vertical(record.recording, record.exact, params)
    found = fit(record.recording, record.exact, params)
    rows = 3 * len(record.recording.attitude)
    assert 2 * found.at.cost == pytest.approx(rows, abs=4 * np.sqrt(2 * rows))
