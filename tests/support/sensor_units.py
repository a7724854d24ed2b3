"""A unit of every sensor driver, with the fewest settings that it needs."""

import numpy as np

from equipoise.hardware.sensors.registry import DRIVERS
from equipoise.model.hardware import Port, SensorUnit

BOTH, TURN = ("attitude", "rate"), ("attitude",)
ROW = ("t_ms", "qw", "qx", "qy", "qz", "gx_deg_s", "gy_deg_s", "gz_deg_s")

CAMERA = {
    "columns": 6.0,
    "rows": 5.0,
    "marker_mm": 40.0,
    "gap_mm": 10.0,
    "width_px": 1280.0,
    "height_px": 960.0,
    "fx_px": 1200.0,
    "fy_px": 1200.0,
    "cx_px": 639.5,
    "cy_px": 479.5,
    "k1": -0.1,
}

# port, what it gives, settings
NEEDS = {
    "camera": ("http://127.0.0.1:81/stream", TURN, CAMERA),
    "lines": ("serial:X", BOTH, {"columns": ROW}),
    "mavlink": ("serial:X", BOTH, {}),
    "natnet": ("udp:239.255.42.99:1511", TURN, {"body": 1.0}),
    "rosbridge": ("ws://ros:9090", BOTH, {"topic_attitude": "/imu", "topic_rate": "/imu"}),
    "vectornav": ("serial:X", BOTH, {}),
}
PICTURES = {"camera"}  # see what they are shown, noise and all, and not from every side
MESSAGES = {"natnet", "rosbridge"}  # fed a message at a time, others a byte at a time


def unit(driver, laboratory="ned", alignment=None, **settings):
    """Return a unit; settings that are given come instead of the fewest."""
    turn = np.eye(3) if alignment is None else alignment
    port, gives, fewest = NEEDS[driver]
    return SensorUnit("imu", driver, Port(port), gives, turn, laboratory, settings or fewest)


def pieces(driver, message):
    """Return what a port would hand on of a message, in the smallest pieces."""
    if driver in MESSAGES:
        return [message]
    return [message[k : k + 1] for k in range(len(message))]


assert NEEDS.keys() == DRIVERS.keys()
