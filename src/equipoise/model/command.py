"""What a balancing law commands until its next step."""

from dataclasses import dataclass

from equipoise.model.arrays import Vector3
from equipoise.model.following import Following
from equipoise.model.reasons.reason import Reason


@dataclass(frozen=True, slots=True)
class Measurement:
    """Let the platform swing, masses still and no torque, and estimate from that record.

    With ``since`` the record begins there: what was moved and driven after that is part of it.
    """

    duration: float  # s
    method: str  # of ``equipoise methods``
    hold: tuple[str, ...] = ()  # parameters kept at the testbed's value
    terms: tuple[str, ...] = ()  # torques to estimate, beside the testbed's own
    use_prior: bool = False  # the testbed's inertia and centre of mass count as knowledge
    since: float | None = None  # s: from all that was recorded since then, not this swing alone


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """What is wanted of the devices, all in body axes; who has which device is not a law's matter.

    What cannot be delivered is limited by whoever carries it out, and the next Sample says what
    was: a law that integrates must use that (anti-windup).
    """

    shift: Vector3 | None = None  # m, by the masses, counted from home; None: they stay
    torque: Vector3 | None = None  # N m on the platform, by wheels or gyros; None: none
    magnetic: Vector3 | None = None  # N m on the platform, by magnetorquers; None: none
    impulse: Vector3 | None = None  # N m s on the platform, by jets; None: none
    # With a measurement the next step is given its Estimate, not a Sample.
    measurement: Measurement | None = None
    finished: tuple[Reason, ...] = ()  # why the law has done its work; empty: it has not
    following: Following | None = None  # with ``finished``: what masses can follow from now on
    note: tuple[Reason, ...] = ()  # what people should know of this step
