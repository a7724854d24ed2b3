"""A run by hand is judged by the truth, from its target."""

from dataclasses import replace

import numpy as np

from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import UM
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.study.law_run import Task
from equipoise.study.manual_run import BY_HAND, manual_run

OPTIONS = BalanceOptions(np.array([0.0, 0.0, -60 * UM]), np.array([2, 2, 3]) * UM)


def test_the_offset_is_from_the_target_and_the_torque_from_the_centre_of_rotation():
    """60 um below it is m g 60 um sin(tilt) at most; balanced to the target, little is left off."""
    bed = read_preset("aalto")
    run = manual_run(Task(BY_HAND, bed, 2, OPTIONS, 1200.0, np.radians(20.0)))
    assert np.all(np.abs(run.offset) < 10 * UM)
    most = bed.body.mass * bed.gravity * 70 * UM * np.sin(np.radians(20.0))
    assert 0.5 * most < run.torque < most
    assert run.torque < run.torque_before


def test_more_rounds_take_longer():
    bed = read_preset("aalto")
    task = Task(BY_HAND, bed, 2, replace(OPTIONS, target=np.zeros(3)), 1200.0, np.radians(20.0))
    assert manual_run(task, 1).time < manual_run(task, 6).time
