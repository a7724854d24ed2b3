"""What a balancing law is: a card that says what it needs, how it begins and what a step is.

    step(state, observed, params) -> (state, command)

is a pure function. ``observed`` is a Sample, or the Estimate of the measurement that the last
command requested. A law knows no device: it asks for a shift of the centre of mass and for torques,
and ``procedure.run_law`` finds masses, wheels, gyros, coils and jets that give them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from equipoise.control.sample import Sample
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.testbed import Testbed

State = TypeVar("State")
Params = TypeVar("Params")


@dataclass(frozen=True, slots=True)
class Law(Generic[State, Params]):
    """A card, a beginning and a step.

    ``begin`` takes the testbed and where the centre of mass is wanted (m, body axes), and raises
    InputError for a testbed on which the law would not be stable.
    """

    card: LawCard
    begin: Callable[[Testbed, Vector3], tuple[State, Params]]
    step: Callable[[State, Sample | Estimate, Params], tuple[State, Command]]
