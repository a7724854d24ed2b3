"""Options that every command shares which looks for mass properties."""

from dataclasses import dataclass

from cyclopts import Parameter

from equipoise.app.arguments.types import Flag, Names


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Seeking:
    """What is sought, and what is taken as known.

    Attributes
    ----------
    hold
        Parameter to keep at the testbed's value, such as inertia_P_zz. May be repeated.
    term
        Torque to seek too: viscous, quadratic, constant, swirl, sag or drift. May be repeated.
    prior
        Use the testbed's inertia and centre of mass with their sd; this fixes an open scale.
    """

    hold: Names = ()
    term: Names = ()
    prior: Flag = False


NOTHING_STATED = Seeking()
