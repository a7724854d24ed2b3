"""Guises of the file: compressed, of a spreadsheet, of MATLAB, logs of robots and of flights."""

import gzip
import io
import struct
import zipfile
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
import zstandard
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import Writer as Writer2

from equipoise.model.arrays import Series3, Series4
from tests.support.byte_captures import telemetry
from tests.support.excel_files import workbook
from tests.support.flight_logs import START, Station, dataflash, logged
from tests.support.mat_files import mat_5, mat_73
from tests.support.recordings.frame_guises import UPSIDE_DOWN, turned
from tests.support.recordings.motive_export import motive_export
from tests.support.recordings.recorded_motion import Motion
from tests.support.recordings.reported_guises import transforms
from tests.support.recordings.variant import Reads, Refused, answered
from tests.support.recordings.written_tables import columns, lines, named, ours, saved, text
from tests.support.sample_logs import IMU, ROS1, ROS2, TREE, reported

SINGLE, SINGLE_RATE = 1e-6, 1e-7  # rad, rad/s: what single precision leaves
ALONE = ("attitude",)


@answered(Reads("inspect"))
def gzip_of_a_table(motion: Motion, folder: Path) -> Path:
    return saved(folder, gzip.compress(text(ours(motion)).encode()), "run.csv.gz")


@answered(Reads())
def zip_with_a_readme(motion: Motion, folder: Path) -> Path:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("log/readme.md", "nothing")
        archive.writestr("log/run.csv", text(columns(motion)))
    return saved(folder, stream.getvalue(), "run.zip")


@answered(Reads())
def zstandard_of_a_table(motion: Motion, folder: Path) -> Path:
    return saved(folder, zstandard.compress(text(columns(motion)).encode()), "run.txt.zst")


@answered(Reads())
def sheet_of_excel(motion: Motion, folder: Path) -> Path:
    table = columns(motion)
    rows = zip(*(column.tolist() for column in table.values()), strict=True)
    sheets = {"Log": [list(table), *map(list, rows)], "Notes": [["tilted by hand"]]}
    return saved(folder, workbook(sheets), "run.xlsx")


@answered(Reads())
def structure_of_matlab(motion: Motion, folder: Path) -> Path:
    inner = {"t": motion.t[:, None], "quat": motion.q, "gyro": motion.w}
    return saved(folder, mat_5({"log": {"imu": inner, "name": "run 3"}}, packed=True), "run.mat")


@answered(Reads())
def structure_of_matlab_7_3(motion: Motion, folder: Path) -> Path:
    inner = {"t": motion.t[:, None], "quat": motion.q, "gyro": motion.w}
    return saved(folder, mat_73({"log": inner}), "run.mat")


@answered(Reads())
def one_matrix_of_matlab_7_3(motion: Motion, folder: Path) -> Path:
    whole = np.column_stack([motion.t, motion.q, motion.w])
    return saved(folder, mat_73({"data": whole}), "run.mat")


@answered(Reads())
def parquet_of_another_program(motion: Motion, folder: Path) -> Path:
    stream = io.BytesIO()
    pyarrow.parquet.write_table(pyarrow.table(columns(motion)), stream)
    return saved(folder, stream.getvalue(), "run.parquet")


@answered(Reads("inspect"))
def bag_of_ros_1(motion: Motion, folder: Path) -> Path:
    types = ROS1.types
    header, stamp = types["std_msgs/msg/Header"], types["builtin_interfaces/msg/Time"]
    turn, vector = types["geometry_msgs/msg/Quaternion"], types["geometry_msgs/msg/Vector3"]
    none, still = np.zeros(9), vector(0.0, 0.0, 0.0)
    path = folder / "run.bag"
    with Writer1(path) as writer:
        link = writer.add_connection("/imu/data", IMU, typestore=ROS1)
        for k, (t, (w, x, y, z), rate) in enumerate(_rows(motion.t, motion.q, motion.w)):
            head = header(k, stamp(1_700_000_000 + int(t), round(1e9 * (t % 1.0))), "imu")
            message = types[IMU](head, turn(x, y, z, w), none, vector(*rate), none, still, none)
            writer.write(link, 77, ROS1.serialize_ros1(message, IMU))
    return path


@answered(Reads("inspect", sensors=ALONE))
def bag_of_transforms_in_a_tree(motion: Motion, folder: Path) -> Path:
    path = folder / "tree"
    with Writer2(path, version=9) as writer:
        link = writer.add_connection("/tf", TREE, typestore=ROS2)
        for stamped in transforms(motion):
            tree = ROS2.types[TREE](np.array([stamped]))
            writer.write(link, 77, ROS2.serialize_cdr(tree, TREE))
    return path


def _rows(t: np.ndarray, q: Series4, w: Series3) -> list[tuple]:
    return list(zip(t.tolist(), q.tolist(), w.tolist(), strict=True))


def _flown(motion: Motion) -> list[tuple]:
    """Return rows in the axes of flight: FRD to NED."""
    return _rows(motion.t, *turned(motion, UPSIDE_DOWN, UPSIDE_DOWN))


@answered(Reads("inspect", turn=SINGLE, rate=SINGLE_RATE))
def ulog_of_px4(motion: Motion, folder: Path) -> Path:
    layouts = {
        "vehicle_attitude": b"uint64_t timestamp;uint64_t timestamp_sample;float[4] q;",
        "vehicle_angular_velocity": b"uint64_t timestamp;float[3] xyz;",
    }
    out = b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 5_000_000) + reported(b"B", bytes(40))
    out += b"".join(reported(b"F", f"{n}:".encode() + layout) for n, layout in layouts.items())
    for number, name in enumerate(layouts):
        out += reported(b"A", struct.pack("<BH", 0, number) + name.encode())
    for t, q, w in _flown(motion):
        us = 5_000_000 + round(1e6 * t)
        out += reported(b"D", struct.pack("<HQQ4f", 0, us + 999, us, *q))
        out += reported(b"D", struct.pack("<HQ3f", 1, us, *w))
    return saved(folder, out, "run.ulg")


@answered(Reads("inspect", turn=SINGLE, rate=SINGLE_RATE))
def dataflash_of_ardupilot(motion: Motion, folder: Path) -> Path:
    made: list[bytes] = []
    for t, q, w in _flown(motion):
        us = 7_000_000 + round(1e6 * t)
        made += [logged("XKQ", us, 0, *q), logged("IMU", us, 0, *w, 0, 0, -9.8)]
    return saved(folder, dataflash(*made), "run.bin")


@answered(Reads("inspect", turn=SINGLE, rate=SINGLE_RATE))
def telemetry_of_mavlink(motion: Motion, folder: Path) -> Path:
    vehicle = Station()
    frames = [(START, vehicle.beat(12))]
    frames += [
        (START + t, vehicle.packed("attitude_quaternion", 2000 + round(1e3 * t), *q, *w))
        for t, q, w in _flown(motion)
    ]
    return saved(folder, telemetry(frames), "run.tlog")


@answered(Refused("no body 'Tower'", "one of Base, Platform", options=("--body", "Tower")))
def a_body_that_is_not_there(motion: Motion, folder: Path) -> Path:
    return saved(folder, motive_export(motion, ("Base", "Platform")))


@answered(Refused("2 files in a zip archive: a.csv, b.csv", "unpack the one you want"))
def zip_with_two_tables(motion: Motion, folder: Path) -> Path:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name in ("a.csv", "b.csv"):
            archive.writestr(name, text(columns(motion)))
    return saved(folder, stream.getvalue(), "run.zip")


@answered(Refused("gzip file that cannot be read", "copy it again"))
def gzip_cut_short(motion: Motion, folder: Path) -> Path:
    return saved(folder, gzip.compress(text(ours(motion)).encode())[:9000], "run.csv.gz")


@answered(Reads(sensors=ALONE))
def camera_alone_in_a_sheet(motion: Motion, folder: Path) -> Path:
    rows = [list(row) for row in zip(motion.t.tolist(), *motion.q.T.tolist(), strict=True)]
    return saved(folder, workbook({"Log": [["t", "q0", "q1", "q2", "q3"], *rows]}), "run.xlsx")


@answered(Refused("binary content: a PDF", r"a recording \(CSV"))
def a_report_in_place_of_the_table(motion: Motion, folder: Path) -> Path:
    return saved(
        folder, b"%PDF-1.7\n" + "\n".join(lines(named(("t",), motion.t[:, None]))).encode()
    )
