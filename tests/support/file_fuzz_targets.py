"""Files as fuzz targets: whatever is in one, it is read, or refused with the declared error."""

import contextlib
import functools
import gzip
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import zstandard

from equipoise.app.runs.captures.captured_bytes import recording_of_capture
from equipoise.hardware.camera.eye import eye_of
from equipoise.hardware.emulated.registry import SENSORS
from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.documents.camera_file import read_camera_keys
from equipoise.io.documents.manual_session import Piles, read_session
from equipoise.io.documents.plan_file import read_plan
from equipoise.io.files.file_content import Content
from equipoise.io.mcap.mcap_salvage import salvaged
from equipoise.io.mcap.protobuf_fields import fields
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.io.testbed.presets import preset_text, read_preset
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording, Samples
from tests.support import flight_logs
from tests.support.byte_captures import datagram_packet, pcap, pcapng, telemetry
from tests.support.column_map_fuzz import mapped_table
from tests.support.excel_files import RATE_SHEET, archive, workbook
from tests.support.flight_logs import terminal
from tests.support.fuzz_target import Target, folder
from tests.support.mat_files import mat_4, mat_73
from tests.support.sample_logs import IMU, bag_1, bag_2_file, record, ulog
from tests.support.sensor_units import CAMERA, unit

SHARE_OF_MAPS = 5.0  # their keys are many, and tables have many shapes
# rosbags, pyarrow, SQLite and a process for HDF5 take long to begin, and are others' to test.
SHARE_OF_LIBRARIES = 0.02

MAP = """
separator = ","
[time]
column = "time_s"
unit = "s"
[rate]
columns = ["omega_x_rad_s", "omega_y_rad_s", "omega_z_rad_s"]
unit = "rad/s"
axes = ["x", "-y", "-z"]
[[mass]]
name = "x1"
column = "x1_mm"
unit = "mm"
"""
TIMES = 0.02 * np.arange(3)
THREE = Recording(
    Samples(TIMES, np.tile([1.0, 0.0, 0.0, 0.0], (3, 1))),
    Samples(TIMES, np.outer(TIMES, [1.0, 2.0, 3.0])),
)
SESSION = """
testbed = "weights-by-hand"
target_um = [0, 0, -100]
tolerance_um = [2, 2, 3]
max_rounds = 4
[[round]]
recording = "run1.csv"
sha256 = "1f"
from_s = 1.5
placed = ["3 x washer at deck:I6", "1 x washer at deck:A1"]
"""
PLAN = """
testbed = "sputnix"
duration_s = 60
[start]
tilt_deg = 10
low_side = [1, 0.5, 0]
rate_deg_s = [0, 0, 3]
[standing.at_mm]
x1 = 1.0
[[move]]
time_s = 20
[move.to_mm]
x1 = 4.0
y2 = -3.0
[predicted]
com_sd_um = [1, 1, 1]
inertia_sd_kg_m2 = [1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4]
"""


def at(suffix: str, read: Callable[[Path], object]) -> Callable[[bytes], None]:
    """Return what a reader does with a file of a suffix."""

    def take(content: bytes) -> None:
        path = folder() / f"fuzz{suffix}"
        path.write_bytes(content)
        with contextlib.suppress(InputError):
            read(path)

    return take


def written(suffix: str) -> Callable[[], bytes]:
    """Return what makes a record of ours in the format of a suffix."""

    def made() -> bytes:
        with tempfile.TemporaryDirectory() as place:
            write_recording(record(), Path(place) / f"run{suffix}")
            return (Path(place) / f"run{suffix}").read_bytes()

    return functools.cache(made)


def bag(make: Callable[[Path, dict[str, str]], Path]) -> Callable[[], bytes]:
    """Return what makes a bag that is one file."""

    def made() -> bytes:
        with tempfile.TemporaryDirectory() as place:
            return make(Path(place) / "run.bag", {"/imu": IMU}).read_bytes()

    return functools.cache(made)


def recording(path: Path) -> None:
    """A recording that is read can be reckoned with: times rise, numbers are finite."""
    found = read_recording(path)
    for name in CHANNELS:
        channel = getattr(found, name)
        if channel is not None:
            assert np.all(np.diff(channel.t) > 0)
            assert np.isfinite(channel.t).all()


def mcap(path: Path) -> None:
    """All that is in a record, and what is left of it."""
    content = path.read_bytes()
    assert salvaged(Content.of(content, "log"), "fuzz").lost_bytes <= len(content)
    with contextlib.suppress(InputError):
        recording(path)


def message(content: bytes) -> None:
    """A message of protocol buffers says ValueError: its reader counts it as lost."""
    with contextlib.suppress(ValueError):
        fields(content)


bed = functools.cache(read_preset)


def session(path: Path) -> None:
    """A session, and what lies on the platform by it."""
    piles = Piles(bed("weights-by-hand"))
    for each in read_session(path).round:
        piles.loading(each.placed or [], "fuzz")


def plan(path: Path) -> None:
    """A manoeuvre of one testbed."""
    read_plan(path, bed("sputnix"))


def camera(path: Path) -> None:
    """A description of a board and a lens."""
    eye_of(read_camera_keys(path), "fuzz")


def keys(table: dict[str, float]) -> bytes:
    """Return flat TOML."""
    return "".join(f"{key} = {value:g}\n" for key, value in table.items()).encode()


MESSAGE = bytes.fromhex("0a0208011500000000190000000000000000")  # one field of each wire type


def captured(driver: str) -> Callable[[Path], None]:
    """Return what a driver does with a file of saved bytes: times rise, numbers are finite."""

    def read(path: Path) -> None:
        found = recording_of_capture(str(path), unit(driver), None, lambda _share: None)
        assert found.attitude is not None or found.rate is not None
        for channel in (found.attitude, found.rate):
            if channel is not None:
                assert np.all(np.diff(channel.t) > 0)
                assert np.all(np.isfinite(channel.values))

    return read


def excel() -> bytes:
    """Return a workbook of one sheet."""
    return workbook({"run": RATE_SHEET})


def packed(pack: Callable[[bytes], bytes]) -> bytes:
    """Return our CSV, compressed."""
    return pack(written(".csv")())


PACKED = {
    "gzip": functools.partial(gzip.compress, mtime=0),
    "zip": lambda content: archive({"run.csv": content}),
    "Zstandard": zstandard.compress,
}
RATES = {"time_s": TIMES} | {
    f"omega_{k}_rad_s": THREE.rate.values[:, i] for i, k in enumerate("xyz")
}


def traffic(form: Callable[[list[tuple[float, bytes]]], bytes]) -> bytes:
    """Return three frames of Motive as network traffic."""
    frames = SENSORS["natnet"](unit("natnet")).messages(THREE)
    return form([(1.7e9 + 0.02 * k, datagram_packet(each, 1511)) for k, each in enumerate(frames)])


def flight() -> bytes:
    """Return a telemetry log of three rows of each channel."""
    frames = SENSORS["mavlink"](unit("mavlink")).messages(THREE)
    return telemetry([(1.7e9 + 0.01 * k, each) for k, each in enumerate(frames)])


TARGETS = (
    Target("CSV", written(".csv"), at(".csv", recording)),
    Target("MCAP", written(".mcap"), at(".mcap", mcap)),
    Target("MAT", written(".mat"), at(".mat", recording)),
    Target("MAT of version 4", functools.partial(mat_4, RATES), at(".mat", recording)),
    Target(
        "MAT of version 7.3",
        functools.partial(mat_73, RATES),
        at(".mat", recording),
        SHARE_OF_LIBRARIES,
    ),
    Target("Excel", excel, at(".xlsx", recording)),
    *(
        Target(name, functools.partial(packed, pack), at(".dat", recording))
        for name, pack in PACKED.items()
    ),
    Target("Parquet", written(".parquet"), at(".parquet", recording), SHARE_OF_LIBRARIES),
    Target("bag of ROS 1", bag(bag_1), at(".bag", recording), SHARE_OF_LIBRARIES),
    Target("bag of ROS 2", bag(bag_2_file), at(".db3", recording), SHARE_OF_LIBRARIES),
    Target("ULog", lambda: ulog("sensor_combined"), at(".ulg", recording)),
    Target("log of ArduPilot", lambda: flight_logs.flight("XKQ", "IMU"), at(".bin", recording)),
    Target(
        "log of MAVLink", lambda: flight_logs.flown("angles", "highres"), at(".tlog", recording)
    ),
    Target("log of VectorNav", lambda: terminal("VNQMR").encode(), at(".log", recording)),
    Target(
        "protocol buffers", lambda: bytes.fromhex("0a0208011500000000190000000000000000"), message
    ),
    Target("testbed", lambda: preset_text("nanosat").encode(), at(".toml", read_testbed)),
    Target("plan", PLAN.encode, at(".toml", plan)),
    Target("column map", MAP.encode, at(".toml", read_column_map)),
    Target("column map on a table", lambda: b"any map", mapped_table, SHARE_OF_MAPS),
    Target("session", SESSION.encode, at(".toml", session)),
    *(
        Target(name, made, at(".bin", captured(driver)))
        for name, driver, made in (
            ("pcap", "natnet", functools.partial(traffic, pcap)),
            ("pcapng", "natnet", functools.partial(traffic, pcapng)),
            ("telemetry log", "mavlink", flight),
        )
    ),
    Target("camera", lambda: keys(CAMERA), at(".toml", camera)),
)
