"""Guises of the axes: of laboratory and body, of the gyro, of angles."""

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from equipoise.maths.attitude import conjugate
from equipoise.model.arrays import Floats, Matrix3, Series3, Series4
from tests.oracle.mujoco_bench import product
from tests.support.recordings.motive_export import y_up
from tests.support.recordings.recorded_motion import Motion
from tests.support.recordings.variant import Reads, Refused, answered
from tests.support.recordings.written_tables import ROS, columns, named, saved, text

UPSIDE_DOWN = np.diag([1.0, -1.0, -1.0])  # of FLU to FRD, and of a laboratory with z up to z down
SIDEWAYS = np.array([[0.0, 0, 1], [1, 0, 0], [0, 1, 0]])  # our z is its x
QUARTER = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])  # a sensor turned by 90 deg on its deck
ANGLES = ("roll_deg", "pitch_deg", "yaw_deg")
PRINTED = 2e-4  # rad: angles have two decimals of a degree, and three of them add up


def turned(motion: Motion, body: Matrix3, lab: Matrix3 | None = None) -> tuple[Series4, Series3]:
    """Return attitude and rate with axes of the body (rows: theirs in ours), of the laboratory."""
    q = product(motion.q, conjugate(_quaternion(body)))
    return q if lab is None else product(_quaternion(lab), q), motion.w @ body.T


def _quaternion(axes: Matrix3) -> Floats:
    """Return a rotation as a quaternion, scalar first, a row."""
    x, y, z, w = Rotation.from_matrix(axes).as_quat()
    return np.array([[w, x, y, z]])


def angles(motion: Motion, sequence: str) -> Series3:
    """Return angles about x, y, z (deg) of a sequence as in SciPy."""
    found = Rotation.from_quat(motion.q[:, [1, 2, 3, 0]]).as_euler(sequence, degrees=True)
    return found[:, [sequence.lower().index(axis) for axis in "xyz"]]


def of_angles(motion: Motion, degrees: Floats, names: tuple[str, ...] = ANGLES) -> str:
    """Return a table of angles and rates."""
    values = np.column_stack([motion.t, np.round(degrees, 2), motion.w])
    return text(named(("time_s", *names, "gx", "gy", "gz"), values))


@answered(Reads(said="up: y of the laboratory"))
def laboratory_y_up(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion, q=y_up(motion.q))))


@answered(Reads(inspected="gravity does not point down", said="up: y of the laboratory"))
def laboratory_y_up_in_a_table_of_ros(motion: Motion, folder: Path) -> Path:
    values = np.column_stack([motion.t, y_up(motion.q), motion.w])
    return saved(folder, text(named(ROS, values)))


@answered(Reads(said="up: x of the laboratory", renamed=True))
def laboratory_x_up_without_names(motion: Motion, folder: Path) -> Path:
    q = product(_quaternion(SIDEWAYS), motion.q)
    table = columns(motion, "c0", q=q, turn=("c1", "c2", "c3", "c4"), rate=("c5", "c6", "c7"))
    return saved(folder, text(table))


@answered(Reads(said="it turns laboratory to body"))
def laboratory_to_body(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion, q=conjugate(motion.q))))


@answered(Reads(renamed=True))
def scalar_last_without_names(motion: Motion, folder: Path) -> Path:
    table = columns(motion, "c0", q=motion.q[:, [1, 2, 3, 0]], turn=("c1", "c2", "c3", "c4"),
                    rate=("c5", "c6", "c7"))  # fmt: skip
    return saved(folder, text(table))


@answered(Reads(renamed=True))
def scalar_last_laboratory_to_body_without_names(motion: Motion, folder: Path) -> Path:
    table = columns(motion, "c0", q=conjugate(motion.q)[:, [1, 2, 3, 0]],
                    turn=("c1", "c2", "c3", "c4"), rate=("c5", "c6", "c7"))  # fmt: skip
    return saved(folder, text(table))


@answered(Reads(renamed=True))
def sensor_turned_on_its_deck(motion: Motion, folder: Path) -> Path:
    q, w = turned(motion, QUARTER)
    return saved(folder, text(columns(motion, q=q, w=w)))


@answered(Reads(renamed=True, said="x of the attitude's body"))
def sensor_on_its_side(motion: Motion, folder: Path) -> Path:
    q, w = turned(motion, SIDEWAYS)
    return saved(folder, text(columns(motion, q=q, w=w)))


@answered(Reads(renamed=True, said="-z of the attitude's body"))
def sensor_upside_down(motion: Motion, folder: Path) -> Path:
    q, w = turned(motion, UPSIDE_DOWN)
    return saved(folder, text(columns(motion, q=q, w=w)))


@answered(Reads(said="left-handed"))
def gyro_left_handed(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion, w=motion.w[:, [1, 0, 2]])))


@answered(Reads(said="-'gy'"))
def gyro_with_one_sign_wrong(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion, w=motion.w * [1.0, -1.0, 1.0])))


@answered(Reads(inspected="(?s)gyro.*(rate|axes)", said="left-handed"))
def gyro_with_one_sign_wrong_in_a_table_of_ros(motion: Motion, folder: Path) -> Path:
    values = np.column_stack([motion.t, motion.q, motion.w * [1.0, 1.0, -1.0]])
    return saved(folder, text(named(ROS, values)))


@answered(Reads(said="x, y, z = 'gz', 'gx', 'gy'"))
def gyro_axes_in_cyclic_order(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion, w=motion.w[:, [1, 2, 0]])))


@answered(Refused("laboratory axes", "convert the rates to body axes", by=("import",)))
def rates_in_laboratory_axes(motion: Motion, folder: Path) -> Path:
    turn = Rotation.from_quat(motion.q[:, [1, 2, 3, 0]])
    return saved(folder, text(columns(motion, w=turn.apply(motion.w))))


@answered(Reads("inspect", turn=PRINTED, sensors=("attitude",), said="ZYX"))
def roll_pitch_yaw(motion: Motion, folder: Path) -> Path:
    values = np.column_stack([motion.t, np.round(angles(motion, "ZYX"), 2)])
    return saved(folder, text(named(("time_s", *ANGLES), values)))


@answered(Reads(inspected="ZYX|--columns", turn=PRINTED, said="XYZ"))
def roll_pitch_yaw_in_another_order(motion: Motion, folder: Path) -> Path:
    return saved(folder, of_angles(motion, angles(motion, "XYZ")))


@answered(Reads(inspected="ZYX|--columns", turn=PRINTED, said="-'yaw_deg'"))
def compass_heading(motion: Motion, folder: Path) -> Path:
    heading = angles(motion, "ZYX") * [1.0, 1.0, -1.0]
    heading[:, 2] %= 360.0
    return saved(folder, of_angles(motion, heading))


@answered(Reads(turn=PRINTED, said="in deg"))
def phi_theta_psi_without_units(motion: Motion, folder: Path) -> Path:
    return saved(folder, of_angles(motion, angles(motion, "ZYX"), ("phi", "theta", "psi")))


@answered(Reads(said="changed its sign"))
def signs_of_quaternions_at_random(motion: Motion, folder: Path) -> Path:
    signs = np.random.default_rng(2).choice([-1.0, 1.0], len(motion.t))
    return saved(folder, text(columns(motion, q=motion.q * signs[:, None])))


@answered(Reads(sensors=("attitude",), said="this direction of the attitude alone"))
def camera_alone(motion: Motion, folder: Path) -> Path:
    table = columns(motion, q=conjugate(motion.q))
    return saved(folder, text({name: table[name] for name in ("ms", "qw", "qx", "qy", "qz")}))


def tilted(motion: Motion, angle_deg: float) -> Series4:
    """Return attitudes in a laboratory that was set up askew."""
    lean = np.radians([0.6 * angle_deg, 0.8 * angle_deg, 0.0])
    return product(_quaternion(Rotation.from_rotvec(lean).as_matrix()), motion.q)


@answered(Refused("4[4-6] deg from the laboratory's vertical", "level its axes", by=("import",)))
def laboratory_askew(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion, q=tilted(motion, 45.0))))


@answered(Refused("a vertical that is 24 deg from z", "level its axes", by=("import",)))
def laboratory_askew_beside_an_accelerometer(motion: Motion, folder: Path) -> Path:
    """By less than the platform's stop."""
    table = columns(motion, q=tilted(motion, 24.0))
    return saved(folder, text(table | accelerations(motion)))


@answered(Reads(said="vertical: by the accelerometer 'ax', 'ay', 'az' it is"))
def accelerometer_beside_the_gyro(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion) | accelerations(motion)))


def accelerations(motion: Motion) -> dict[str, Floats]:
    """Return what an accelerometer feels of gravity alone, in g."""
    turn = Rotation.from_quat(motion.q[:, [1, 2, 3, 0]])
    stand = turn.inv().apply([0.0, 0.0, 1.0])
    noise = np.random.default_rng(9).normal(0.0, 2e-3, stand.shape)
    return named(("ax", "ay", "az"), stand + noise)
