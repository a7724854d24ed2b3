"""Files that take an extra to read, and testbeds whose benches take one."""

from pathlib import Path

import numpy as np
import zstandard
from rosbags.rosbag1 import Writer

from equipoise.io.recording.recording_file import write_recording
from equipoise.io.testbed.presets import preset_text, read_preset
from equipoise.simulation.bench import SimulatedBench
from tests.support.excel_files import RATE_SHEET, workbook
from tests.support.flight_logs import flown
from tests.support.mat_files import mat_73
from tests.support.sample_logs import IMU, ROS1, bag_2, message

VECTORNAV = 'driver = "vectornav"\nport = "serial:/dev/ttyUSB1"'
# A socket that hears nothing can be opened on every computer, so the next thing is tried.
BOARD, OPEN = "serial:/dev/ttyUSB0", "udp:0"
CAMERA_BED = (
    preset_text("sputnix")
    .replace(BOARD, OPEN)
    .replace("serial:/dev/ttyUSB1", "udp:127.0.0.1:0")
    .replace("http://192.168.4.2:81/stream", "camera:0")
)
SENSORS = {
    "serial": VECTORNAV,
    "socket": 'driver = "rosbridge"\nport = "ws://127.0.0.1:9"',
    "vehicle": 'driver = "mavlink"\nport = "udp:14550"',
}


def write_files(folder: Path) -> None:
    """Write recordings as swing.*, a bag of ROS 1 and one of ROS 2, a log, pictures, testbeds."""
    swing = SimulatedBench(read_preset("nanosat"), 1).read(5.0)
    for suffix in ("csv", "parquet", "mcap"):
        write_recording(swing, folder / f"swing.{suffix}")
    (folder / "swing.csv.zst").write_bytes(zstandard.compress((folder / "swing.csv").read_bytes()))
    (folder / "swing.xlsx").write_bytes(workbook({"run": RATE_SHEET}))
    columns = np.asarray(RATE_SHEET[1:], dtype=np.float64).T
    (folder / "swing.mat").write_bytes(mat_73(dict(zip(RATE_SHEET[0], columns, strict=True))))
    (folder / "flight.tlog").write_bytes(flown("turned"))
    write_packed_bag(folder / "one.bag")
    bag_2(folder / "two", {"/imu": IMU})
    (folder / "pictures").mkdir()
    (folder / "pictures" / "a.png").write_bytes(b"")
    (folder / "camera.toml").write_text(CAMERA_BED, encoding="utf-8")
    for name, sensor in SENSORS.items():
        bed = preset_text("nanosat").replace(VECTORNAV, sensor).replace(BOARD, OPEN)
        (folder / f"{name}.toml").write_text(bed, encoding="utf-8")


def write_packed_bag(path: Path) -> None:
    """Write a bag of ROS 1 whose chunks are packed by LZ4."""
    writer = Writer(path)
    writer.set_compression(Writer.CompressionFormat.LZ4)
    with writer:
        connection = writer.add_connection("/imu", IMU, typestore=ROS1)
        for k in range(4):
            writer.write(connection, 77, ROS1.serialize_ros1(message(ROS1, IMU, k), IMU))
