"""What the tracker's walk goes with, as the kernels see it: records of arrays and numbers."""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.rigid_body import ROWS, Body
from equipoise.dynamics.sensitivities import BLOCK, LANES, Columns, work_for
from equipoise.dynamics.sensitivities import Work as StepWork
from equipoise.estimation.tracker.event_signatures import COLUMNS, MANY, Room, Watch
from equipoise.estimation.tracker.predict_correct import Work
from equipoise.estimation.tracker.stored_covariance import ROW, N
from equipoise.maths.kernels.compiled import kernel
from equipoise.model.arrays import Floats, Ints, Square

CAMERA, GYRO = 0, 1  # sensors
END, MOVED, BROKEN, ASTRAY, TOUCHED = 0, 1, 2, 3, 4  # why the walk ended
REASON, NOTED, EVENTS = 0, 1, 2  # in Written.done


class Model(NamedTuple):
    """What does not change along the walk."""

    body: Body  # its inertia and moment are not used; its sag is that of the point, if any
    maps: Floats
    columns: Columns
    sd: Floats  # (2,) rad, rad/s: stated noise of camera and gyro
    walks: Floats  # (24,); a sag stays
    alarm: float  # l of a contact


class Walk(NamedTuple):
    """From which node to which, and what is wanted of it."""

    first: int
    last: int
    stop_at: int  # node from which it ends where the estimate has moved
    folding: bool  # the point goes with the estimate
    again: bool  # rows that have been passed before: nothing is noted, no noise learnt
    testing: bool  # for contacts


class Place(NamedTuple):
    """The estimate (q, w, com, J, bias, v, k) and its covariance, written on by the walk.

    Of a platform that sags the five of C follow.
    """

    posterior: Floats  # (25,), or (30,)
    covariance: Square  # (24, 24), or (29, 29)

    def copy(self) -> "Place":
        """Return one that can be written on."""
        return Place(self.posterior.copy(), self.covariance.copy())


class Carried(NamedTuple):
    """What comes and goes with the walk."""

    place: Place
    levels: Floats  # (2, 2) of the noise: share of the stated variance, rows counted
    watch: Watch


class Written(NamedTuple):
    """Rows and events that the walk writes, and how many."""

    out: Floats
    events: Floats
    done: Ints  # why it ended, rows, events


class Moving(NamedTuple):
    """Arrays that a step of the propagator works in."""

    y: Floats  # (7 + 96,) attitude, momentum, sensitivities
    step: StepWork
    phi: Floats  # (6, 15) rows of 16
    down: Floats  # (3,) n half-way through the step, of a platform that sags


class Tools(NamedTuple):
    """Arrays to work in, made once for a walk."""

    moving: Moving
    work: Work
    room: Room


@kernel
def new_tools(biased: bool, size: int) -> Tools:
    """Return arrays to work in, for an error state of this size.

    ``biased``: the gyro's bias, a drift, warmth or a sag is in use.
    """
    moving = Moving(np.empty(ROWS + BLOCK), work_for(N), np.zeros(6 * LANES), np.zeros(3))
    work = Work(np.zeros(size * ROW), np.zeros(ROW), np.zeros(3 * ROW), np.zeros((3, 3)),
                np.zeros((3, 3)), np.zeros(3 * ROW), np.zeros(3 * ROW), np.zeros(6 * ROW),
                biased, size)  # fmt: skip
    room = Room(np.zeros(6 * COLUMNS), np.zeros(3 * COLUMNS), np.zeros(3 * COLUMNS),
                np.zeros(6 * MANY), np.zeros(3 * MANY), np.zeros(MANY), np.zeros(MANY),
                np.zeros(size), np.zeros(size))  # fmt: skip
    return Tools(moving, work, room)
