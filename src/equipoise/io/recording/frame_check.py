"""Whether the platform stands upright in the recording's laboratory frame, and what would."""

import math

import numpy as np

from equipoise.io.columns.axis_permutation import TO_Z_UP, axes_matrix
from equipoise.maths.attitude import tilt, to_matrix
from equipoise.model.arrays import Matrix3, Series1, Vector3
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed

TILTED = math.radians(60)  # chosen: no table on a hemisphere swings about a mean tilt beyond this
LEANS = math.radians(30)  # chosen: axes of a laboratory are made level at least by eye
TIMES = 3.0  # the scatter about it, from which a direction is another beyond doubt (chosen)
AXES = ("x", "y", "z", "-x", "-y", "-z")


def check_frame(recording: Recording, testbed: Testbed) -> None:
    """Raise InputError when gravity does not point down: the frame, not the platform, is turned.

    The sentence names what the rows show, and nothing that they do not.
    """
    attitude = recording.attitude
    if attitude is None or not len(attitude):
        return
    tilts = tilt(attitude.values, testbed.up)
    limit = max(TILTED, testbed.tilt_limit)
    angle = float(np.median(tilts))
    if angle <= limit:
        _check_level(recording, attitude, testbed)
        return
    found = (
        f"gravity that does not point down: the platform would be tilted by {_degrees(angle)} in "
        f"the median, with its body axis {_named(testbed.up)} as up"
    )
    shown, wanted = _fallen(attitude, tilts, limit) or _turned(attitude, testbed.up, limit)
    raise InputError(recording.source or "recording", f"{found}; {shown}", wanted)


def _check_level(recording: Recording, attitude: Samples, testbed: Testbed) -> None:
    """Raise InputError when the platform swings about a direction beyond its stop.

    What it swings about, or turns about, is the vertical: the laboratory is tilted.
    """
    upright = to_matrix(attitude.values) @ testbed.up
    middle = upright.mean(axis=0)
    middle = middle / max(float(np.linalg.norm(middle)), np.finfo(float).tiny)
    scatter = float(np.median(np.arccos(np.clip(upright @ middle, -1.0, 1.0))))
    off = float(np.arccos(np.clip(middle[2], -1.0, 1.0)))
    if off <= max(LEANS, testbed.tilt_limit, TIMES * scatter):
        return
    stop = _degrees(testbed.tilt_limit)
    found = (
        f"gravity that does not point down: the body axis {_named(testbed.up)} stays within "
        f"{_degrees(scatter)} (median) of a direction that is {_degrees(off)} from the "
        f"laboratory's vertical, beyond the platform's stop at {stop}"
    )
    wanted = (
        "attitudes in a laboratory whose Z is up: level its axes (the ground plane of a motion "
        "capture) and record again; or the tilt_limit_deg that the platform has, if it stands so"
    )
    raise InputError(recording.source or "recording", found, wanted)


def _fallen(attitude: Samples, tilts: Series1, limit: float) -> tuple[str, str] | None:
    """Return what is shown and wanted if it stood upright at first."""
    if tilts[0] > limit:
        return None
    lies = float(attitude.t[int(np.argmax(tilts > limit))])
    wanted = "a recording that ends before the platform falls: record it until you catch it"
    return f"it stood upright until {lies:.4g} s", wanted


def _turned(attitude: Samples, up: Vector3, limit: float) -> tuple[str, str]:
    """Return which body axis stays upright, or which axis of the laboratory one stays along."""
    angles = np.median(np.arccos(np.clip(to_matrix(attitude.values), -1.0, 1.0)), axis=0)
    body, off = _least(angles[2])
    if off <= limit:
        shown = f"its body axis {body} is {_degrees(off)} from the vertical in the median"
        return shown, _upright(body, up)
    none = "no body axis stays near the vertical"
    off, body, along = _along(angles, up)
    if off > limit:
        wanted = "attitudes that turn body into a laboratory whose Z is up"
        return f"{none}, nor near another axis of the laboratory", wanted
    shown = f"{none}, but {body} is {_degrees(off)} from the laboratory's {along} in the median"
    return shown, _level(along)


def _along(angles: Matrix3, up: Vector3) -> tuple[float, str, str]:
    """Return the least angle to a level axis of the laboratory, whose it is, and to which.

    Of a body axis and its opposite that one is taken which ``up`` has.
    """
    pairs: list[tuple[float, str, str]] = []
    for body, letter in enumerate("xyz"):
        for along, level in enumerate("xy"):
            angle = float(angles[along, body])
            sign, there = ("-", np.pi - angle) if up[body] < 0 else ("", angle)
            pairs += [(there, sign + letter, level), (np.pi - there, sign + letter, f"-{level}")]
    return min(pairs)


def _least(angles: Vector3) -> tuple[str, float]:
    """Return the body axis, one of six, at the least angle, given those of x, y and z."""
    both = np.concatenate([angles, np.pi - angles])
    least = int(np.argmin(both))
    return AXES[least], float(both[least])


def _upright(body: str, up: Vector3) -> str:
    """Say how a body axis becomes the one that points up."""
    column = ", ".join(f"{component:g}" for component in _vector(body))
    wanted = f"platform.up = [{column}] in the testbed, if its axes are those of the recording"
    if _named(up) not in AXES:
        return wanted
    axes = ", ".join(f'"{axis}"' for axis in _relabelled(body, _named(up)))
    return f"{wanted}; if not, body = [{axes}] in a column map (--columns)"


def _level(along: str) -> str:
    """Say how an axis of the laboratory becomes the one that points up."""
    w, x, y, z = TO_Z_UP["y"]
    as_y_up = to_matrix(np.array([w, -x, -y, -z])) @ _vector(along)
    return (
        f'lab_up = "{along}" in a column map (--columns) of a table that was read as Z up, '
        f'"{_named(as_y_up)}" of one that was read as Y up, as by --dialect optitrack'
    )


def _relabelled(body: str, up: str) -> tuple[str, str, str]:
    """Return our body axes in terms of the table's, so that ``up`` is its ``body``."""
    place, shift = "xyz".index(up[-1]), "xyz".index(body[-1])
    axes = ["xyz"[(i + shift - place) % 3] for i in range(3)]
    if body.startswith("-") != up.startswith("-"):  # two, so that the frame stays right-handed
        for i in (place, (place + 1) % 3):
            axes[i] = f"-{axes[i]}"
    return axes[0], axes[1], axes[2]


def _vector(axis: str) -> Vector3:
    return axes_matrix((axis, axis, axis))[0]


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.0f} deg"


def _named(up: Vector3) -> str:
    """Return x, -y and the like, or the components."""
    main = int(np.argmax(np.abs(up)))
    if np.abs(up[main]) > 1 - 1e-9:
        return ("-" if up[main] < 0 else "") + "xyz"[main]
    return "[" + ", ".join(f"{component:.3g}" for component in up) + "]"
