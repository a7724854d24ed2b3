"""Design: whether masses and sensors are good enough, and what limits them."""

from collections.abc import Mapping, Sequence

from equipoise.app.arguments.checks import Triple, not_negative, one_of, positive, vector
from equipoise.app.arguments.inputs import TILT, AnyTestbed, testbed_with_masses
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.environment import Surroundings
from equipoise.planning.sizing.sizing import Sizing, sized


def design(
    testbed: AnyTestbed,
    *,
    durations: Sequence[float] = (30.0, 60.0, 120.0, 300.0),
    target: Triple = (0.0, 0.0, 0.0),
    tilt: float = TILT,
    moves: int = 2,
    misalignment: float = 0.0,
    surroundings: Mapping[str, float] | None = None,
    require_torque: float | None = None,
) -> Sizing:
    """Return what masses and sensors are good for: reach, steps, bounds, and the torque left.

    The budget is for the shortest recording. Whether the requirement is met is ``outcome``.

    Parameters
    ----------
    testbed
        Testbed, its file, or a preset's name.
    durations
        Lengths of the recordings that the centre of mass is estimated from, s.
    target
        Where the centre of mass is wanted, from the centre of rotation, body axes, m.
    tilt
        Torque counts over directions within this angle of level, rad.
    moves
        How often the centre of mass is estimated and the masses are moved.
    misalignment
        Error of the rails' directions, one sd about both axes across, rad.
    surroundings
        What the platform is exposed to afterwards, SI: temperature (change, K), expansion (1/K),
        length (m), lopsided, bending (Hz), bending_share, form_error (m), air_change, volume (m^3),
        lever (m), slew (rad/s), air (N m).
    require_torque
        Torque that may be left at most, rms over that range, N m.

    Raises
    ------
    InputError
        For files that cannot be read, unknown names, numbers out of range, and a testbed without
        masses or sensors.
    """
    lengths = [positive("durations", length) for length in durations]
    positive("require_torque", require_torque)
    case = Case(
        testbed_with_masses(testbed),
        vector("target", target, 1.0),
        positive("tilt", tilt),
        lengths[0],
        int(positive("moves", moves)),
        not_negative("misalignment", misalignment),
        _surroundings(surroundings or {}),
    )
    return sized(case, lengths, require_torque)


def _surroundings(stated: Mapping[str, float]) -> Surroundings:
    """Return what is stated; InputError for an unknown name or a number below zero."""
    known = list(Surroundings.__dataclass_fields__)
    for name, value in stated.items():
        not_negative(one_of("surroundings", name, known), value)
    return Surroundings(**stated)
