"""What a law sees at each of its steps."""

from dataclasses import dataclass

from equipoise.model.arrays import Quaternion, Vector3


@dataclass(frozen=True, slots=True, eq=False)
class Sample:
    """Attitude and rate as filtered, inputs as measured; vectors in body axes."""

    t: float  # s
    q: Quaternion  # body to laboratory
    rate: Vector3  # rad/s, without the gyro's bias
    gravity: Vector3  # m/s^2, g_B = R(q)^T (0, 0, -g)
    shift: Vector3  # m, what the masses do to the centre of mass, counted from home, as reported
    momentum: Vector3  # N m s, stored in wheels and gyros, as measured
    torque: Vector3  # N m, mean of -h' since the last step, as measured
    impulse: Vector3  # N m s, of jets since the last step, as measured
    field: Vector3 | None  # T, magnetic; None: not known
