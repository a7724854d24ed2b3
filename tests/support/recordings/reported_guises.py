"""Guises that people report in public: each was read wrong, or not at all, once."""

from pathlib import Path

import numpy as np
from rosbags.rosbag2 import StoragePlugin, Writer

from equipoise.maths.attitude import conjugate
from tests.support.mat_files import mat_5
from tests.support.recordings.motive_export import motive_export
from tests.support.recordings.recorded_motion import Motion
from tests.support.recordings.variant import Reads, Refused, answered
from tests.support.recordings.written_tables import (
    OURS,
    ROS,
    changed,
    columns,
    lines,
    named,
    ours,
    saved,
    text,
)
from tests.support.sample_logs import ROS2, TRANSFORM

SPIKY_ROWS = (300, 777, 1501, 2000, 2222)
NAN_ROWS = (7, 400, 800, 1200, 1600, 2000, 2400)


@answered(Reads("inspect", lost=(300,), said=r"1 row whose time is out of order, line 302"))
def one_wild_stamp(motion: Motion, folder: Path) -> Path:
    rows = lines(ours(motion, ROS))
    return saved(folder, changed(rows, {300: "9" + rows[301]}))


@answered(Reads(said="The clock restarted after 4294"))
def micros_wrap(motion: Motion, folder: Path) -> Path:
    counted = np.round(1e6 * motion.t + 2.0**32 - 36e6) % 2.0**32
    return saved(folder, text(columns(motion, "micros", counted)))


@answered(Reads(inspected="turns = .*laboratory to body", said="it turns laboratory to body"))
def inverse_quaternion_with_gyro(motion: Motion, folder: Path) -> Path:
    values = np.column_stack([motion.t, conjugate(motion.q), motion.w])
    return saved(folder, text(named(ROS, values)))


@answered(
    Reads("inspect", lost=NAN_ROWS, sensors=("attitude",), said="7 rows .* no number, line 9")
)
def writetable_nan(motion: Motion, folder: Path) -> Path:
    rows = lines(named(OURS[:5], np.column_stack([motion.t, motion.q])))
    lost = {k: rows[k + 1].split(",")[0] + ",NaN" * 4 for k in NAN_ROWS}
    return saved(folder, changed(rows, lost))


@answered(Reads(lost=SPIKY_ROWS, rate_lost=(), said="5 rows with a quaternion that has not"))
def spiky_quats(motion: Motion, folder: Path) -> Path:
    rows = lines(columns(motion))
    garbage = ("0,0,0,0", "1,1,1,1", "-7,3,2,0", "32,0,0,1", ".3,.3,0,0")
    spikes = dict(zip(SPIKY_ROWS, garbage, strict=True))
    cells = {k: rows[k + 1].split(",") for k in spikes}
    bad = {k: ",".join([cells[k][0], spike, *cells[k][5:]]) for k, spike in spikes.items()}
    return saved(folder, changed(rows, bad))


@answered(Reads(lost=(57,), said="1 row with fewer cells than the header, line 59"))
def garbled(motion: Motion, folder: Path) -> Path:
    rows = lines(columns(motion))
    return saved(folder, changed(rows, {57: rows[58][:24]}))


@answered(Reads())
def trailing_header(motion: Motion, folder: Path) -> Path:
    head, *rows = lines(columns(motion))
    return saved(folder, "\n".join([f"{head},", *rows]))


@answered(Reads(said="Line 2 holds units"))
def units_row(motion: Motion, folder: Path) -> Path:
    head, *rows = lines(columns(motion))
    return saved(folder, "\n".join([head, "[ms],-,-,-,-,[rad/s],[rad/s],[rad/s]", *rows]))


@answered(Reads(said="cut in two by a decimal comma"))
def comma_comma(motion: Motion, folder: Path) -> Path:
    table = columns(motion, t=1e3 * motion.t + 0.5)
    head, *rows = lines(table)
    return saved(folder, "\n".join([head, *(row.replace(".", ",") for row in rows)]))


@answered(Reads(said="Each line starts with the terminal's clock"))
def arduino_stamp(motion: Motion, folder: Path) -> Path:
    head, *rows = lines(columns(motion), "\t")
    ms = np.round(1e3 * motion.t).astype(int).tolist()
    stamps = [f"23:59:{30 + k // 1000 % 30:02d}.{k % 1000:03d}" for k in ms]
    log = ["14:03:21.000 -> Initializing...", "14:03:21.800 -> sensor ready"]
    log += [f"14:03:22.001 -> {head}"]
    log += [f"{stamp} -> {row}" for stamp, row in zip(stamps, rows, strict=True)]
    return saved(folder, "\n".join(log), "run.txt")


@answered(Refused("2 bodies: Base, Platform", "--body NAME", by=("inspect",)))
def motive_two_bodies(motion: Motion, folder: Path) -> Path:
    return saved(folder, motive_export(motion, ("Base", "Platform")))


@answered(Reads("inspect", options=("--body", "Platform"), sensors=("attitude",)))
def motive_two_bodies_of_which_one_is_named(motion: Motion, folder: Path) -> Path:
    return saved(folder, motive_export(motion, ("Base", "Platform")))


@answered(Reads("inspect", sensors=("attitude",), said="geometry_msgs/msg/TransformStamped"))
def bag_transformstamped(motion: Motion, folder: Path) -> Path:
    path = folder / "vicon"
    with Writer(path, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
        link = writer.add_connection("/vicon/platform/platform", TRANSFORM, typestore=ROS2)
        for stamped in transforms(motion):
            writer.write(link, 77, ROS2.serialize_cdr(stamped, TRANSFORM))
    return path


def transforms(motion: Motion, start: int = 1_700_000_000) -> list[object]:
    """Return a message of each attitude."""
    types = ROS2.types
    stamp, header = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]
    turn, still = types["geometry_msgs/msg/Quaternion"], types["geometry_msgs/msg/Vector3"](0, 0, 0)
    transform, stamped = types["geometry_msgs/msg/Transform"], types[TRANSFORM]
    made: list[object] = []
    for t, (w, x, y, z) in zip(motion.t.tolist(), motion.q.tolist(), strict=True):
        head = header(stamp(start + int(t), round(1e9 * (t % 1.0))), "world")
        made.append(stamped(head, "platform", transform(still, turn(x, y, z, w))))
    return made


@answered(Reads())
def matrix_mat(motion: Motion, folder: Path) -> Path:
    variables = {"t": motion.t[:, None], "q": motion.q, "w": motion.w}
    return saved(folder, mat_5(variables), "run.mat")


@answered(Reads(sensors=("attitude",), said="this direction of the attitude alone"))
def struct_mat(motion: Motion, folder: Path) -> Path:
    table = named(("t", "qw", "qx", "qy", "qz"), np.column_stack([motion.t, motion.q]))
    return saved(folder, mat_5({"data": table}), "run.mat")
