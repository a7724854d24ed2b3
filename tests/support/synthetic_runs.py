"""Made-up runs of methods, in um where com is told."""

import numpy as np

from equipoise.estimation.method_contract import Options
from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import UM
from equipoise.study.compare_methods import MethodComparison, stack, summary
from equipoise.study.method_record import Scene
from equipoise.study.method_run import JUDGED, Cost, MethodRun


def nine(values, factor=UM):
    """The judged parameters of which only some of com are told."""
    whole = np.full(len(JUDGED), np.nan)
    whole[: len(values)] = np.array(values, dtype=float) * factor
    return whole


def made_up(error=(1.0,), sd=(1.0,), bound=(1.0,), method="trajectory", seed=1, **more):
    given = {"ending": "done", "sentence": "Said so.", "warned": False, "nees": 1.0,
             "settled": None, "cost": Cost(0.1, None)} | more  # fmt: skip
    if given["ending"] == "refused":
        error, sd, given["nees"] = (), (), np.nan
    return MethodRun(method=method, seed=seed, error=nine(error), sd=nine(sd), bound=nine(bound),
                     **given)  # fmt: skip


def comparison(runs):
    """The comparison of made-up runs, each method in the order of its first run."""
    names = list(dict.fromkeys(run.method for run in runs))
    scene = Scene(read_preset("sputnix"), 60.0, [(30.0, {"z1": -0.05})], Options())
    bound = np.sqrt(np.mean(stack([run.bound for run in runs]) ** 2, axis=0))
    reported = tuple(summary([run for run in runs if run.method == name]) for name in names)
    return MethodComparison(scene, sorted({run.seed for run in runs}), reported, tuple(runs), bound)
