"""The tables of a testbed file that tell what is connected: motor boards, sensors, limits.

A unit is part of its key. Nothing is converted here; ``hardware_build`` does that once.
"""

from typing import Annotated, Literal

from pydantic import Field

from equipoise.io.toml.key_types import Name, Positive, Square, Table

Address = Annotated[
    str,
    Field(
        pattern=r"^(serial:.+|tcp:.+:\d+|udp:(.+:)?\d+|udpout:.+:\d+|ws://.+|wss://.+|https?://.+"
        r"|camera:\d+(@\d+x\d+)?)$"
    ),
]
ADDRESSES = (
    "serial:/dev/ttyUSB0, serial:COM3, tcp:HOST:PORT, udp:PORT, udpout:HOST:PORT, ws://..., "
    "http://..., camera:0"
)
Baud = Annotated[int, Field(gt=0)]
IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


class Axis(Table):
    """One axis of a motor board and the mass that it moves."""

    mass: str
    letter: Annotated[str, Field(pattern=r"^([XYZABC]|[0-9])$")] = Field(
        description="the board's name of the axis; of a Trinamic module the motor's number"
    )
    steps_per_mm: Positive = Field(description="as set in the board, which is asked for it")
    zero_mm: float = Field(0.0, description="the board's position where the mass is at home")
    reversed: bool = Field(False, description="the board counts against the mass's axis")


class Board(Table):
    """A board that moves sliding masses."""

    name: Name
    driver: str = Field(description="grbl or tmcl")
    port: Address = Field(description=ADDRESSES)
    baud: Baud = 115200
    homing: bool = Field(True, description="it has switches; else a person puts masses at home")
    axis: Annotated[list[Axis], Field(min_length=1)]


class SensorUnit(Table):
    """A device that sees attitude, rate or both."""

    name: Name
    driver: str = Field(description="vectornav, lines, mavlink, natnet, rosbridge or camera")
    port: Address = Field(description=ADDRESSES)
    baud: Baud = 115200
    gives: Annotated[list[Literal["attitude", "rate"]], Field(min_length=1)]
    alignment: Square = Field(IDENTITY, description="rotation from the sensor's axes to the body's")
    laboratory: Literal["z_up", "ned", "y_up"] = Field(
        "z_up", description="the frame that its attitude refers to"
    )
    settings: dict[str, str | float | bool | list[str]] = Field(
        {}, description="the driver's own, such as the columns of a line"
    )


class Hardware(Table):
    """What is connected, and beyond which limits every motor is stopped."""

    rate_limit_deg_s: Positive = Field(60.0, description="chosen: far above any free swing")
    stale_s: Positive = Field(0.5, description="chosen: without a row or an answer for so long")
    mismatch_mm: Positive = Field(
        1.0, description="chosen: between where a mass should be and where its board says it is"
    )
    board: list[Board] = Field([])
    sensor: list[SensorUnit] = Field([])
