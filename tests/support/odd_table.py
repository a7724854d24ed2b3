"""A table as a board of one's own logs it: a motion by MuJoCo, columns of odd names, raw counts.

    tick          ms since the board started
    o1 o2 o3 o4   x, y, z, w of the attitude's quaternion
    r1 r2 r3      counts of an MPU-6050, 65.5 for 1 deg/s, not zero at rest, the second reversed
    vbat          V

Some lines are cut, some rows have no attitude.
"""

import numpy as np

from tests.oracle import mujoco_bench as oracle

RATE, DURATION = 50.0, 60.0  # Hz, s
COUNTS = 65.5  # for 1 deg/s
AT_REST = np.array([-38, 21, 9])  # counts
WIRED = np.array([1, -1, 1])
CUT, WITHOUT = (411, 1190, 2207), (700, 701, 1800)  # lines of the file, less one


def platform() -> oracle.Platform:
    """Return 4 kg that hang 160 um below P, let go at 6 deg with some spin."""
    inertia = np.array(
        [[0.0455, 0.0004, -0.0006], [0.0004, 0.0438, 0.0005], [-0.0006, 0.0005, 0.0292]]
    )
    lean = oracle.rotation(np.deg2rad(6.0) * np.array([np.cos(0.7), np.sin(0.7), 0.0]))
    q = oracle.product(lean, oracle.rotation(np.array([0.0, 0.0, 1.1])))
    rate = oracle.matrix(q).T @ np.deg2rad([1.0, -2.0, 6.0])
    com = np.array([-22e-6, 14e-6, -160e-6])
    return oracle.Platform(4.0, inertia, com, (), 9.80665, q, rate)


def odd_table(seed: int = 1) -> str:
    """Return the text of the table."""
    rng = np.random.default_rng(seed)
    run = oracle.simulate(platform(), (), DURATION, locked=True)
    rows = oracle.every(run, RATE)
    t, q = run.t[rows], run.q[rows]
    q = oracle.product(q, oracle.rotation(rng.normal(0.0, np.deg2rad(0.1), (len(t), 3))))
    deg_s = np.rad2deg(run.rate[rows]) + rng.normal(0.0, 0.05, (len(t), 3))
    counts = np.round(COUNTS * WIRED * deg_s + AT_REST).astype(int)
    lines = ["tick,o1,o2,o3,o4,r1,r2,r3,vbat"]
    for k, (w, x, y, z) in enumerate(q):
        tick = 48_213 + round(1e3 * t[k])
        turn = "nan,nan,nan,nan" if k + 1 in WITHOUT else f"{x:.6f},{y:.6f},{z:.6f},{w:.6f}"
        line = f"{tick},{turn},{','.join(map(str, counts[k]))},{7.9 - 2e-5 * k:.2f}"
        lines.append(line[:25] if k + 1 in CUT else line)
    return "\n".join(lines) + "\n"
