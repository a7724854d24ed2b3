"""One balancing by hand of a simulated platform, judged by the truth as a law's run is.

A person places weights on the testbed's grids as `equipoise balance --manual` asks; the time is
what was recorded, since how long hands take between the swings is not simulated. Weights are not
moved by motors: the way of the masses is nought.
"""

import numpy as np

from equipoise.dynamics.sag_trim import acting_com, residual_torque
from equipoise.model.mass_properties import MassProperties
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.balance_manually import HandOptions, balance_by_hand
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.hands import SimulatedHands
from equipoise.study.law_run import LawRun, Task

BY_HAND = "by_hand"
ROUNDS = 4  # placings, as the command has it


def manual_run(task: Task, rounds: int = ROUNDS) -> LawRun:
    """Return what a person leaves; InputError for a testbed without weights."""
    hands = SimulatedHands(task.testbed, task.seed)
    before, verdict = torque_of(hands.truth(), task), Verdict(())
    options = HandOptions(task.options.target, task.options.tolerance, max_rounds=rounds)
    for step in balance_by_hand(hands, options):
        verdict = step.verdict or verdict
    truth, sag = hands.truth(), SimulatedBench(task.testbed, task.seed).sag
    acting = acting_com(np.asarray(truth.com), sag, task.testbed.up)
    return LawRun(
        law=BY_HAND,
        seed=task.seed,
        offset=acting - task.options.target,
        torque=torque_of(truth, task),
        followed=None,
        torque_before=before,
        time=hands.time,
        travel=0.0,
        late=False,
        verdict=verdict,
    )


def torque_of(body: MassProperties, task: Task) -> float:
    """Return the torque (N m) of gravity on a body, rms within the task's tilt."""
    bed = task.testbed
    sag = SimulatedBench(bed, task.seed).sag
    weight = body.mass * bed.gravity
    return weight * residual_torque(np.asarray(body.com), sag, bed.up, task.tilt)
