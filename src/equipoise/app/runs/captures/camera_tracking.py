"""Attitudes from pictures of a board of markers: what `equipoise track` does.

The recording is of the board's axes, turned to the body's by the alignment of the testbed's camera
where one is stated.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.bench.wall_clock import WallClock
from equipoise.hardware.camera.eye import Eye, eye_of, level_up
from equipoise.hardware.camera.pictures import pictures_of
from equipoise.hardware.camera.pose import Pose
from equipoise.hardware.camera.sight import Sight
from equipoise.hardware.links.frame_transform import as_sensed, placed
from equipoise.hardware.links.sensor_link import UNSTATED, SensorLink
from equipoise.hardware.sensors.registry import DRIVERS
from equipoise.hardware.transport.driver_protocol import driver_named
from equipoise.hardware.transport.reconnecting_port import Connection
from equipoise.io.documents.camera_file import read_camera_keys
from equipoise.maths.attitude import continuous, from_matrix, to_matrix
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.errors import InputError
from equipoise.model.hardware import Port, SensorUnit, Setting
from equipoise.model.reading import Rowless
from equipoise.model.reasons.reason import Code
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed

OnProgress = Callable[[float], None]


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """What pictures gave."""

    t: Sequence[float]  # s
    attitudes: Sequence[Floats]  # quaternions, body to laboratory
    sds: Sequence[float]  # rad, per axis, as stated; none where the port does not hand it on
    common: Sequence[float]  # rad, the part of it that is the same in all pictures
    unseen: Sequence[Rowless]  # pictures without an attitude, a reason each
    broken: int = 0  # that could not be read

    @property
    def pictures(self) -> int:
        """How many pictures there were."""
        return len(self.t) + sum(each.count for each in self.unseen) + self.broken


def unit_of(testbed: Testbed | None, files: Sequence[Path], address: str) -> SensorUnit:
    """Return the camera of a testbed, or one without an alignment, with the keys of files."""
    hardware = None if testbed is None else testbed.hardware
    sensors = () if hardware is None else hardware.sensors
    found = [unit for unit in sensors if unit.driver == "camera"]
    if testbed is not None and not found:
        wanted = 'a [[hardware.sensor]] with driver = "camera"'
        raise InputError(testbed.source or testbed.name, "no camera", wanted)
    plain = SensorUnit("camera", "camera", Port(address), ("attitude",), np.eye(3))
    unit = replace(found[0], port=Port(address)) if found else plain
    keys: dict[str, Setting] = dict(unit.settings)
    for path in files:
        keys |= read_camera_keys(path)
    return replace(unit, settings=keys)


def tracked(source: Path, unit: SensorUnit, rate: float | None, reported: OnProgress) -> Track:
    """Return the attitudes in a video or a folder of pictures."""
    eye = eye_of(unit.settings, "camera")
    sight = Sight(eye.board, eye.lens, "camera")
    t: list[float] = []
    poses: list[Pose] = []
    unseen: dict[Code, Rowless] = {}
    for taken in pictures_of(source, rate):
        _check_size(taken.grey.shape, eye, source)
        pose = sight.observe(taken.grey)
        if isinstance(pose, Pose):
            t.append(taken.t)
            poses.append(pose)
        else:
            before = unseen.get(pose.code)
            unseen[pose.code] = Rowless(pose, 1 if before is None else before.count + 1)
        reported(taken.share)
    attitudes = [
        placed(unit, "attitude", from_matrix(eye.to_laboratory @ pose.turn)) for pose in poses
    ]
    sds = [_per_axis(pose.covariance) for pose in poses]
    common = [_per_axis(pose.common) for pose in poses]
    return Track(t, attitudes, sds, common, tuple(unseen.values()))


def watched_camera(unit: SensorUnit, duration: float, reported: OnProgress) -> Track:
    """Return the attitudes that a camera shows for so long (s); Ctrl-C ends it early."""
    driver = driver_named(DRIVERS, unit.driver, "sensor")(unit)
    link = SensorLink(unit, driver, Connection(unit.port, open_port), UNSTATED)
    clock, t, attitudes = WallClock(), list[float](), list[Floats]()
    try:
        while clock.now < duration:
            for row in link.turn(clock.now):
                t.append(row.t)
                attitudes.append(row.values)
            reported(min(clock.now / duration, 1.0))
            clock.wait()
    except KeyboardInterrupt:
        pass
    finally:
        link.connection.close()
    if not t and link.connection.why:
        raise InputError(unit.port.address, link.connection.why, "a camera that can be reached")
    broken = driver.counts.corrupt + link.arrivals.missing
    return Track(t, attitudes, [], [], tuple(driver.rowless.values()), broken)


def recording_of_track(track: Track, source: str) -> Recording:
    """Return the attitudes as a recording; InputError if there are none."""
    if not track.t:
        why = "; ".join(f"{each.count}: {each.reason.sentence}" for each in track.unseen)
        found = f"an attitude in none of {track.pictures} pictures" + (f" ({why})" if why else "")
        raise InputError(source, found, "the board in view, as described in the settings")
    grows = np.concatenate([[True], np.diff(np.maximum.accumulate(track.t)) > 0])
    values = continuous(np.array(track.attitudes)[grows])
    return Recording(attitude=Samples(np.array(track.t)[grows], values), source=source)


def up_from(track: Track, unit: SensorUnit) -> tuple[Vector3, float]:
    """Return up in the camera's axes, of a board that lay level, and its spread (rad, one sd)."""
    eye = eye_of(unit.settings, "camera")
    boards = to_matrix(as_sensed(unit, "attitude", np.array(track.attitudes)))
    turns = eye.to_laboratory.T @ boards
    up = level_up(turns)
    off = [float(np.linalg.norm(turn[:, 2] - up)) for turn in turns]
    return up, math.hypot(*off) / math.sqrt(len(off))


def _per_axis(covariance: Matrix3) -> float:
    """Return the sd of an axis, rad, of a turn's covariance."""
    return math.sqrt(float(np.trace(covariance)) / 3)


def _check_size(shape: tuple[int, ...], eye: Eye, source: Path) -> None:
    height, width = shape[:2]
    if (width, height) != (eye.lens.width, eye.lens.height):
        wanted = f"{eye.lens.width} x {eye.lens.height} px, for which the lens is known"
        raise InputError(str(source), f"pictures of {width} x {height} px", wanted)
