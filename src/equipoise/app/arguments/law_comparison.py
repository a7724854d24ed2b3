"""Options of a comparison that are about laws."""

from dataclasses import dataclass

from cyclopts import Parameter

from equipoise.app.arguments.types import Triple


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class JudgingLaws:
    """What laws are to reach, and within what.

    Attributes
    ----------
    target_um
        Laws: where the centre of mass is wanted, from the centre of rotation, body axes.
    tolerance_um
        Laws: how near to the target is near enough, along each axis; verdicts are about it.
    tilt_deg
        Laws: torque counts over directions within so many degrees of level.
    require_torque
        Laws: torque that is wanted at most, rms over that range, N m.
    max_time_s
        Laws: bench time that each run may take, its proof included.
    """

    target_um: Triple = (0.0, 0.0, 0.0)
    tolerance_um: Triple = (2.0, 2.0, 3.0)
    tilt_deg: float = 20.0
    require_torque: float = 1e-5
    max_time_s: float = 600.0


AS_THEY_ARE = JudgingLaws()
