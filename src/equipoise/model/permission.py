"""What an experiment on the platform allows balancing masses to do."""

from collections.abc import Callable
from enum import StrEnum


class Permission(StrEnum):
    """What masses may do now."""

    FREE = "free"  # move within their budget
    HOLD = "hold"  # stand
    DONE = "done"  # the experiment is over


Experiment = Callable[[], str]  # a permission; called between two measurements, it never waits
