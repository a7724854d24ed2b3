"""Every format of mass properties, in one table: its suffix, and how it is written."""

from collections.abc import Callable
from dataclasses import dataclass

from equipoise.io.exchange import data_formats, script_formats, xml_formats
from equipoise.model.stated_body import StatedBody


@dataclass(frozen=True, slots=True)
class BodyFormat:
    """How one tool takes a rigid body."""

    suffix: str
    reader: str  # whose format it is
    write: Callable[[StatedBody], str | bytes]


FORMATS = {
    "urdf": BodyFormat(".urdf", "ROS, Gazebo, Drake, pinocchio", xml_formats.urdf),
    "sdf": BodyFormat(".sdf", "Gazebo", xml_formats.sdf),
    "mjcf": BodyFormat(".xml", "MuJoCo", xml_formats.mjcf),
    "basilisk": BodyFormat(".py", "Basilisk", script_formats.basilisk),
    "42": BodyFormat(".txt", "42, lines of a spacecraft file", script_formats.nasa_42),
    "matlab": BodyFormat(".mat", "MATLAB, GNU Octave, scipy", data_formats.matlab),
    "simulink": BodyFormat(".m", "Simscape Multibody's block Inertia", script_formats.simulink),
    "yaml": BodyFormat(".yaml", "any reader of YAML", data_formats.yaml),
    "csv": BodyFormat(".csv", "any spreadsheet", data_formats.csv_table),
    "ros": BodyFormat(".yaml", "geometry_msgs/Inertia", data_formats.ros),
}  # fmt: skip
