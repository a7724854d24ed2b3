"""Ivanov's law as printed: a camera's filter, and a move to the target after 25, 50, 75, 100 s."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.law import Sample
from equipoise.control.laws import ivanov_25s
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, END, Estimate, Parameter
from equipoise.model.outcome import outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.units import UM
from equipoise.procedure.balancing.run_law import LawOptions, run_law
from equipoise.simulation.bench import SimulatedBench
from tests.support import thorough

TARGET = np.array([0.0, 0.0, -100.0]) * UM
SENT = ivanov_25s.EVERY * np.arange(1, 5)  # s after the first sample


def sample_at(t):
    zero = np.zeros(3)
    return Sample(t, np.array([1.0, 0, 0, 0]), zero, np.array([0, 0, -9.81]), zero, zero, zero,
                  zero, None)  # fmt: skip


def estimated(com_um):
    com = tuple(Parameter(n, "m", v * UM, UM) for n, v in zip(COM, com_um, strict=True))
    return Estimate(
        "ekf_9", outcome(EstimateReason.FILTERED, innovation=1.0), com, np.eye(3) * UM**2
    )


def carried(com_um):
    """Run the steps with one estimate for ever; return when moves were asked for, and the last."""
    state, target = ivanov_25s.begin(read_preset("sputnix"), TARGET)
    t, observed, sent = 1.0, sample_at(1.0), []
    while True:
        state, command = ivanov_25s.step(state, observed, target)
        if isinstance(observed, Estimate):
            sent.append(t - 1.0)
        if command.finished:
            return sent, t - 1.0, command
        if command.measurement is not None:
            t += command.measurement.duration
            observed = estimated(com_um)
        else:
            t += ivanov_25s.PERIOD
            observed = sample_at(t)


def test_moves_are_made_after_25_50_75_and_100_s_and_then_it_ends():
    sent, ended, last = carried([0.0, 0.0, -100.0])
    np.testing.assert_allclose(sent, SENT, atol=1e-9)
    assert SENT[-1] < ended <= SENT[-1] + ivanov_25s.ARRIVAL
    assert [reason.code for reason in last.finished] == ["moves_made"]
    assert "4 moves" in last.finished[0].sentence


def test_the_masses_shift_what_is_missing_to_the_target():
    """From (7, -3, -80) um to (0, 0, -100) um: by (-7, 3, -20) um, counted from home."""
    _, _, last = carried([7.0, -3.0, -80.0])
    np.testing.assert_allclose(last.shift, np.array([-7.0, 3.0, -20.0]) * UM, atol=1e-12)


def test_a_filter_that_shows_no_com_ends_it_and_says_why():
    state, target = ivanov_25s.begin(read_preset("sputnix"), TARGET)
    blind = Estimate("ekf_9", outcome(EstimateReason.NO_CAMERA), (), np.zeros((0, 0)))
    state, _ = ivanov_25s.step(replace(state, began=0.0), blind, target)
    _, command = ivanov_25s.step(state, sample_at(60.0), target)
    assert [reason.code for reason in command.finished] == ["com_not_shown", "no_camera"]


def test_a_testbed_without_masses_is_refused():
    with pytest.raises(InputError, match=r"ivanov_25s.*sliding masses"):
        ivanov_25s.begin(replace(read_preset("sputnix"), masses=()), TARGET)


@pytest.mark.parametrize("seed", thorough.some([0, 1, 2, 3], 1))
def test_the_paper_s_platform_is_within_ten_micrometres_after_four_moves(seed):
    """Begun within 10 um sideways, J known: the paper's 1e-5 m, by the truth."""
    bed = read_preset("sputnix")
    near = replace(bed.truth, inertia_error=0.0, com_low=np.array([-10, -10, -150]) * UM,
                   com_high=np.array([10, 10, -50]) * UM)  # fmt: skip
    bench = SimulatedBench(replace(bed, inertia_sd=0.0, truth=near), seed)
    steps, coms = [], []
    for step in run_law(bench, ivanov_25s.LAW, LawOptions()):
        steps.append(step)
        coms.append(bench.truth().com)
    found = [(s.estimate, com) for s, com in zip(steps, coms, strict=True) if s.verdict is None]
    found = [(estimate, com) for estimate, com in found if estimate is not None]
    assert len(found) == 4
    assert not found[0][0].has(END[0])  # masses at home
    for estimate, com in found[1:]:  # with the masses as they stand; within 4 sd
        sd = np.sqrt(np.diag(estimate.covariance_of(END)))
        assert np.all(np.abs(estimate.values(END) - com) < 4 * sd)
        assert estimate.values(END)[2] != estimate.com[2]
    assert np.linalg.norm(bench.truth().com - TARGET) < 10 * UM
    assert steps[-1].verdict.outcome != "halted"
