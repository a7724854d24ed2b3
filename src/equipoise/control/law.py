"""What a balancing law is: a card that states its needs, an initial state and a step function.

    step(state, observed, params) -> (state, command)

is a pure function. ``observed`` is a Sample, or the Estimate of the measurement that the last
command requested. A law is independent of devices: it requests a shift of the centre of mass and
torques, and ``procedure.balancing.allocation`` assigns them to masses, wheels, gyros, coils and
jets.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from equipoise.model.arrays import Quaternion, Vector3
from equipoise.model.command import Command
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.testbed import Testbed

State = TypeVar("State")
Params = TypeVar("Params")


@dataclass(frozen=True, slots=True, eq=False)
class Sample:
    """Attitude and rate as filtered, inputs as measured; vectors in body axes."""

    t: float  # s
    q: Quaternion  # body to laboratory
    rate: Vector3  # rad/s, without the gyro's bias
    gravity: Vector3  # m/s^2, g_B = R(q)^T (0, 0, -g)
    shift: Vector3  # m, of the centre of mass by the masses, counted from home, as reported
    momentum: Vector3  # N m s, stored in wheels and gyros, as measured
    torque: Vector3  # N m, mean of -h' since the last step, as measured
    impulse: Vector3  # N m s, of jets since the last step, as measured
    field: Vector3 | None  # T, magnetic; None: not known


@dataclass(frozen=True, slots=True)
class Law(Generic[State, Params]):
    """A card, an initial state and a step.

    ``begin`` takes the testbed and the target of the centre of mass (m, body axes), and raises
    InputError for a testbed on which the law would not be stable. ``expected`` is how long a run
    with these parameters should take (s), where a law can calculate it.
    """

    card: LawCard
    begin: Callable[[Testbed, Vector3], tuple[State, Params]]
    step: Callable[[State, Sample | Estimate, Params], tuple[State, Command]]
    expected: Callable[[Params], float] | None = None
