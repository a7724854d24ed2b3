"""A motion as Motive exports it: Y up, several header lines, bodies side by side."""

import numpy as np

from equipoise.model.arrays import Series4
from tests.oracle.mujoco_bench import product, rotation
from tests.support.recordings.recorded_motion import Motion

SETTINGS = (
    "Format Version,1.23,Take Name,Take 2024-05-03 02.11.40 PM,Capture Frame Rate,120.000000,"
    "Export Frame Rate,40.000000,Rotation Type,Quaternion,Length Units,Meters"
)
KINDS = [*["Rotation"] * 4, *["Position"] * 3, "Mean Marker Error"]
TO_Y_UP = rotation(np.array([-np.pi / 2, 0.0, 0.0]))  # z becomes y


def y_up(q: Series4) -> Series4:
    """Return attitudes to a laboratory whose Y is up."""
    return product(np.broadcast_to(TO_Y_UP, q.shape), q)


def motive_export(motion: Motion, bodies: tuple[str, ...]) -> str:
    """Return an export; the last body moves, the others stand still."""
    cells = len(KINDS)
    head = [
        SETTINGS,
        "",
        ",," + ",".join(["Rigid Body"] * (cells * len(bodies))),
        ",," + ",".join(f'"{body}"' for body in bodies for _ in KINDS),
        ",," + ",".join(f"AB12{k}" for k, _ in enumerate(bodies) for _ in KINDS),
        ",," + ",".join(KINDS * len(bodies)),
        "Frame,Time (Seconds)" + ",X,Y,Z,W,X,Y,Z," * len(bodies),
    ]
    q = y_up(motion.q)
    rest = "1.000208,1.000025,0.999974,0.000200"
    still = f"0.000000,0.000000,0.000000,1.000000,{rest}," * (len(bodies) - 1)
    moving = zip(motion.t.tolist(), q[:, [1, 2, 3, 0]].tolist(), strict=True)
    rows = [
        f"{k},{t:.6f},{still}" + "".join(f"{c:.7f}," for c in turn) + rest
        for k, (t, turn) in enumerate(moving)
    ]
    return "\n".join([*head, *rows, ""])
