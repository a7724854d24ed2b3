"""The program in C balances a platform at an emulated Grbl board and an emulated VN-100.

Rows come over the VN-100's own messages, masses go by G-code, and both sides are real ports.
"""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.runs.generation import board_templates
from equipoise.io.testbed.presets import read_preset
from equipoise.onboard.files import files_of
from equipoise.onboard.program.board import board_of
from equipoise.onboard.sources.translated import translated
from equipoise.onboard.trial import plain_answer, run_trial
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import balanced_by
from equipoise.simulation.bench import SimulatedBench
from tests.support import thorough
from tests.support.c_program import Program, compiled, needs_compiler, written
from tests.support.emulated_lab import lab, over_tcp

pytestmark = needs_compiler
# An open loop tips a platform that is far off balance; here it may swing.
BED = replace(over_tcp(read_preset("nanosat")), tilt_limit=3.0)
OPTIONS = BalanceOptions()
HEIGHT = 6e-6  # m: neither law's filter knows the height better than 2 to 4 um


def run_in_c(law, seed, duration, folder):
    """Return the trial, and how far off the target the platform truly is (m)."""
    program = translated("ekf_9", law, BED, OPTIONS.target)
    written(folder, files_of(program, board_templates(), SimulatedBench(BED, 1)))
    with lab(BED, seed) as found, Program(compiled(folder, "stream_rows", "-O2")) as answer:
        trial = run_trial(found.bench, answer, duration, 0.25, longest=20)
        found.wait(2.0)  # the last move
        off = found.emulated.platform.truth().com - OPTIONS.target
        stops = [event for event in found.events if event[1] == "interlock"]
    assert stops == []
    return trial, off


def run_by_the_library(law, seed):
    """Return how far off the target the library's law leaves the same platform, m."""
    with lab(BED, seed) as found:
        for step in balanced_by(law, found.bench, OPTIONS, 600.0):
            if step.verdict is not None or step.kind == "verification":
                break
        return found.emulated.platform.truth().com - OPTIONS.target


@pytest.mark.parametrize(
    ("law", "seed", "duration"),
    thorough.some([("ivanov_25s", 3, 125.0), ("ivanov_25s", 5, 125.0), ("pid", 2, 600.0)], 1),
)
def test_c_balances_through_grbl_and_vn100(law, seed, duration, tmp_path):
    """Within (2, 2) um sideways; every answer is Python's own to the same rows, bit for bit."""
    trial, off = run_in_c(law, seed, duration, tmp_path)
    assert trial.answers[-1, -1] == 1.0
    assert np.all(np.abs(off[:2]) < OPTIONS.tolerance[:2])
    assert abs(off[2]) < HEIGHT
    assert len(trial.rows) > 35 * (trial.rows[-1, 0] - trial.rows[0, 0])  # of 40 a second
    answer = plain_answer(*board_of("ekf_9", law, BED, OPTIONS.target))
    np.testing.assert_array_equal(np.array([answer(row) for row in trial.rows]), trial.answers)


@thorough.whole
@pytest.mark.parametrize(("law", "seed"), [("ivanov_25s", 3), ("pid", 2)])
def test_the_librarys_law_leaves_the_same_platforms_within_the_same_tolerance(law, seed):
    off = run_by_the_library(law, seed)
    assert np.all(np.abs(off[:2]) < OPTIONS.tolerance[:2])
    assert abs(off[2]) < HEIGHT
