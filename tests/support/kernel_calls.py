"""Calls of kernels that return arrays and named tuples; interrupted hundreds of times as a program.

`python -m tests.support.kernel_calls TIMES [NAME ...]` goes on calling each kernel until so many
SIGINT at random moments, with Python's own handler, have ended as many loops.
"""

import signal
import sys
import threading
import time
from collections.abc import Callable, Sequence

import numpy as np

from equipoise.control.elements.momentum_balance import torques_at
from equipoise.dynamics.sensitivities import work_for
from equipoise.estimation.output_error.kernels.gauss_newton import descend
from equipoise.estimation.output_error.kernels.many_records import observing, points_at
from equipoise.estimation.output_error.kernels.momentum_start import tools_for
from equipoise.estimation.output_error.kernels.normal_equations import pass_for
from equipoise.estimation.output_error.kernels.record_pass import local_for
from equipoise.estimation.output_error.kernels.segments import chain_for, pieces_for
from equipoise.estimation.output_error.solution import posed
from equipoise.estimation.output_error.trajectory import Params, fit, problem_of
from equipoise.estimation.parameters.retraction import coordinates, step_work_for
from equipoise.estimation.tracker.kernel_records import new_tools
from equipoise.estimation.tracker.stored_covariance import SIZE
from equipoise.maths.levenberg_marquardt import FIRST, GROWTH
from equipoise.maths.local_motion import Window, weights_of
from equipoise.maths.pseudo_inertia import from_inertia, slope_of_inertia, to_inertia
from equipoise.maths.scaled_solve import scaled_solve
from tests.support.builders import move_at, noisy, platform, recording

LONGEST = 1e-3  # s before a signal, chosen: many calls of the fast kernels, a part of a slow one


def calls() -> dict[str, Callable[[], object]]:
    """Return a call of each kernel that returns an array or a named tuple."""
    record = noisy(recording(5.0, move_at(1.0, 5.0), gyro=20.0), 1, np.zeros(3))
    bed = platform(3e-4, gyro=True)
    problem = problem_of(record, bed, Params())
    what, point = posed(problem), fit(record, bed, Params()).point.flat
    best, n = local_for(what, point), problem.layout.size
    normal, descent, six = np.empty((n, n)), np.empty(n), np.full(6, 0.1)
    times, window = np.arange(9.0), Window(2, 1, 5, 2.5)
    return {
        "descend": lambda: descend(what, best, 3, normal, descent, FIRST, GROWTH),
        "local_for": lambda: local_for(what, point),
        "observing": lambda: observing(what, what.observed.attitude, what.observed.rate),
        "points_at": lambda: points_at(np.eye(9), np.ones((9, 10)), 1.0, 0.1, len(point)),
        "tools_for": lambda: tools_for(5, 5),
        "weights_of": lambda: weights_of(times, window),
        "chain_for": lambda: chain_for(what.cuts, n),
        "pieces_for": lambda: pieces_for(what.cuts, n, len(point)),
        "pass_for": lambda: pass_for(3, n),
        "work_for": lambda: work_for(3),
        "new_tools": lambda: new_tools(True, SIZE),
        "step_work_for": lambda: step_work_for(n),
        "coordinates": lambda: coordinates(point, what.mass, what.slots),
        "to_inertia": lambda: to_inertia(six),
        "slope_of_inertia": lambda: slope_of_inertia(six),
        "from_inertia": lambda: from_inertia(np.eye(3)),
        "scaled_solve": lambda: scaled_solve(np.eye(3), np.ones(3), 0.0),
        "torques_at": lambda: torques_at(np.ones(3), np.ones(3), 1.0, 2.0),
    }


class Interrupter:
    """Sends SIGINT to the main thread, once after each time that it is armed."""

    def __init__(self) -> None:
        self._armed = threading.Lock()
        self._armed.acquire()
        self._rng = np.random.default_rng(0)
        threading.Thread(target=self._send, daemon=True).start()

    def arm(self) -> None:
        self._armed.release()

    def _send(self) -> None:
        main = threading.main_thread().ident
        assert main is not None
        while self._armed.acquire():
            time.sleep(self._rng.uniform(0.0, LONGEST))
            signal.pthread_kill(main, signal.SIGINT)


def interrupted(call: Callable[[], object], interrupter: Interrupter) -> None:
    """Call until Ctrl-C."""
    try:
        interrupter.arm()
        while True:
            call()
    except KeyboardInterrupt:
        return


def main(times: int, names: Sequence[str]) -> None:
    """Interrupt each kernel so many times; print its name when that is done."""
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    interrupter = Interrupter()
    for name, call in calls().items():
        if names and name not in names:
            continue
        call()  # is compiled
        for _ in range(times):
            interrupted(call, interrupter)
        print(name, flush=True)  # noqa: T201


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:])
