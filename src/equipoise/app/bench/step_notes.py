"""What a procedure finds, noted in a real bench's record and live view, whose scene shows it."""

import math
from collections.abc import Callable
from contextlib import suppress

from equipoise.app.text.com_estimate import com_after
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.io.mcap.foxglove_scene import COM_KEY, SD_KEY
from equipoise.model.arrays import Vector3
from equipoise.model.bench import Bench
from equipoise.model.errors import BenchStopped
from equipoise.model.step import Step

OnStep = Callable[[Step], None]


def noting(bench: Bench, on_step: OnStep | None) -> OnStep | None:
    """Return what is to be called with each step, so that a real bench notes it too."""
    if not isinstance(bench, RealBench):
        return on_step

    def note(step: Step) -> None:
        found = com_after(step)
        data = {} if found is None else {COM_KEY: _known(found.com), SD_KEY: _known(found.sd)}
        with suppress(BenchStopped):  # the procedure's own next word to the bench says so
            bench.note("step", step.sentence, data)
        if on_step is not None:
            on_step(step)

    return note


def _known(values: Vector3) -> list[float | None]:
    """Return numbers for JSON, which has none that are not finite."""
    return [float(value) if math.isfinite(value) else None for value in values]
